"""What the page on the limits of the road prior says, held to the figures that were measured."""

import json
import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
DATA = Path(__file__).parent / "data" / "road-prior-limits.json"
CELLS = {
    (cell["kind"], cell["severity"], cell["pipeline"]): cell
    for cell in json.loads(DATA.read_text(encoding="utf-8"))
}
PAGE = (DOCS / "road-prior-limits.md").read_text(encoding="utf-8")
OURS = "road-prior-smoother"
OTHERS = ("temporal-adaptive-hpf-spatial-backward", "spatial-hpf-timer-distortion-reflection")
ROWS = [
    tuple(cell.strip() for cell in line.strip("|").split("|"))
    for line in re.findall(r"^\|.+\|$", PAGE, re.M)[2:]
]
BORNE = ("none", "long stop", "boarding", "hill", "engine", "mount", "encoder scale", "slip")
MORE_THAN_IT_BEARS = {("slip in the brake", "30 %/g")}
LEAST = 0.96


def is_refused(row):
    """Whether the screening has refused the recording: there are no figures."""
    refused = "lowest" not in CELLS[(*row[:2], OURS)]
    assert refused == (set(row[2:]) == {"refused"})
    return refused


def test_every_case_has_its_row():
    cases = [(kind, severity) for kind, severity, pipeline in CELLS if pipeline == OURS]
    assert [row[:2] for row in ROWS] == cases


@pytest.mark.parametrize("row", ROWS, ids=lambda row: ", ".join(row[:2]))
def test_figures_are_those_measured(row):
    if is_refused(row):
        return
    kind, severity, mean, lowest, iri, within, valid, *others = row
    ours = CELLS[kind, severity, OURS]
    found = [float(mean), float(lowest.strip(" !")), float(iri), float(within), float(valid)]
    names = ("cross_correlation", "lowest", "iri_error_percent", "within_percent", "valid_percent")
    for shown, name, last in zip(found, names, (1e-3, 1e-3, 0.1, 0.1, 0.1), strict=True):
        assert shown == pytest.approx(ours[name], abs=0.51 * last + 1e-4)
    for shown, name in zip(others, OTHERS, strict=True):
        cell = CELLS[kind, severity, name]
        assert float(shown) == pytest.approx(cell["cross_correlation"], abs=6.1e-4)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: ", ".join(row[:2]))
def test_the_mark_stands_where_the_lowest_is_too_low(row):
    if is_refused(row):
        return
    assert ("!" in row[3]) == (CELLS[(*row[:2], OURS)]["lowest"] < LEAST)


def test_what_it_bears_it_bears():
    borne = [
        cell
        for (kind, severity, pipeline), cell in CELLS.items()
        if pipeline == OURS and kind.startswith(BORNE) and "lowest" in cell
        if (kind, severity) not in MORE_THAN_IT_BEARS
    ]
    assert len(borne) >= 2 * len(BORNE)
    assert min(cell["lowest"] for cell in borne) >= 0.98


def test_it_is_better_than_the_others_wherever_it_is_adequate():
    for (kind, severity, pipeline), cell in CELLS.items():
        if pipeline == OURS and cell.get("lowest", 0.0) >= LEAST:
            others = [CELLS[kind, severity, name]["cross_correlation"] for name in OTHERS]
            assert cell["cross_correlation"] > max(others)
