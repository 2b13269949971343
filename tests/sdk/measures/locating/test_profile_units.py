"""Units in which runs turn up, by what one has of another, and how a gain tells one."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.measures.locating.profile_units import (
    DISTANCE_UNITS,
    HEIGHT_UNITS,
    height_unit,
)


@pytest.mark.parametrize(
    ("many", "small", "large"),
    [
        (10, "mm", "cm"),
        (100, "cm", "m"),
        (1000, "m", "km"),
        (12, "in", "ft"),
        (3, "ft", "yd"),
        (1760, "yd", "mi"),
        (1000, "mil", "in"),
        (2.54, "cm", "in"),
    ],
)
def test_so_many_of_one_make_another(many: float, small: str, large: str) -> None:
    tables = [t for t in (DISTANCE_UNITS, HEIGHT_UNITS) if {small, large} <= t.keys()]
    assert tables
    for table in tables:
        assert many * table[small] == pytest.approx(table[large], rel=1e-12)


@given(st.sampled_from(sorted(HEIGHT_UNITS)), st.floats(0.8, 1.25))
def test_heights_nearly_of_a_unit_are_of_it(unit: str, gain: float) -> None:
    assert height_unit(gain / HEIGHT_UNITS[unit]) == unit


@pytest.mark.parametrize("gain", [0.0, -1.0, float("nan"), 5.0, 1e7])
def test_a_gain_that_no_unit_explains_has_none(gain: float) -> None:
    assert height_unit(gain) is None
