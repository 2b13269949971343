"""The page of the slope under the wheels: its table is of the drawn stops, and true of some."""

import re
from pathlib import Path

import pytest

from floatref_conformance.table.families.conditions import STOPS, STOPS_FAMILY
from floatref_conformance.table.families.family_making import make_family_table
from floatref_conformance.table.families.family_settings import FamilySettings

PAGE = (Path(__file__).parents[2] / "docs" / "road-prior-slope.md").read_text(encoding="utf-8")
PIPELINE = "road-prior-smoother"
ROWS = {
    cells[0].strip(): [list(map(float, re.findall(r"[\d.]+", cell))) for cell in cells[1:]]
    for line in re.findall(r"^\| ((?:[^|`]+\|){6})$", PAGE, re.M)
    for cells in (line.rstrip("|").split("|"),)
    if re.search(r"\d\.\d{3}", line)
}
"""Figures of each shape."""


def test_every_shape_has_a_row_and_the_command_its_number_of_drives():
    assert set(ROWS) == {condition.name for condition in STOPS}
    drives = re.search(r"Seed 0, (\d+) drives", PAGE)
    assert drives is not None
    command = f"--family stops --drives {drives.group(1)} --jobs 2 --pipeline {PIPELINE}"
    assert command in PAGE
    assert int(drives.group(1)) >= 200


def test_what_is_asked_of_stops_is_on_the_page():
    for correlation, iri, shares, flagged, (within, _) in ROWS.values():
        median, low, lowest = correlation
        assert median >= 0.99
        assert median > low >= 0.95
        assert low >= lowest
        assert iri[0] <= 3.0
        assert sum(shares) == pytest.approx(100.0, abs=0.25)
        assert shares[3] <= 1.0
        assert flagged[0] <= 10.0
        assert 85.0 <= within <= 99.5


def test_the_flags_that_are_more_than_asked_are_those_the_page_names():
    """30 m at the 95th percentile are asked of every shape."""
    more = {shape for shape, (_, _, _, flagged, _) in ROWS.items() if flagged[1] > 30.0}
    assert more == {"hump, gutter"}
    assert "On humps the 95th percentile is 32 m" in PAGE


@pytest.mark.slow
def test_the_first_drive_of_each_shape_is_as_the_page_says():
    """No worse than the first percentile of the page, and right."""
    table = make_family_table(FamilySettings(STOPS_FAMILY, drives=1, pipelines=(PIPELINE,)))
    assert len(table.paths) == 2 * len(STOPS)
    for path in table.paths:
        assert path.scores is not None
        _, low, _ = ROWS[path.condition.name][0]
        assert path.scores.encoder.cross_correlation >= low - 0.002
        assert path.scores.encoder.valid_is_right
