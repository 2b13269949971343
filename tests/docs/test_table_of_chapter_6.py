"""What the page on the published tables says of chapter 6, held to the default table."""

import json
import re
from pathlib import Path
from statistics import fmean

import pytest

from floatref_conformance.proving_ground.drives.runs import RUNS

pytestmark = pytest.mark.cites("Tables 6.2 to 6.6")
DOCS = Path(__file__).parents[2] / "docs"
TABLE = json.loads((Path(__file__).parent / "data" / "table.json").read_text(encoding="utf-8"))
CELLS = {(cell["pipeline"], cell["run"]): cell for cell in TABLE["cells"]}
PAGE = (DOCS / "published-table.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| `(kalman\S*)` \| ([^|]+) \|((?: [\d.<–]+ \|){4})$", PAGE, re.M)
STOPS, BRAKES = ([n for n, run in RUNS.items() if run.kind == k] for k in ("stop", "braking"))
LONG_STOPS = [name for name in STOPS if (RUNS[name].dwell_s or 0.0) >= 5.0]
GROUPS = {
    "stops": STOPS,
    "near stop": ["ns_72-11_0.20g"],
    "brakes": BRAKES,
    "16 km/h": ["const_16"],
    "5 km/h": ["const_5"],
}
ADAPTIVE = ("temporal-adaptive-hpf", "temporal-adaptive-hpf-spatial-backward")
PIPELINES = [f"kalman-{name}" for name in ("filter", "smoother", "smoother-reflection")]
CONSTANT = [f"kalman-smoother-constant-{name}" for name in ("attitude", "height-attitude")]


def correlations(pipeline: str, runs: list[str], prefix: str = "") -> list[float]:
    return [CELLS[pipeline, run][f"{prefix}cross_correlation"] for run in runs]


def peaks(pipeline: str, runs: list[str]) -> list[float]:
    return [CELLS[pipeline, run]["peak_m_per_km"] for run in runs]


def test_every_pipeline_and_kind_of_run_has_its_row() -> None:
    assert [row[:2] for row in ROWS] == [(p, g) for p in (*PIPELINES, *CONSTANT) for g in GROUPS]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]}-{row[1]}")
def test_quoted_cross_correlations_are_the_tables(row: tuple[str, str, str]) -> None:
    pipeline, group, figures = row
    ours, printed = (correlations(pipeline, GROUPS[group], p) for p in ("", "published_"))
    shown = [figure.strip() for figure in figures.strip("| ").split("|")]
    assert shown[:2] == [f"{min(ours):.3f}", f"{fmean(ours):.3f}"]
    cells = [CELLS[pipeline, run] for run in GROUPS[group]]
    if None in printed:
        assert shown[2:] == ["–", "–"]
    elif any(cell["published_cross_correlation_is_upper_bound"] for cell in cells):
        assert shown[2:] == ["<0.2", "–"]
    else:
        assert shown[2:] == [f"{min(printed):.3f}", f"{fmean(printed):.3f}"]


def test_reflection_is_good_at_every_stop_and_brake() -> None:
    assert min(correlations("kalman-smoother-reflection", STOPS)) >= 0.99
    assert min(correlations("kalman-smoother-reflection", BRAKES)) >= 0.98


@pytest.mark.parametrize("pipeline", CONSTANT)
def test_constants_in_place_of_readings_are_good_on_every_run(pipeline: str) -> None:
    found = {run: CELLS[pipeline, run]["cross_correlation"] for p, run in CELLS if p == pipeline}
    assert min(found.values()) >= 0.94
    hardest = {*GROUPS["near stop"], "brk_49-34_0.84g"}
    assert {run for run, value in found.items() if value < 0.980} <= hardest


@pytest.mark.parametrize("adaptive", ADAPTIVE)
def test_the_filter_alone_is_worse_than_the_adaptive_high_pass_at_long_stops(adaptive: str) -> None:
    for run in LONG_STOPS:
        (worse,), (better,) = (correlations(p, [run]) for p in ("kalman-filter", adaptive))
        assert worse < better, run
        assert peaks("kalman-filter", [run]) > peaks(adaptive, [run]), run


def test_smoothing_and_reflection_are_each_a_gain_at_every_stop() -> None:
    for run in STOPS:
        filtered, smoothed, reflected = (correlations(p, [run])[0] for p in PIPELINES)
        assert filtered < smoothed < reflected, run


def test_the_figures_of_the_text_are_the_tables() -> None:
    text = " ".join(PAGE.split())
    low, high = (f(correlations("kalman-filter", LONG_STOPS)) for f in (min, max))
    least, most = (f(peaks("kalman-filter", LONG_STOPS)) for f in (min, max))
    assert f"{low:.2f} to {high:.2f} with peaks of {least:.1f} to {most:.1f} m/km" in text
    near = CELLS[CONSTANT[1], "ns_72-11_0.20g"]
    ours, printed = near["cross_correlation"], near["published_cross_correlation"]
    error = abs(near["iri_error_percent"])
    assert f"has {ours:.3f} there, print {printed:.3f}, with an IRI {error:.1f} %" in text
    creep = CELLS["kalman-filter", "const_5"]
    ours, printed = creep["iri_error_percent"], creep["published_iri_error_percent"]
    assert f"IRI {ours:.1f} % too high (print {printed:.1f} %)" in text


def test_the_gains_over_print_are_the_tables() -> None:
    def gains(pipeline: str, runs: list[str]) -> list[float]:
        ours, printed = (correlations(pipeline, runs, prefix) for prefix in ("", "published_"))
        return [round(one - other, 2) for one, other in zip(ours, printed, strict=True)]

    text = " ".join(PAGE.split())
    found = gains("kalman-smoother-reflection", STOPS)
    assert f"by {min(found):.2f} to {max(found):.2f} at stops" in text
    assert gains("kalman-smoother", ["brk_49-34_0.84g"]) == [0.06]
    assert "by 0.06 at the brake of 0.84 g" in text
    found = gains("kalman-smoother", STOPS)
    less = [-gain for gain in found if gain < 0.0]
    assert len(less) == 3
    assert f"has {min(less):.2f} to {max(less):.2f} less than print at three stops" in text
    assert f"up to {max(found):.2f} more at the others" in text
