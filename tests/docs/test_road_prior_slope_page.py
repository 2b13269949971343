"""The page of the slope under the wheels: its table is of the drawn stops, and true of some."""

import importlib
import re
from pathlib import Path

import numpy as np
import pytest

from floatref_conformance.table.families.conditions import STOPS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "road-prior-slope.md").read_text(encoding="utf-8")
ROWS = {
    cells[0].strip(): [re.findall(r"[\d.]+", cell) for cell in cells[1:]]
    for line in re.findall(r"^\| ((?:[^|`]+\|){9})$", PAGE, re.M)
    for cells in (line.rstrip("|").split("|"),)
    if re.search(r"\d\.\d{3}", line)
}
"""Figures of each shape: those of the stage first, those without it behind."""


def test_every_shape_has_a_row_and_the_command_its_number_of_drives():
    assert set(ROWS) == {condition.name for condition in STOPS}
    drives = re.search(r"Seed 0, (\d+) drives", PAGE)
    assert drives is not None
    assert f"--drives {drives.group(1)} --jobs 2" in PAGE
    assert int(drives.group(1)) >= 20


def test_the_four_shares_are_all_wheel_paths():
    for cells in ROWS.values():
        assert sum(map(float, cells[4])) == pytest.approx(100.0, abs=0.25)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(STOPS)), ids=[c.name for c in STOPS])
def test_the_first_drive_of_each_shape_is_as_the_page_says(number, monkeypatch):
    """No worse than the lowest of the page, and right where it says that all are."""
    monkeypatch.syspath_prepend(str(ROOT / "tests" / "benchmarks"))
    bench = importlib.import_module("bench_levelled_stops")
    bench.add_plugin()
    found = bench.drive((bench.LEVELLED, 0, number, 0))
    cells = ROWS[STOPS[number].name]
    lowest = min(scores.encoder.cross_correlation for scores in found.values())
    assert lowest >= float(cells[1][0]) - 0.002
    assert all(scores.encoder.valid_is_right for scores in found.values())
    assert np.median([s.encoder.iri_error_percent for s in found.values()]) < 5.0
