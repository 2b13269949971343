"""Laws of a line laser: cracks do not reach its height, wide dips do, a plane is read exactly."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.bridging import SKIP, WINDOW, bridge
from floatref_conformance.proving_ground.roads.random_roads import sayers_road
from floatref_conformance.proving_ground.roads.strips import strip_around
from floatref_conformance.proving_ground.roads.surface import Surface

WIDTH_M, READINGS = 0.1, 400
"""The nominal profiler's line laser: about 400 readings over 100 mm (4.3)."""
FINE_M = 0.0005


def across(*strings: FloatArray, right_m: float = -0.1, across_m: float = FINE_M) -> Surface:
    """Return a surface of two points whose strings have these elevations across the road."""
    rows = np.repeat(np.concatenate(strings)[:, None], 2, axis=1)
    return Surface(0.0, 0.005, right_m, across_m, rows)


def height(elevation: FloatArray, middle_m: float = 0.0) -> float:
    """Return the line's height over strings 0.5 mm apart from -100 to 100 mm."""
    return float(bridge(across(elevation), np.full(2, middle_m), WIDTH_M)[0])


LATERAL = np.arange(-200, 201) * FINE_M


def dip(at_m: float, wide_m: float) -> FloatArray:
    """Return a dip of 20 mm in a level road, with walls of one string."""
    return np.where(np.abs(LATERAL - at_m) < wide_m / 2, -0.02, 0.0)


def sort_readings(strip: Surface, k: int, middle_m: float, width_m: float) -> float:
    """Return the maker's rule in plain steps: sort, cut, average."""
    beside = middle_m + width_m * ((np.arange(READINGS) + 0.5) / READINGS - 0.5)
    strings = strip.right_m + strip.across_m * np.arange(strip.elevation.shape[0])
    z = sorted(np.interp(beside, strings, strip.elevation[:, k]))
    first, last = round((1 - WINDOW) * READINGS), round((1 - SKIP) * READINGS)
    return float(np.mean(z[first:last]))


@pytest.mark.slow
@settings(max_examples=30)
@given(wide=st.floats(0.001, 0.0145), at=st.floats(-0.04, 0.04))
def test_a_crack_narrower_than_its_share_does_not_reach_the_height(wide: float, at: float) -> None:
    assert height(dip(at, wide)) == pytest.approx(0.0, abs=1e-12)


def test_a_stone_does_not_reach_it_either() -> None:
    assert height(-dip(0.02, 0.012)) == pytest.approx(0.0, abs=1e-12)


@given(share=st.floats(0.02, 0.98))
def test_a_dip_counts_from_its_share_on_and_wholly_where_it_is_wide(share: float) -> None:
    wide = share * WIDTH_M
    at = (WIDTH_M - wide) / 2
    expected = -0.02 * np.clip((share - (1 - WINDOW)) / (WINDOW - SKIP), 0.0, 1.0)
    assert height(dip(at + 0.05, wide + 0.1)) == pytest.approx(expected, abs=0.02 * 0.015)


@settings(max_examples=30)
@given(slope=st.floats(-0.2, 0.2), lift=st.floats(-2.0, 2.0), at=st.floats(-0.05, 0.05))
def test_a_plane_has_the_height_of_its_middle(slope: float, lift: float, at: float) -> None:
    assert height(lift + slope * LATERAL, at) == pytest.approx(lift + slope * at, abs=1e-12)


@pytest.mark.parametrize("width_m", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("wanders", [False, True])
def test_the_height_is_that_of_400_sorted_readings(width_m: float, wanders: bool) -> None:
    road = sayers_road("normal", 40.0, 5, tracks=("left",))
    strip = strip_around(road, "left", 5, -0.2, 0.2)
    y = 0.03 * np.sin(road.distance_m) if wanders else np.zeros(strip.points)
    found = bridge(strip, y, width_m)
    for k in range(10000, strip.points, 171):
        relief = float(np.ptp(strip.elevation[:, k]))
        expected = sort_readings(strip, k, float(y[k]), width_m)
        assert found[k] == pytest.approx(expected, abs=relief / READINGS)
    assert np.abs(found - strip.line(y))[10000:].max() > 1e-5


@given(st.lists(st.floats(-0.05, 0.05), min_size=8, max_size=8), st.floats(-1.0, 1.0))
@example([-2.2250738585e-313, *7 * [0.0]], 0.0)
def test_raising_the_road_raises_the_height_and_it_lies_within(
    heights: list[float], lift: float
) -> None:
    z = np.repeat(heights, 3)
    y, at = np.full(2, 0.1), {"right_m": 0.0, "across_m": 0.01}
    low, high = (bridge(across(each, **at), y, 0.15)[0] for each in (z, z + lift))
    assert high == pytest.approx(low + lift, abs=1e-12)
    assert z.min() - 1e-12 <= low <= z.max() + 1e-12


def test_a_line_that_leaves_the_surface_or_has_no_width_is_refused() -> None:
    level = across(np.zeros(LATERAL.size))
    assert bridge(level, np.full(2, 0.05), WIDTH_M) == pytest.approx([0.0, 0.0])
    with pytest.raises(InputError, match=r"line at 0\.00 m, 0\.101 m to the left: the surface"):
        bridge(level, np.full(2, 0.051), WIDTH_M)
    with pytest.raises(InputError, match=r"0\.0 m wide; it must be above zero"):
        bridge(level, np.zeros(2), 0.0)


def test_a_hole_under_the_line_is_refused() -> None:
    z = np.zeros((41, 3))
    z[20, 1] = np.nan
    holed = Surface(0.0, 0.5, -0.1, 0.005, z)
    with pytest.raises(InputError, match=r"line at 0\.50 m: the surface has a hole there"):
        bridge(holed, np.zeros(3), WIDTH_M)
    assert bridge(holed, np.full(3, 0.054), 0.05) == pytest.approx(np.zeros(3))
