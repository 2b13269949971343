"""The five variants of section 6.6 with the paper's states alone, where the vehicle moves.

What they observe then is the print's, and so are their heights; what happens at a stop is told
and tested with the further states.
"""

import numpy as np
import pytest

from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref_reference.chapter_6.section_6_5_implementation import rts_smoother
from floatref_reference.chapter_6.section_6_6_2_gps import gps_observations

NOISE = Noise(lean_rad=0.0, gnss_height_walk=0.0)
RATE, SUB_BLOCK = 500, 5


@pytest.fixture(params=[3, 4])
def moving(drive, request):
    return drive(request.param, 1.5, RATE, (50.0, 51.0))


def readings(drive, attitude):
    y = drive.y - [drive.y[0, 0] - drive.lever[2] - drive.height[0], 0, 0, 0]
    variance = NOISE.readings()
    if not attitude:
        y[:, 2:], variance[2:] = 0.0, NOISE.constants(0.05)[2:]
    return gps_observations(drive.at, y, np.sqrt(variance))


def constants(drive):
    y = np.array([drive.height[0] + drive.lever[2], 0, 0, 0])

    weights = np.where(np.arange(len(drive.u)) % SUB_BLOCK, 0.0, SUB_BLOCK)
    weights[0] = (SUB_BLOCK + 1) / 2
    weights[-1] += len(drive.u) - weights.sum()

    def observe(k, x):
        return (y, NOISE.constants(weights[k] * drive.dt)) if weights[k] else None

    return observe


def assert_smoothed(drive, height_of, plan, observe):
    expected = rts_smoother(drive.literal(NOISE, observe))[0][:, 0]
    found = height_of(KalmanSmoother(plan, NOISE, tolerance_m=0.0), drive)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8)


@pytest.mark.cites("Table 6.2", "(6.10)", "(C.6)")
def test_the_filter(moving, height_of):
    expected = moving.literal(NOISE, readings(moving, attitude=True)).x[:, 0]
    found = height_of(KalmanFilter(Plan(reflects=False), NOISE), moving)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8)


@pytest.mark.cites("Table 6.3", "Table 6.4", "(6.10)", "(C.6)")
@pytest.mark.parametrize("reflects", [False, True])
def test_the_smoother_and_with_reflection(moving, height_of, reflects):
    plan = Plan(reflects=reflects)
    assert_smoothed(moving, height_of, plan, readings(moving, attitude=True))


@pytest.mark.cites("Table 6.5", "(6.62)")
def test_a_constant_attitude(moving, height_of):
    plan = Plan(attitude=False)
    assert_smoothed(moving, height_of, plan, readings(moving, attitude=False))


@pytest.mark.cites("Table 6.6", "(6.65)")
def test_a_constant_height_and_attitude(moving, height_of):
    plan = Plan(gnss=False, attitude=False)
    assert_smoothed(moving, height_of, plan, constants(moving))
