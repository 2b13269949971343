"""Lean, drift of the GNSS height and the height where a stop began are states like the others.

Constants stand in for GNSS that is lost, or was never there.
"""

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import Noise, Plan

pytestmark = pytest.mark.slow

# A drive that has been shrunk fails for the same reason, after minutes.
laws = settings(deadline=None, max_examples=4, phases=[Phase.explicit, Phase.generate])
SEEDS = st.integers(0, 2**32 - 1)
STOP = (1.2, 2.1)
NOISES = st.builds(
    Noise,
    lean_rad=st.sampled_from([0.0, 0.01, 0.05]),
    gnss_height_walk=st.sampled_from([0.0, 1.5e-3, 0.02]),
    acceleration_walk=st.sampled_from([3e-5, 1e-3]),
)


@pytest.mark.cites("(6.58)", "(6.59)")
@laws
@given(seed=SEEDS, noise=NOISES, begin=st.floats(0.0, 2.0), lasts=st.floats(0.02, 1.5))
@example(seed=1, noise=Noise(), begin=-9.0, lasts=9.5)
def test_at_a_stop_the_height_sensor_is_observed(drive, assert_same, seed, noise, begin, lasts):
    """The stop may begin before the run, or have no sub-block's end in it."""
    assert_same(drive(seed, 3.0, 400, (begin, begin + lasts)), noise, Plan())


@laws
@given(seed=SEEDS, noise=NOISES)
def test_without_a_stop_lean_and_drift_alone(drive, assert_same, seed, noise):
    assert_same(drive(seed, 2.5, 400, (0.6, 0.9)), noise, Plan(reflects=False))


@laws
@given(seed=SEEDS, begin=st.sampled_from([1.2, 4.6, 7.5, 99.0]), plan=st.builds(Plan))
def test_the_lean_is_another_after_a_constant_speed(drive, assert_same, seed, begin, plan):
    assert_same(drive(seed, 8.5, 200, (begin, begin + 0.3)), Noise(), plan)


@pytest.mark.cites("(6.62)", "(6.63)")
@laws
@given(seed=SEEDS, noise=NOISES)
def test_a_constant_attitude_comes_with_every_reading(drive, assert_same, seed, noise):
    assert_same(drive(seed, 2.5, 400, STOP), noise, Plan(attitude=False))


@laws
@given(seed=SEEDS, every_s=st.sampled_from([0.01, 0.02, 0.1, 0.2]))
def test_readings_that_crowd_count_for_less(drive, assert_same, seed, every_s):
    assert_same(drive(seed, 2.0, 400, STOP, every_s=every_s), Noise(), Plan())


@pytest.mark.cites("(6.65)", "(6.66)")
@laws
@given(seed=SEEDS, plan=st.sampled_from([Plan(gnss=False), Plan(), Plan(reflects=False)]))
def test_without_any_gnss_constants_are_observed(drive, assert_same, seed, plan):
    """A plan with GNSS waits half a second for it."""
    drawn = drive(seed, 2.5, 400, STOP)
    drawn = drawn.without(slice(None)) if plan.gnss else drawn
    assert_same(drawn, Noise(), plan)


@laws
@given(
    seed=SEEDS,
    outages=st.lists(
        st.tuples(st.sampled_from([0, 2, 15, 33, 55]), st.integers(3, 20)), min_size=1, max_size=3
    ),
    plan=st.builds(Plan, attitude=st.booleans(), reflects=st.booleans()),
)
def test_constants_stand_in_for_gnss_that_is_lost(drive, assert_same, seed, outages, plan):
    """Heights are held where each outage begins; afterwards GNSS may have another datum."""
    drawn = drive(seed, 4.0, 400, STOP)
    lost = np.concatenate([np.arange(a, min(a + n, drawn.at.size)) for a, n in outages])
    assert_same(drawn.without(np.unique(lost)), Noise(), plan)
