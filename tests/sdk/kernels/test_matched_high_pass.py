"""The observer filters the profile, and nothing of the vehicle's motion comes through."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import matched_high_pass, state_variable
from floatref.kernels.memories import OBSERVER, STATE_VARIABLE
from floatref.values.arrays import new_record

STEP = 1e-3
SEEDS = st.integers(0, 2**32 - 1)
FEW = settings(deadline=None, max_examples=15)


def integral(x):
    """The trapezoidal integral that starts at zero."""
    return np.concatenate(([0.0], np.cumsum(0.5 * STEP * (x[1:] + x[:-1]))))


def observed(a, h, c):
    r = np.empty(a.size)
    matched_high_pass.observe(a, h, c, r, new_record(OBSERVER), STEP)
    return r


@pytest.mark.cites("(A.1)")
@FEW
@given(seed=SEEDS)
def test_a_flat_road_stays_flat_under_any_cut_off(seed):
    rng = np.random.default_rng(seed)
    a = rng.standard_normal(2000)
    h = 0.3 + integral(integral(a))
    c = np.tan(np.pi * STEP * rng.uniform(0.01, 20.0, 2000))
    assert np.abs(observed(a, h, c) - h).max() <= 1e-12


@pytest.mark.cites("(A.1)")
@FEW
@given(seed=SEEDS, hertz=st.floats(0.05, 20.0))
def test_a_constant_cut_off_is_the_filter_of_the_profile(seed, hertz):
    rng = np.random.default_rng(seed)
    a, h = rng.standard_normal(2000), 0.3 + 0.01 * rng.standard_normal(2000)
    h[0] = 0.3
    profile = integral(integral(a)) - (h - 0.3)
    c = np.tan(np.pi * STEP * hertz)
    expected = np.empty(2000)
    # The profile begins at zero, so either start leaves the stages at rest.
    state_variable.high_pass_1(profile, expected, new_record(STATE_VARIABLE), c, False)
    state_variable.high_pass_2(expected, expected, new_record(STATE_VARIABLE), c, False)
    assert np.abs(observed(a, h, np.full(2000, c)) - h - expected).max() <= 1e-11


@FEW
@given(seed=SEEDS, at=st.integers(1, 98), which=st.integers(0, 2))
def test_a_missing_value_is_the_one_before_it(seed, at, which):
    rng = np.random.default_rng(seed)
    signals = [rng.standard_normal(100), rng.standard_normal(100), rng.uniform(0.0, 0.1, 100)]
    held = [x.copy() for x in signals]
    held[which][at] = held[which][at - 1]
    signals[which][at] = np.nan
    np.testing.assert_array_equal(observed(*signals), observed(*held))


def test_it_waits_for_the_first_height():
    a, c = np.ones(9), np.full(9, 1e-3)
    h = np.full(9, 0.3)
    late = h.copy()
    late[:4] = np.nan
    r = observed(a, late, c)
    assert not r[:4].any()
    np.testing.assert_array_equal(r[4:], observed(a[4:], h[4:], c[4:]))
