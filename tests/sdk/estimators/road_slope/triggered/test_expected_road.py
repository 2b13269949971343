"""The expected road is that of its slopes, and its acceleration is the road's own in time."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.sdk.estimators.road_slope.short_runs import at_speed
from tests.sdk.estimators.road_slope.test_levelled import PLACES, STEP, drive_over_bumps

from floatref.estimators.road_slope.constants import SlopeModel
from floatref.estimators.road_slope.gauss_newton import Fit
from floatref.estimators.road_slope.triggered.expected_road import (
    ExpectedRoad,
    LevelledRoad,
    slope_at,
)

BINS = st.integers(3, 30)


@pytest.mark.slow
@given(data=st.data(), bins=BINS)
def test_twice_the_integral_of_its_acceleration_is_its_elevation(data, bins) -> None:
    """On lines between bins: a third of what it bends in two bins is all that is off."""
    slope = data.draw(arrays(float, bins, elements=st.floats(-0.2, 0.2)))
    travel = data.draw(arrays(float, bins, elements=st.floats(0.0, 0.3)))
    road = ExpectedRoad.of(slope, np.cumsum(travel), STEP)
    a, velocity = road.acceleration, np.zeros(bins)
    velocity[1:] = np.cumsum(0.5 * STEP * (a[1:] + a[:-1]))
    rise = STEP * velocity[:-1] + STEP**2 * (a[:-1] / 3.0 + a[1:] / 6.0)
    first = road.elevation[1] / STEP
    height = np.append(0.0, np.cumsum(rise)) + first * STEP * np.arange(bins)
    np.testing.assert_allclose(height, road.elevation + STEP**2 * a / 6.0, atol=1e-12)


@given(slope=st.floats(-0.3, 0.3), speed=st.floats(0.0, 30.0), bins=st.integers(0, 20))
def test_an_even_grade_at_one_speed_has_no_acceleration(slope, speed, bins) -> None:
    distance = speed * STEP * np.arange(bins)
    road = ExpectedRoad.of(np.full(bins, slope), distance, STEP)
    np.testing.assert_allclose(road.elevation, slope * distance, atol=1e-12)
    np.testing.assert_allclose(road.acceleration, 0.0, atol=1e-9)


@pytest.mark.slow
@given(first=st.floats(-0.1, 0.1), bend=st.floats(-0.02, 0.02), gain=st.floats(0.001, 0.01))
def test_of_fits_that_share_an_end_it_is_the_mean_by_their_weights(first, bend, gain) -> None:
    stretch = at_speed(np.full(40, 12.0))
    lay, seen = stretch.layout, stretch.readings
    places = stretch.first_m + stretch.model.spacing_m * (np.arange(lay.points) + 0.5)
    unknowns = np.zeros(lay.size)
    unknowns[lay.slope], unknowns[lay.place("gain")] = first + bend * places, gain
    result = Fit(stretch, unknowns, np.zeros(0), 7, 0.0)
    size = int(seen.bins[-1]) + 1
    found = LevelledRoad(*np.zeros((5, size)), [])
    once, half = slice(0, size), slice(size // 2, size)
    found._add(result, once, np.full(size, 0.5))
    found._add(result, half, np.full(size - size // 2, 1.0))
    at = np.interp(np.arange(size), seen.bins, seen.place)
    slope = slope_at(result, at) - result.grade
    np.testing.assert_allclose(slope, first + bend * at - result.grade, atol=1e-12)
    np.testing.assert_allclose(found.slope, slope * np.where(np.arange(size) < half.start, 0.5, 1))
    np.testing.assert_allclose(found.gain, gain)


def test_it_is_one_of_the_whole_run_and_nothing_away_from_stops() -> None:
    drive = drive_over_bumps(1)
    found = LevelledRoad.over(drive, PLACES, SlopeModel(), 30.0)
    off = found.share == 0.0
    assert found.slope[~off].any()
    assert not found.slope[off].any()
    assert not found.gain[off].any()
