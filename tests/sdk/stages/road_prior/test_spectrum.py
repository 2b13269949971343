"""The run's own road: second differences by plain loops, and drawn roads of known spectra."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels.road_spectrum import LONG, SHORT
from floatref.stages.road_prior import RoadPrior
from floatref.stages.road_prior.spectrum import LAGS, LEAST, LONGEST_S, RoadSpectrum

INTERVAL_S = 0.002
laws = settings(deadline=None, max_examples=20)


def drawn(seed, q, g, metres, speed):
    """Return elevation at nodes of a constant ``speed``, of white slope and long waves."""
    rng, travel = np.random.default_rng(seed), speed * INTERVAL_S
    count = round(metres / travel)
    slope = np.cumsum(np.sqrt(g * travel) * rng.normal(size=count))
    rises = slope * travel + np.sqrt(q * travel) * rng.normal(size=count)
    return np.cumsum(rises), np.full(count, travel)


def mean_squares(points, lag, start, share):
    """Return the sliding mean of squared second differences over ``lag`` points."""
    found = start
    for k in range(2 * lag, len(points)):
        bend = points[k] - 2 * points[k - lag] + points[k - 2 * lag]
        found += share * (min(bend * bend, 9 * found) - found)
    return found


@pytest.mark.cites("(2.4)")
@pytest.mark.parametrize(("q", "g"), [(1e-6, 2e-7), (1e-5, 1e-8), (5e-5, 5e-6), (4e-6, 0.0)])
def test_of_a_long_road_it_is_the_spectrum(q, g):
    constants = RoadPrior(road_memory_m=20e3)
    spectrum = RoadSpectrum.of(constants, INTERVAL_S)
    spectrum.add(*drawn(3, q, g, 100e3, 20.0))
    found = spectrum.road()
    expected = np.maximum((q, g), spectrum.least)
    squares = np.array([[2 * lag, 2 / 3 * lag**3] for lag in LAGS])
    kept = spectrum.memory[[SHORT, LONG]]
    np.testing.assert_allclose(kept, squares @ (q, g), rtol=0.15)
    assert (np.abs(found - expected) < 0.35 * expected + (0.0, 2e-8)).all()


@laws
@given(seed=st.integers(0, 2**32 - 1), cuts=st.lists(st.integers(1, 9999), max_size=5))
def test_it_is_the_plain_mean_and_pieces_make_no_difference(seed, cuts):
    spectrum = RoadSpectrum.of(RoadPrior(), INTERVAL_S)
    elevation, travel = drawn(seed, 4e-6, 2e-7, 800.0, 40.0)
    for piece in np.split(np.arange(10000), sorted(cuts)):
        spectrum.add(elevation[piece], travel[piece])
    # A point is taken as soon as a metre has been travelled: 12.5 nodes of 80 mm.
    gone, points = 0.0, []
    for k in range(10000):
        gone += travel[k]
        if gone >= 1.0:
            points.append(elevation[k])
            gone %= 1.0
    for place, lag in zip((SHORT, LONG), LAGS, strict=True):
        start = 2 * lag * 4e-6 + 2 / 3 * lag**3 * 2e-7
        expected = mean_squares(points, lag, start, 1 / 300)
        assert spectrum.memory[place] == pytest.approx(expected, rel=1e-9)


@laws
@given(seed=st.integers(0, 2**32 - 1), begin=st.integers(0, 4000))
def test_what_is_slow_or_missing_tells_nothing(seed, begin):
    spectrum, constants = RoadSpectrum.of(RoadPrior(), INTERVAL_S), RoadPrior()
    slow = 2 * LAGS[0] / LONGEST_S / 1.2
    spectrum.add(*drawn(seed, 1e-4, 1e-5, 60.0, slow))
    elevation, travel = drawn(seed, 1e-4, 1e-5, 400.0, 20.0)
    elevation[:] = np.nan
    spectrum.add(elevation[begin:], travel[begin:])
    np.testing.assert_allclose(spectrum.road(), (constants.road, constants.long_waves), rtol=1e-6)


def test_a_bump_is_no_road_and_no_road_is_much_smoother_than_at_the_start():
    constants = RoadPrior()
    spectrum, flat = RoadSpectrum.of(constants, INTERVAL_S), np.zeros(400_000)
    spectrum.add(flat, np.full(flat.size, 0.04))
    least = LEAST * np.array([constants.road, constants.long_waves])
    np.testing.assert_allclose(spectrum.road(), least)
    usual = RoadSpectrum.of(constants, INTERVAL_S)
    bump = np.where(np.arange(5000) * 0.04 > 100.0, 0.2, 0.0)
    usual.add(bump, np.full(bump.size, 0.04))
    # Twice sixteen points see it, each as three deviations.
    most = (1 + 8 / 300) ** 32
    assert (usual.road() < most * np.array([constants.road, 2 * constants.long_waves])).all()
