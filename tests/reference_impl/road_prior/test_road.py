"""The road in distance: it keeps its variance, and has the spectrum that it is named after."""

from fractions import Fraction
from math import factorial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_prior import road
from floatref_reference.road_prior.symbols import Constants

DISTANCE = st.one_of(st.floats(0, 1e-3), st.floats(0, 500), st.floats(0, 1e5))
ROAD = st.builds(
    lambda q, g, lambda_p: Constants(q=q, g=g, lambda_p=lambda_p),
    st.floats(1e-7, 1e-3),
    st.floats(1e-9, 1e-3),
    st.floats(1, 1000),
)


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(y=st.one_of(st.floats(1e-9, 1), st.floats(0.9, 1.1), st.floats(1, 30)))
def test_moments_are_those_of_the_series_in_fractions(y: float) -> None:
    """Integrated power by power without rounding: Σ (-a)^k ΔX^(n+k+1) / (k! (n + k + 1))."""
    a, dx = Fraction(1, 4), Fraction(y) * 4
    exact = [
        sum((-a) ** k * dx ** (n + k + 1) / (factorial(k) * (n + k + 1)) for k in range(180))
        for n in range(3)
    ]
    expected = np.array([float(value) for value in exact])
    assert road.moments(float(dx), 8.0) == pytest.approx(expected, rel=1e-14)


@settings(deadline=None, max_examples=30)
@given(dx=DISTANCE, c=ROAD)
def test_the_road_neither_grows_nor_shrinks(dx: float, c: Constants) -> None:
    F, P = road.road_transition(dx, c), road.road_prior(c)
    assert F @ P @ F.T + road.road_noise(dx, c) == pytest.approx(P, rel=1e-12)


@settings(deadline=None, max_examples=30)
@given(dx=DISTANCE, c=ROAD)
def test_noise_of_a_step_can_be_told_apart(dx: float, c: Constants) -> None:
    """Elevation and slope of a step are never one of the other, but for a step of none."""
    Q = road.road_noise(dx, c)
    assert np.array_equal(Q, Q.T)
    assert (Q >= 0).all()
    if dx > 1e-3:
        assert abs(Q[0, 1]) < np.sqrt(Q[0, 0] * Q[1, 1])


@settings(deadline=None, max_examples=10)
@given(c=ROAD)
def test_over_no_distance_nothing_changes_at_all(c: Constants) -> None:
    assert np.array_equal(road.road_transition(0.0, c), np.eye(2))
    assert not road.road_noise(0.0, c).any()


@settings(deadline=None, max_examples=20)
@given(q=st.floats(1e-7, 1e-3), g=st.floats(1e-9, 1e-3), lambda_p=st.floats(1, 1000))
def test_a_road_begins_as_one_of_which_all_is_forgotten(
    q: float, g: float, lambda_p: float
) -> None:
    c = Constants(q=q, g=g, lambda_p=lambda_p)
    assert road.road_noise(30 * lambda_p, c) == pytest.approx(road.road_prior(c), rel=1e-12)


@pytest.mark.cites("(2.4)")
@settings(deadline=None, max_examples=10)
@given(G_s=st.floats(1e-6, 3e-4), G_a=st.floats(1e-8, 1e-4), dx=st.floats(0.01, 0.1))
def test_short_of_its_memory_the_road_has_the_spectrum_of_its_name(
    G_s: float, G_a: float, dx: float
) -> None:
    """The spectrum of samples dx apart, from waves of 400 m to those of 100 dx.

    They are a sum of the noise of all steps before, so their spectrum is that of white noise
    through (1 - F e^{-iω})⁻¹.
    """
    c = Constants(q=G_s / 2, g=G_a / 2, lambda_p=1e4)
    F, Q = road.road_transition(dx, c), road.road_noise(dx, c)
    for nu in np.geomspace(1 / 400, 1 / (100 * dx), 7):
        through = np.linalg.inv(np.eye(2) - F * np.exp(-2j * np.pi * nu * dx))
        density = 2 * dx * (through @ Q @ through.conj().T)[0, 0].real
        expected = G_s / (2 * np.pi * nu) ** 2 + G_a / (2 * np.pi * nu) ** 4
        assert density == pytest.approx(expected, rel=2e-3)


@pytest.mark.cites("(2.2)")
@settings(deadline=None, max_examples=10)
@given(G_s=st.floats(1e-6, 3e-4), dx=st.floats(0.01, 2.0))
def test_without_long_waves_it_has_a_constant_slope_spectrum(G_s: float, dx: float) -> None:
    """The square of z(x + Δx) - z(x) from the spectrum G_s/(2πν)² and from the process."""
    y = (np.arange(400_000) + 0.5) * 1e-2
    tail = 1 / 4000
    spectral = G_s * dx / np.pi * (np.sum((1 - np.cos(y)) / y**2) * 1e-2 + tail)
    c = Constants(q=G_s / 2, g=0.0, lambda_p=1e6)
    alpha, new = road.road_transition(dx, c)[0, 0], road.road_noise(dx, c)[0, 0]
    square = new + (1 - alpha) ** 2 * road.road_prior(c)[0, 0]
    assert square == pytest.approx(spectral, rel=1e-3)
