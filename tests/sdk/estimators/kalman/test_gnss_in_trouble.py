"""GNSS that is lost in mid-run, comes back with another datum, leaps or reads nonsense."""

from copy import deepcopy

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref.measures import high_pass
from floatref.values.channels import ChannelId
from floatref_reference.chapter_6.section_6_3_6_system import h as measured

SIGMA, REFERENCE = (ChannelId(n, "left") for n in ("elevation_sigma", "floating_reference_height"))
RATE, SECONDS = 200, 30.0
laws = settings(deadline=None, max_examples=3, phases=[Phase.explicit, Phase.generate])
SEEDS = st.integers(0, 2**32 - 1)
PLANS = st.sampled_from([Plan(), Plan(attitude=False)])
STOP = (14.0, 16.0)


def over_distance(drive, samples):
    """Return what belongs to every half metre."""
    place, first = np.unique(drive.distance, return_index=True)
    return np.interp(np.arange(0.0, place[-1], 0.5), place, samples[first])


def assert_smooth(drive, moved):
    """A centimetre a second, and three millimetres after the filter, are no step."""
    assert np.abs(np.diff(moved)).max() * RATE < 0.01
    assert np.abs(high_pass(over_distance(drive, moved), 0.5)).max() < 0.003


def wrong_by(drive, lost):
    """Return by how many σ the constant height and velocity (6.65) are wrong in an outage."""
    samples = range(drive.at[lost.start - 1] + RATE // 2, drive.at[lost.stop])
    true = np.array([measured(drive.x[k], drive.u[k], drive.lever)[:2] for k in samples])
    squares = (true - [true[0, 0], 0.0]) ** 2 / Noise().constants(1.0 / RATE)[:2]
    return np.sqrt(squares.sum())


OUTAGES = {
    "seed": SEEDS,
    "plan": PLANS,
    "begin": st.integers(100, 400),
    "lasts": st.integers(11, 100),
}


@laws
@given(**OUTAGES, rise=st.floats(-9.0, 9.0), quality=st.sampled_from([0.0, 1.0, 5.0]))
def test_readings_without_a_fix_and_another_datum_are_an_outage_and_no_more(
    drive, height_of, seed, plan, begin, lasts, rise, quality
):
    """For up to five seconds, at speed or about a stop; heights without a fix are metres off."""
    drawn = drive(seed, SECONDS, RATE, STOP)
    disturbed = deepcopy(drawn)
    lost = slice(begin, begin + lasts)
    disturbed.quality[lost], disturbed.y[lost] = quality, disturbed.y[lost] + 7.0
    disturbed.y[lost.stop :, 0] += rise
    both = disturbed, drawn.without(lost)
    ours, expected = (height_of(KalmanSmoother(plan, Noise()), d) for d in both)
    np.testing.assert_allclose(ours, expected, rtol=0, atol=1e-6)


@laws
@given(**OUTAGES)
@example(seed=6024, plan=Plan(attitude=False), begin=175, lasts=98)
def test_an_outage_leaves_no_step(drive, through, seed, plan, begin, lasts):
    """A micrometre between two samples is none, nor is what constants can do by being wrong.

    The elevation is a sum of what is observed: g_i d_i for errors d_i of 1-σ s_i, and its own σ²
    is the sum of (g_i s_i)² over all. So the constants, whose errors are the vehicle's true motion
    in the outage, move it by no more than σ √(Σ (d_i / s_i)²) (Cauchy and Schwarz). What sensors
    and receiver read wrong differs by 5 σ between the two at most. Attitude is as well known
    before and behind as in the outage, or a constant in both, and has no part in it.
    """
    drawn = drive(seed, SECONDS, RATE, STOP)
    lost = slice(begin, begin + lasts)
    ours, expected = (
        through(KalmanSmoother(plan, Noise()), d) for d in (drawn.without(lost), drawn)
    )
    moved = ours[REFERENCE] - expected[REFERENCE]
    assert np.abs(np.diff(moved, 2)).max() < 1e-6
    delivered = np.abs(high_pass(over_distance(drawn, moved), 0.5))
    assert (delivered < over_distance(drawn, ours[SIGMA]) * (5.0 + wrong_by(drawn, lost))).all()
    if plan.attitude:
        assert_smooth(drawn, moved)


@laws
@given(seed=SEEDS, plan=PLANS, at=st.integers(40, 540), leap=st.floats(0.5, 5.0), up=st.booleans())
def test_a_leap_of_the_height_leaves_no_step(drive, height_of, seed, plan, at, leap, up):
    """Readings say that they are fixed, before and after."""
    drawn = drive(seed, SECONDS, RATE, STOP)
    disturbed = deepcopy(drawn)
    disturbed.y[at:, 0] += leap if up else -leap
    ours, expected = (height_of(KalmanSmoother(plan, Noise()), d) for d in (disturbed, drawn))
    assert_smooth(drawn, ours - expected)


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
