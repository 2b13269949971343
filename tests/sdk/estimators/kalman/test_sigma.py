"""1-sigma of the delivered elevation: the filter over distance, and what errors really do."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanSmoother, Noise, Plan
from floatref.estimators.smoothing.sigma import Settled, high_pass, sigma
from floatref.measures import high_pass as filtered
from floatref.values.channels import ChannelId

G, WAVELENGTH_M = 9.80665, 105.91
SIGMA, REFERENCE = (ChannelId(n, "left") for n in ("elevation_sigma", "floating_reference_height"))
laws = settings(deadline=None, max_examples=20)
SEEDS = st.integers(0, 2**32 - 1)


@laws
@given(
    seed=SEEDS,
    count=st.integers(1, 80),
    wavelength_m=st.floats(20.0, 200.0),
    stop=st.integers(0, 30),
)
def test_a_shift_of_the_whole_run_does_not_pass_the_filter(seed, count, wavelength_m, stop):
    """Rows sum to zero, and the low-pass sees all that the high-pass does not."""
    steps = np.random.default_rng(seed).uniform(0.0, 8.0, count)
    steps[stop : stop + 5] = 0.0
    weights = high_pass(np.cumsum(steps), wavelength_m, np.arange(count))
    np.testing.assert_allclose(weights.sum(axis=1), 0.0, atol=1e-12)
    low = np.eye(count) - weights
    near = np.abs(np.subtract.outer(np.cumsum(steps), np.cumsum(steps))) < 0.4 * wavelength_m
    assert low[near].min() > -1e-12


@pytest.mark.cites("(2.10)")
@laws
@given(cycles_per_m=st.floats(1 / 400.0, 1 / 15.0), phase=st.floats(0.0, 6.3))
def test_waves_pass_as_they_pass_the_filter_of_the_profile(cycles_per_m, phase):
    """In the middle of a kilometre, at marks 4 m apart, and between nodes that crowd at a stop."""
    place = np.concatenate((np.arange(0.0, 600.0, 4.0), np.full(9, 600.0), np.arange(604, 1200, 4)))
    row = high_pass(place, WAVELENGTH_M, np.array([140]))[0]
    found = row @ np.sin(2 * np.pi * cycles_per_m * place + phase)
    dense = np.arange(-2000.0, 3200.0, 0.5)
    waves = np.sin(2 * np.pi * cycles_per_m * dense + phase)
    expected = filtered(waves, 0.5)[np.argmin(np.abs(dense - place[140]))]
    assert found == pytest.approx(expected, abs=0.01)


def marks(seed, count):
    """Return marks between which nothing is passed on: errors of each are its own."""
    rng = np.random.default_rng(seed)
    column, left = np.zeros((2, count, 10))
    column[:, 0], left[:, 0] = rng.uniform(1e-8, 1e-4, count), 1.0
    place = np.cumsum(rng.uniform(0.5, 8.0, count))
    return Settled(np.arange(count), place, column, *np.zeros((2, count, 10, 10)), left)


@laws
@given(seed=SEEDS, count=st.integers(2, 40), noise_m=st.floats(0.0, 0.01), data=st.data())
def test_errors_that_have_nothing_in_common_add_as_squares(seed, count, noise_m, data):
    drawn = marks(seed, count)
    first = data.draw(st.integers(0, count - 1))
    found = sigma(drawn, first, count, 40.0, noise_m)
    weights = high_pass(drawn.distance_m, 40.0, np.arange(first, count))
    expected = np.sqrt(weights**2 @ drawn.column[:, 0] + noise_m**2)
    np.testing.assert_allclose(found, expected, rtol=1e-9)


NOISE = Noise(acceleration=1e-3, acceleration_walk=2e-3, gnss_height_walk=3e-3, height_m=2e-4)
RATE, SECONDS = 100, 40.0


def resting(drive, seed, speed):
    """Return a level run without motion whose errors are what the filter takes them for."""
    drawn = drive(0, SECONDS, RATE, every_s=0.08, lever=(0.0, 0.0, 0.0), quiet=0.0)
    rng, n, m, dt = np.random.default_rng(seed), len(drawn.u), drawn.at.size, 1 / RATE
    u, y = np.zeros((n, 6)), np.zeros((m, 4))
    walk = NOISE.acceleration_walk * dt**0.5 * rng.normal(size=n)
    white = NOISE.acceleration / dt**0.5 * rng.normal(size=n)
    u[:, 2] = G + np.cumsum(walk) + 0.1 * rng.normal() + white
    slow = NOISE.gnss_height_walk * np.sqrt(np.diff(drawn.at, prepend=0) * dt)
    y[:, 0] = np.cumsum(slow * rng.normal(size=m)) + NOISE.gnss_height_m * rng.normal(size=m)
    y[:, 1] = NOISE.gnss_velocity_mps * rng.normal(size=m)
    return replace(
        drawn, u=u, y=y, speed=np.full(n, speed), height=NOISE.height_m * rng.normal(size=n)
    )


@pytest.mark.slow
@pytest.mark.parametrize("speed", [6.0, 15.0])
def test_errors_of_the_delivered_elevation_are_as_large_as_it_says(drive, through, speed):
    """In the middle of runs; drawn again and again, the squares of error over sigma are one."""
    squares = []
    for seed in range(25):
        drawn = resting(drive, seed, speed)
        out = through(KalmanSmoother(Plan(reflects=False), NOISE, WAVELENGTH_M), drawn)
        error = filtered(out[REFERENCE] - drawn.height, speed / RATE)
        assert out[SIGMA].min() > NOISE.height_m
        squares.append(np.square(error / out[SIGMA])[1000:3000:20])
    assert np.sqrt(np.mean(squares)) == pytest.approx(1.0, abs=0.15)
