"""The line through both axles on straight and on any roads, and its rate."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_reference.road_slope.symbols import Constants, Places, Stretch
from floatref_reference.road_slope.wheels import (
    Points,
    height_over_wheels,
    road_at,
    road_points,
    slope_rate,
    slope_under_wheels,
)

METRES = st.floats(-2, 2)
POINTS = Points(first=-6.0, spacing=0.5, number=40)
AT = st.builds(Places, st.floats(-1, 1), st.floats(-4, -2), METRES)


def road(seed: int) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(size=POINTS.number))


@given(z_0=METRES, slope=METRES, place=METRES, at=AT)
def test_on_a_straight_road_the_line_is_the_road(
    z_0: float, slope: float, place: float, at: Places
) -> None:
    z = z_0 + slope * (POINTS.first + POINTS.spacing * np.arange(POINTS.number))
    assert road_at(z, POINTS, place) == pytest.approx(z_0 + slope * place, abs=1e-12)
    assert slope_under_wheels(z, POINTS, place, at) == pytest.approx(slope, abs=1e-12)
    under = z_0 + slope * (place - at.lever)
    assert height_over_wheels(z, POINTS, place, at) == pytest.approx(under, abs=1e-12)


@given(seed=st.integers(0, 999), place=METRES, at=AT)
def test_the_line_goes_through_both_axles(seed: int, place: float, at: Places) -> None:
    z, x = road(seed), POINTS.first + POINTS.spacing * np.arange(POINTS.number)
    slope = slope_under_wheels(z, POINTS, place, at)
    height = height_over_wheels(z, POINTS, place, at)
    for axle in (at.front, at.rear):
        on_line = height + slope * (axle + at.lever)
        assert on_line == pytest.approx(np.interp(place + axle, x, z), abs=1e-9)


@pytest.mark.parametrize("spacing", [0.25, 0.7, 1.0, 3.0])
def test_points_reach_a_metre_beyond_laser_and_axles(
    stopping: Callable[..., Stretch], spacing: float
) -> None:
    stretch = stopping(Constants(interval=0.1, spacing=spacing))
    points = road_points(stretch)
    assert points.first == pytest.approx(-4.6)
    last = points.first + spacing * (points.number - 2)
    assert 6.25 + 1 <= last + 1e-9 < 6.25 + 1 + spacing + 1e-9


@given(k=st.integers(0, 19), cut=st.integers(2, 18), rate=METRES)
def test_a_slope_that_changes_evenly_has_its_rate_at_every_node(
    stopping: Callable[..., Stretch], k: int, cut: int, rate: float
) -> None:
    """Across the cut it jumps, and no rate may see that."""
    stretch = stopping(Constants(interval=0.1), K=20, cut=cut)
    slopes = [np.array(0.1 * rate * i + 50 * (i >= cut)) for i in range(20)]
    assert slope_rate(slopes, stretch, k) == pytest.approx(rate, abs=1e-9)


def test_the_rate_is_central_inside_and_one_sided_at_an_end(
    stopping: Callable[..., Stretch],
) -> None:
    """Of t²: a central difference has 2t, a one-sided one 2t ± Δ."""
    stretch = stopping(Constants(interval=0.1), K=20, cut=10)
    t = 0.1 * np.arange(20)
    rates = np.array([slope_rate(list(t**2), stretch, k) for k in range(20)]) - 2 * t
    expected = np.zeros(20)
    expected[[0, 10]], expected[[9, 19]] = 0.1, -0.1
    assert rates == pytest.approx(expected, abs=1e-12)


def test_a_node_alone_has_no_rate(stopping: Callable[..., Stretch]) -> None:
    stretch = stopping(Constants(interval=0.1), K=20, cut=1)
    with pytest.raises(ValueError, match="node 0 is alone"):
        slope_rate([np.zeros(())] * 20, stretch, 0)
