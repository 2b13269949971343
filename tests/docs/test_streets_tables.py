"""What the pages of the smoothers say of streets, held to the figures that were measured."""

import importlib
import json
import re
from pathlib import Path

import numpy as np
import pytest

TESTS = Path(__file__).parents[1]
ROWS = json.loads((TESTS / "docs" / "data" / "streets.json").read_text(encoding="utf-8"))
PAGES = {
    "road-prior.md": ["road prior"],
    "kalman-smoother.md": ["reflection", "constants"],
}
PIPELINES = [name for names in PAGES.values() for name in names]
PLAIN = "plain road: laser at 0.105 m, slip 2.5 %/g"


def read(page: str) -> str:
    return (TESTS.parent / "docs" / page).read_text(encoding="utf-8")


@pytest.fixture
def bench(monkeypatch):
    monkeypatch.syspath_prepend(str(TESTS / "benchmarks"))
    return importlib.import_module("bench_streets")


def figures(case: str, pipeline: str, axis: str, name: str) -> list[float]:
    """Return a figure of every seed and wheel path."""
    (row,) = (
        r for r in ROWS if (r["case"], r["pipeline"], r["axis"]) == (case, pipeline, axis)
    )  # fmt: skip
    return row[name]


@pytest.mark.parametrize("page", PAGES)
def test_the_tables_are_those_measured(bench, page):
    text = read(page)
    assert bench.fill(text, ROWS) == text
    assert re.findall(r"<!-- streets: (.+) -->", text) == PAGES[page]


def test_every_case_is_measured_with_three_seeds_and_both_wheel_paths(bench):
    assert list(dict.fromkeys(row["case"] for row in ROWS)) == list(bench.CASES)
    assert len(ROWS) == len(bench.CASES) * len(PIPELINES) * len(bench.AXES)
    assert {len(row["correlation"]) for row in ROWS} == {6}


@pytest.mark.parametrize("pipeline", PIPELINES)
def test_a_line_shows_median_and_lowest(bench, pipeline):
    shown = bench.cells(ROWS, PLAIN, pipeline)
    true = figures(PLAIN, pipeline, "true", "correlation")
    encoder = figures(PLAIN, pipeline, "encoder", "correlation")
    expected = [np.median(true), min(true), np.median(encoder), min(encoder)]
    assert [float(cell) for cell in shown[1:5]] == pytest.approx(expected, abs=6e-4)


@pytest.mark.parametrize("page", PAGES)
def test_the_command_is_on_the_page(page):
    assert "python tests/benchmarks/bench_streets.py" in read(page)
