"""What a node passes over, and the line through both axles, on straight and on any roads."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.symbols import Stretch
from floatref_reference.road_slope.wheels import (
    Points,
    passed_over,
    road_at,
    road_points,
    slopes_under_wheels,
)

METRES = st.floats(-2, 2)
POINTS = Points(first=-6.0, spacing=0.5, number=40)
C = Constants(interval_s=0.1, spacing_m=0.5)
Stopping = Callable[..., Stretch]


def points_of(stretch: Stretch) -> np.ndarray:
    points = road_points(stretch)
    return points.first + points.spacing * np.arange(points.number)


@given(seed=st.integers(0, 999), place=METRES)
def test_the_road_is_a_line_between_points(seed: int, place: float) -> None:
    z, x = np.random.default_rng(seed).normal(size=40), -6 + 0.5 * np.arange(40)
    assert road_at(z, POINTS, place) == pytest.approx(np.interp(place, x, z), abs=1e-12)


@settings(deadline=None, max_examples=25)
@given(z_0=METRES, slope=METRES, ahead=st.floats(-3.6, 0))
def test_on_a_straight_road_the_mean_is_the_road(
    stopping: Stopping, z_0: float, slope: float, ahead: float
) -> None:
    stretch = stopping(C, K=8)
    z = z_0 + slope * points_of(stretch)
    expected = z_0 + slope * (stretch.readings.place + ahead)
    assert passed_over(z, stretch, ahead) == pytest.approx(expected, abs=1e-12)
    assert slopes_under_wheels(z, stretch) == pytest.approx(np.full(8, slope), abs=1e-12)


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 999), ahead=st.floats(-3.6, 0))
def test_it_is_the_mean_of_three_places(stopping: Stopping, seed: int, ahead: float) -> None:
    stretch = stopping(C, K=24)
    x, run = points_of(stretch), stretch.readings
    z = np.random.default_rng(seed).normal(size=len(x))
    third = run.speed * 0.1 / 3
    parts = [np.interp(run.place + ahead + i * third, x, z) for i in (-1, 0, 1)]
    assert passed_over(z, stretch, ahead) == pytest.approx(np.mean(parts, axis=0), abs=1e-9)


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 999))
def test_the_line_goes_through_both_axles(stopping: Stopping, seed: int) -> None:
    stretch = stopping(C, K=24)
    z = np.random.default_rng(seed).normal(size=road_points(stretch).number)
    rise = np.multiply(slopes_under_wheels(z, stretch), -0.9 - -3.6)
    rear, front = passed_over(z, stretch, -3.6), passed_over(z, stretch, -0.9)
    assert np.add(rear, rise) == pytest.approx(front, abs=1e-12)


@pytest.mark.parametrize("spacing", [0.25, 0.7, 1.0, 3.0])
def test_points_reach_a_metre_beyond_laser_and_axles(stopping: Stopping, spacing: float) -> None:
    stretch = stopping(C._replace(spacing_m=spacing), speed=5.0)
    points = road_points(stretch)
    assert points.first == pytest.approx(-4.6)
    last = points.first + spacing * (points.number - 2)
    assert 6.25 + 1 <= last + 1e-9 < 6.25 + 1 + spacing + 1e-9
