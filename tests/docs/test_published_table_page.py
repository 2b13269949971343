"""The page on the published tables: its numbers are the code's, its example runs."""

import re
from pathlib import Path

import pytest

from floatref_conformance.proving_ground.runs import RUNS, SECTION_START_M
from floatref_conformance.table import Cell, TableSettings, published_figures, rank_correlation
from floatref_conformance.table.published import REFERENCE_IRI_M_PER_KM
from floatref_conformance.table.scores import AVERAGE_M, MAX_OFFSET_M, PEAK_M

PAGE = (Path(__file__).parents[2] / "docs" / "published-table.md").read_text(encoding="utf-8")
TEXT = " ".join(PAGE.split())
WORDS = {2: "Two", 3: "Three", 7: "seven", 12: "twelve"}


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


def test_the_score_of_the_rule_follows_from_print() -> None:
    cells = [Cell(*key, (figures.scores,), figures) for key, figures in published_figures().items()]
    found = rank_correlation(cells)
    assert found.rule is not None
    assert f"reaches {found.rule:.2f} over the {found.cells} cells" in TEXT


def test_the_example_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (example,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.M | re.S)
    exec(example, {})
    assert 1.0 < float(capsys.readouterr().out) < 100.0
