"""The page on the published tables: its numbers are the code's, its example runs."""

import re
from pathlib import Path

import pytest

from floatref_conformance.proving_ground.drives.runs import RUNS, SECTION_START_M
from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES
from floatref_conformance.table import Cell, TableSettings, published_figures, rank_correlation
from floatref_conformance.table.published import REFERENCE_IRI_M_PER_KM
from floatref_conformance.table.scores import AVERAGE_M, MAX_OFFSET_M, PEAK_M
from floatref_conformance.table.stops import StopSettings
from floatref_conformance.table.stops.stop_scores import STRETCH_M
from floatref_conformance.table.stops.stop_settings import (
    DECELERATION_G,
    DWELL_S,
    FINAL_SPEED_KMH,
    SPEED_KMH,
    STOP_ROADS,
    draw_stop,
)

PAGE = (Path(__file__).parents[2] / "docs" / "published-table.md").read_text(encoding="utf-8")
TEXT = " ".join(PAGE.split())
WORDS = {2: "Two", 3: "Three", 5: "five", 7: "seven", 12: "twelve"}


def test_the_numbers_of_the_method_are_the_codes() -> None:
    kinds = [run.kind for run in RUNS.values()]
    settings = TableSettings()
    for said in (
        f"{len(settings.runs)} runs: {WORDS[kinds.count('stop')]} stops",
        f"a near stop, {WORDS[kinds.count('braking')]} brakes",
        f"starts {SECTION_START_M:g} m into",
        f"{WORDS[settings.roads]} roads",
        f"{WORDS[settings.seeds]} sets of passes",
        f"over {WORDS[2 * settings.roads * settings.seeds]}.",
        f"is {REFERENCE_IRI_M_PER_KM} m/km",
        f"| {PEAK_M[0]:g} to {PEAK_M[1]:g} m |",
        f"| {AVERAGE_M[0]} to {AVERAGE_M[1]} m |",
        f"within ±{MAX_OFFSET_M:g} m",
    ):
        assert said in TEXT, said


def test_the_numbers_of_drawn_stops_are_the_codes() -> None:
    (section,) = re.findall(r"^## Drawn stops .*?(?=^## )", PAGE, re.M | re.S)
    text = " ".join(section.split())
    drawn = draw_stop(0, next(iter(VEHICLES)), STOP_ROADS[0], 0, frozenset())
    smooth, fair, rough = (road.iri_m_per_km for road in STOP_ROADS)
    for said in (
        f"Each of the {WORDS[len(VEHICLES)]} vehicles",
        f"a brake of {DECELERATION_G[0]} to {DECELERATION_G[1]} g",
        f"from {SPEED_KMH[0]:g} to {SPEED_KMH[1]:g} km/h",
        f"a stop of {DWELL_S[0]:g} to {DWELL_S[1]:g} s",
        f"on to {FINAL_SPEED_KMH[0]:g} to {FINAL_SPEED_KMH[1]:g} km/h",
        f"The stop is at {drawn.event_at_m:g} m of {drawn.length_m:g} m",
        f"IRI of {smooth} m/km, fair with {fair} and rough with {rough:g}:",
        f"from {STRETCH_M[0]:g} to {STRETCH_M[1]:g} m",
        f"--stops {StopSettings.stops}",
    ):
        assert said in text, said


def test_the_score_of_the_rule_follows_from_print() -> None:
    cells = [Cell(*key, (figures.scores,), figures) for key, figures in published_figures().items()]
    found = rank_correlation(cells)
    assert found.rule is not None
    assert f"reaches {found.rule:.2f} over the {found.cells} cells" in TEXT


@pytest.mark.slow
def test_the_example_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (example,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.M | re.S)
    exec(example, {})
    assert 1.0 < float(capsys.readouterr().out) < 100.0
