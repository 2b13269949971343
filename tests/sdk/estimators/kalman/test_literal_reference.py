"""With the paper's states alone, the stages are the literal filter and smoother of section 6.5.

There, a covariance at every sample and a gain by the inverse of P; here a covariance at every
hundredth of a second, and the adjoint. The inputs of a step are the means of both its ends.
"""

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref_reference.chapter_6.section_6_5_implementation import rts_smoother
from floatref_reference.chapter_6.section_6_6_2_gps import gps_observations

NOISE = Noise(lean_rad=0.0, gnss_height_walk=0.0)
GNSS = Plan(reflects=False)
CONSTANT = Plan(gnss=False, attitude=False, reflects=False)
# A drive that has been shrunk fails for the same reason, after minutes.
laws = settings(deadline=None, max_examples=4, phases=[Phase.explicit, Phase.generate])
SEEDS = st.integers(0, 2**32 - 1)
RATES = st.sampled_from([400, 500, 700])
STOPS = st.tuples(st.floats(0.3, 2.0), st.floats(0.2, 1.5))


def literal(drive, observe):
    run = drive.literal(NOISE, observe)
    return run.x[:, 0], rts_smoother(run)[0][:, 0]


def by_gnss(drive):
    """Return the literal heights of a drive with GNSS, told from where the stage begins."""
    datum = drive.y[0, 0] - drive.lever[2] - drive.height[0]
    deviations = np.sqrt(NOISE.readings())
    return literal(drive, gps_observations(drive.at, drive.y - [datum, 0, 0, 0], deviations))


def assert_same(drive, height_of, plan, expected, within):
    filtered, smoothed = expected
    ours = height_of(KalmanFilter(plan, NOISE), drive)
    np.testing.assert_allclose(ours, filtered, rtol=0, atol=within)
    ours = height_of(KalmanSmoother(plan, NOISE, tolerance_m=0.0), drive)
    np.testing.assert_allclose(ours, smoothed, rtol=0, atol=within)


@pytest.mark.slow
@pytest.mark.cites("(6.9)", "(6.13)", "(6.16)", "(6.17)", "(6.47)", "(6.48)", "(C.3)", "(C.8)")
@laws
@given(seed=SEEDS, rate=RATES, seconds=st.floats(0.5, 2.5), stop=STOPS)
@example(seed=7, rate=400, seconds=10.0, stop=(4.0, 3.0))
@example(seed=8, rate=16000, seconds=0.4, stop=(0.1, 0.2))
def test_with_gnss_they_agree(drive, height_of, seed, rate, seconds, stop):
    drawn = drive(seed, seconds, rate, (stop[0], sum(stop)))
    assert_same(drawn, height_of, GNSS, by_gnss(drawn), within=1e-8)


@pytest.mark.slow
@pytest.mark.cites("(6.16)", "(6.48)")
@laws
@given(seed=SEEDS, rate=RATES, lost=st.integers(1, 8), share=st.floats(0.0, 0.6))
def test_with_gaps_and_readings_that_lack_a_component(drive, height_of, seed, rate, lost, share):
    """A gap ends before constants would take over; a reading without a height is none at all."""
    drawn = drive(seed, 2.0, rate).without(slice(10, 10 + lost))
    rng = np.random.default_rng(seed)
    drawn.y[:, 1:][rng.uniform(size=(drawn.at.size, 3)) < share] = np.nan
    heightless = slice(20, 20 + lost)
    kept = drawn.without(heightless)
    drawn.y[heightless, 0] = np.nan
    assert_same(drawn, height_of, GNSS, by_gnss(kept), within=1e-8)


@pytest.mark.slow
@pytest.mark.cites("(6.48)")
@laws
@given(seed=SEEDS, lever=st.tuples(*[st.floats(-3.0, 3.0)] * 3))
def test_with_any_lever_arm(drive, height_of, seed, lever):
    drawn = drive(seed, 1.0, 500, lever=lever)
    assert_same(drawn, height_of, GNSS, by_gnss(drawn), within=1e-8)


@laws
@given(seed=SEEDS, lost=st.integers(0, 19), quality=st.sampled_from([0.0, 1.0, 2.0, 5.0]))
def test_a_reading_without_fixed_ambiguities_is_left_out(drive, height_of, seed, lost, quality):
    drawn = drive(seed, 1.0, 400)
    kept = drawn.without(lost)
    drawn.quality[lost] = quality
    drawn.y[lost] += 0.3
    assert_same(drawn, height_of, GNSS, by_gnss(kept), within=1e-8)


def constants(drive, weights):
    """Observe the first height for as many steps at every sample, shape (n,), as ``weights``."""
    y = np.array([drive.height[0] + drive.lever[2], 0, 0, 0])

    def observe(k, x):
        return (y, NOISE.constants(weights[k] * drive.dt)) if weights[k] else None

    return literal(drive, observe)


def per_sub_block(samples, length):
    """Return how many steps the constants of each sample count for; they add up to all steps.

    Those of the last sample count for what is left, less than nothing if the last sub-block is
    not yet half over.
    """
    weights = np.zeros(samples)
    weights[::length] = length
    weights[0] = (length + 1) / 2
    filtering = weights.copy()
    weights[-1] += samples - weights.sum()
    return filtering, weights


@pytest.mark.slow
@pytest.mark.cites("(6.65)", "(6.66)")
@laws
@given(seed=SEEDS, rate=RATES, seconds=st.floats(0.3, 3.0), stop=STOPS)
@example(seed=5, rate=400, seconds=0.0075, stop=(1.0, 1.0))
@example(seed=5, rate=400, seconds=4.0025, stop=(1.0, 1.0))
def test_constants_are_observed_once_per_sub_block(drive, height_of, seed, rate, seconds, stop):
    drawn = drive(seed, seconds, rate, (stop[0], sum(stop)))
    filtering, smoothing = per_sub_block(len(drawn.u), rate // 100)
    expected = constants(drawn, filtering)[0], constants(drawn, smoothing)[1]
    assert_same(drawn, height_of, CONSTANT, expected, within=1e-8)


@pytest.mark.slow
@pytest.mark.cites("(6.65)", "(6.66)")
@settings(laws, max_examples=12)
@given(seed=st.integers(0, 9), seconds=st.sampled_from([0.1, 0.5, 2.0]), more=st.integers(0, 3))
def test_constants_are_as_if_observed_at_every_step(drive, height_of, seed, seconds, more):
    """From the first sample to the last, wherever in a sub-block that is."""
    drawn = drive(seed, seconds + more / 400, 400, (0.4, 0.9))
    smoothed = constants(drawn, np.ones(len(drawn.u)))[1]
    found = height_of(KalmanSmoother(CONSTANT, NOISE, tolerance_m=0.0), drawn)
    np.testing.assert_allclose(found, smoothed, rtol=0, atol=1e-5)
