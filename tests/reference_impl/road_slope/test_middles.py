"""Differences and means of polynomials, and where they are."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.middles import bent, mean, middles, rate
from floatref_reference.road_slope.symbols import Stretch

FACTORS = st.lists(st.floats(-2, 2), min_size=6, max_size=6)
INTERVAL = st.floats(0.03, 0.5)
T = np.arange(4.0)


@given(factors=FACTORS, interval=INTERVAL, k=st.integers(1, 2))
def test_the_second_difference_is_the_mean_of_the_acceleration(
    factors: list[float], interval: float, k: int
) -> None:
    """Exactly, up to the fifth power of time."""
    y = np.polynomial.Polynomial(factors)
    expected = mean(y.deriv(2)(interval * T), k)
    assert bent(y(interval * T), k, interval) == pytest.approx(expected, abs=1e-9 / interval**2)


@given(factors=FACTORS, interval=INTERVAL, k=st.integers(1, 2))
def test_of_a_parabola_all_are_closed_forms(factors: list[float], interval: float, k: int) -> None:
    y = np.polynomial.Polynomial(factors[:3])
    t, at = interval * T, interval * k
    assert bent(y(t), k, interval) == pytest.approx(2 * factors[2], abs=1e-9)
    assert rate(y(t), k, interval) == pytest.approx(y.deriv()(at), abs=1e-9)
    assert mean(y(t), k) == pytest.approx(y(at) + factors[2] * interval**2 / 6, abs=1e-9)


@given(seed=st.integers(0, 999))
def test_many_vectors_at_once(seed: int) -> None:
    y = np.random.default_rng(seed).normal(size=(3, 5))
    for form in (lambda y: bent(y, 1, 0.1), lambda y: mean(y, 1), lambda y: rate(y, 1, 0.1)):
        assert form(y) == pytest.approx([form(y[:, i]) for i in range(5)])


@pytest.mark.parametrize("cut", [1, 2, 7, 19])
def test_middles_are_not_beside_a_cut(stopping: Callable[..., Stretch], cut: int) -> None:
    stretch = stopping(Constants(interval_s=0.1), K=20, cut=cut)
    assert middles(stretch) == [k for k in range(1, 19) if k not in (cut - 1, cut)]
