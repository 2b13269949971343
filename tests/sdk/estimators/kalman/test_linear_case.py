"""Level and without rotation all is linear: heights and covariances are those of least squares.

The least squares solve for the start and every noise of the run at once: white acceleration and
the walk of its bias at each step, and the drift of GNSS between its readings.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanSmoother, Noise, Plan
from floatref.estimators.smoothing.sigma import Settled, covariances

NOISE = Noise(acceleration=2e-3, acceleration_walk=5e-3, gnss_height_walk=4e-3, reflection=1e-4)
G, LIFT = 9.80665, 1.6
laws = settings(deadline=None, max_examples=3, phases=[Phase.explicit, Phase.generate])
SEEDS = st.integers(0, 2**32 - 1)
STOP = st.sampled_from([(9, 9), (0, 60), (90, 140), (100, 401)])


class Dense(NamedTuple):
    """Smoothed heights, shape (n,), and their covariance, shape (n, n)."""

    height: np.ndarray
    covariance: np.ndarray


def level(drive, seed, rate, stop, count):
    """Return a drive of a body that stays level, whose readings agree with nothing else."""
    drawn = drive(0, count / rate, rate, every_s=0.08, lever=(0.0, 0.0, LIFT), quiet=0.0)
    rng = np.random.default_rng(seed)
    u = np.zeros((count, 6))
    u[:, 2] = G + np.convolve(rng.normal(size=count), np.ones(8) / 8, "same")
    speed = np.full(count, 6.0)
    speed[slice(*stop)] = 0.0
    y = np.zeros((drawn.at.size, 4))
    y[:, :2] = 0.02 * rng.normal(size=(drawn.at.size, 2))
    y[0, 0], y[rng.uniform(size=y.shape[0]) < 0.2, 1] = 0.0, np.nan
    height = 0.3 + 0.001 * rng.normal(size=count)
    y[:, 0] += LIFT + height[0]
    return replace(drawn, u=u, speed=speed, height=height, y=y)


def motion(drive):
    """Return height and velocity at all samples: known part (n, 2), and by the unknowns."""
    dt, steps = drive.dt, len(drive.u) - 1
    known, by = np.zeros((steps + 1, 3)), np.zeros((steps + 1, 3, 3 + 2 * steps + drive.at.size))
    known[0, 0] = drive.height[0]
    by[0, :, :3] = np.diag([1.0, 1.0, 0.1])
    A = np.array([[1, dt, dt**2 / 2], [0, 1, dt], [0, 0, 1]])
    white, walk = NOISE.acceleration / dt**0.5, NOISE.acceleration_walk * dt**0.5
    up = (drive.u[:-1, 2] + drive.u[1:, 2]) / 2 - G
    for k in range(steps):
        known[k + 1] = A @ known[k] + np.array([dt**2 / 2, dt, 0]) * up[k]
        by[k + 1] = A @ by[k]
        by[k + 1, :2, 3 + k] = white * np.array([dt**2 / 2, dt])
        by[k + 1, 2, 3 + steps + k] = walk
    return known[:, :2], by[:, :2]


def observations(drive, known, by, plan):
    """Yield rows of the unknowns and what they should make, each over its deviation."""
    still = (drive.speed == 0) & plan.reflects
    drift, heard = np.zeros(by.shape[2]), 0
    for m, k in enumerate(drive.at):
        if not still[k]:
            drift[by.shape[2] - drive.at.size + m] = (
                NOISE.gnss_height_walk * ((k - heard) * drive.dt) ** 0.5
            )
            heard = k
            rise = drive.y[m, 0] - LIFT - known[k, 0]
            yield (by[k, 0] + drift) / NOISE.gnss_height_m, rise / NOISE.gnss_height_m
        if not np.isnan(drive.y[m, 1]):
            climb = drive.y[m, 1] - known[k, 1]
            yield by[k, 1] / NOISE.gnss_velocity_mps, climb / NOISE.gnss_velocity_mps
    block = max(1, round(0.01 / drive.dt))
    nodes = [k for k in range(0, len(by), block) if still[k]]
    sigma = NOISE.reflection / (block * drive.dt) ** 0.5
    for k in nodes[1:]:
        rise = drive.height[k] - drive.height[nodes[0]] - known[k, 0] + known[nodes[0], 0]
        yield (by[k, 0] - by[nodes[0], 0]) / sigma, rise / sigma


def least_squares(drive, plan):
    known, by = motion(drive)
    rows, right = zip(*observations(drive, known, by, plan), strict=True)
    size = by.shape[2]
    design = np.eye(size + len(rows), size + 1)
    design[size:, :size], design[:, size] = rows, np.concatenate((np.zeros(size), right))
    triangle = np.linalg.qr(design, "r")
    root = np.linalg.solve(triangle[:size, :size].T, by[:, 0].T).T
    return Dense(known[:, 0] + root @ triangle[:size, size], root @ root.T)


PLANS = st.sampled_from([Plan(), Plan(reflects=False)])


@pytest.mark.slow
@pytest.mark.cites("(6.5)", "(6.7)", "(6.17)")
@laws
@given(seed=SEEDS, rate=st.sampled_from([100, 200, 300]), stop=STOP, plan=PLANS)
def test_smoothed_heights_are_those_of_least_squares(drive, height_of, seed, rate, stop, plan):
    drawn = level(drive, seed, rate, stop, 161)
    ours = height_of(KalmanSmoother(plan, NOISE, tolerance_m=0.0), drawn)
    np.testing.assert_allclose(ours, least_squares(drawn, plan).height, rtol=0, atol=1e-8)


@pytest.mark.slow
@pytest.mark.cites("(6.22)")
@laws
@given(seed=SEEDS, stop=STOP, plan=PLANS)
def test_covariances_are_those_of_least_squares(drive, seed, stop, plan):
    """Between any two marks of a run that is a single segment.

    They are differences from the filter's variances, whose rounding they keep.
    """
    drawn = level(drive, seed, 100, stop, 512)
    stage = KalmanSmoother(plan, NOISE, tolerance_m=0.0)
    stage.start(drawn.header)
    for block in drawn.blocks():
        stage.push(block)
    (segment,) = stage.memory["backlog"].lines["left"].segments
    found = covariances(Settled.of([segment.marks]))
    at = segment.marks.at
    expected = least_squares(drawn, plan).covariance[np.ix_(at, at)]
    assert at.size > 4
    rounding = 1e-8 * segment.marks.column[:, 0].max()
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6 * expected.max() + rounding)
