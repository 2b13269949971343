"""GNSS that is lost in mid-run, comes back with another datum, leaps or reads nonsense."""

from copy import deepcopy

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref.measures import high_pass

RATE, SECONDS = 200, 30.0
laws = settings(deadline=None, max_examples=3, phases=[Phase.generate])
SEEDS = st.integers(0, 2**32 - 1)
PLANS = st.sampled_from([Plan(), Plan(attitude=False)])
STOP = (14.0, 16.0)


def change(drive, disturbed, height_of, plan):
    """Return what a disturbance changes in the reference height, over time and over distance."""
    ours, expected = (height_of(KalmanSmoother(plan, Noise()), d) for d in (disturbed, drive))
    place, first = np.unique(drive.distance, return_index=True)
    even = np.arange(0.0, place[-1], 0.5)
    moved = ours - expected
    return moved, high_pass(np.interp(even, place, moved[first]), 0.5)


def assert_smooth(drive, disturbed, height_of, plan):
    """A centimetre a second, and three millimetres after the filter, are no step."""
    moved, delivered = change(drive, disturbed, height_of, plan)
    assert np.abs(np.diff(moved)).max() * RATE < 0.01
    assert np.abs(delivered).max() < 0.003


@laws
@given(
    seed=SEEDS,
    plan=PLANS,
    begin=st.integers(100, 400),
    lasts=st.integers(11, 100),
    rise=st.floats(-9.0, 9.0),
    quality=st.sampled_from([0.0, 1.0, 5.0]),
)
def test_an_outage_and_another_datum_leave_no_step(
    drive, height_of, seed, plan, begin, lasts, rise, quality
):
    """For up to five seconds, at speed or about a stop; heights without a fix are metres off."""
    drawn = drive(seed, SECONDS, RATE, STOP)
    disturbed = deepcopy(drawn)
    lost = slice(begin, begin + lasts)
    disturbed.quality[lost], disturbed.y[lost] = quality, disturbed.y[lost] + 7.0
    disturbed.y[lost.stop :, 0] += rise
    assert_smooth(drawn, disturbed, height_of, plan)


@laws
@given(seed=SEEDS, plan=PLANS, at=st.integers(40, 540), leap=st.floats(0.5, 5.0), up=st.booleans())
def test_a_leap_of_the_height_leaves_no_step(drive, height_of, seed, plan, at, leap, up):
    """Readings say that they are fixed, before and after."""
    drawn = drive(seed, SECONDS, RATE, STOP)
    disturbed = deepcopy(drawn)
    disturbed.y[at:, 0] += leap if up else -leap
    assert_smooth(drawn, disturbed, height_of, plan)


@pytest.mark.parametrize("stage", [KalmanFilter, KalmanSmoother])
@laws
@given(
    seed=SEEDS, at=st.sets(st.integers(60, 150), min_size=1, max_size=10), kind=st.integers(0, 3)
)
def test_a_wild_reading_is_as_good_as_none(drive, height_of, stage, seed, at, kind):
    """Of height, velocity, pitch or roll; so few are no other datum."""
    drawn, wild = drive(seed, 8.0, RATE), drive(seed, 8.0, RATE)
    lost, off = sorted(at), [1.5, -3.0, 0.3, -0.3][kind]
    wild.y[lost, kind] += off
    drawn.y[lost, kind] = np.nan
    drawn = drawn.without(lost) if kind == 0 else drawn
    if kind == 0:
        wild.y[lost, 1:] = np.nan
    plan = Plan(reflects=False)
    ours, expected = (height_of(stage(plan, Noise(gnss_height_walk=0.0)), d) for d in (wild, drawn))
    np.testing.assert_allclose(ours, expected, rtol=0, atol=1e-6)
