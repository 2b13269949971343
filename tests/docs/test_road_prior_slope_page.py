"""The page of the slope under the wheels: its table is of the drawn stops, and true of some."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from floatref_conformance.table.families.conditions import STOPS

ROOT = Path(__file__).parents[2]
BENCHMARK = ROOT / "tests" / "benchmarks" / "bench_levelled_stops.py"
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
def test_the_first_drive_of_each_shape_is_as_the_page_says(tmp_path):
    """No worse than the lowest of the page, and right where it says that all are.

    In a process of its own: the plug-in must not be known to other tests.
    """
    made = tmp_path / "stops.json"
    command = [sys.executable, str(BENCHMARK), "--drives", "1", "--json", str(made)]
    subprocess.run(command, check=True, capture_output=True)
    paths = json.loads(made.read_text(encoding="utf-8"))["paths"]
    assert len(paths) == 2 * len(STOPS)
    for path in paths:
        scores = path["scores"]["encoder"]
        lowest = float(ROWS[path["condition"]][1][0])
        assert scores["cross_correlation"] >= lowest - 0.002
        assert scores["valid_is_right"]
