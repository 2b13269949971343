"""The state-variable kernels are the filters of appendix A, and stay so at very low cut-offs."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import state_variable
from floatref.kernels.memories import STATE_VARIABLE
from floatref.values.arrays import new_record
from floatref_reference.appendix_a import filters

CUTOFFS = st.floats(1e-4, 0.45)
SEEDS = st.integers(0, 2**32 - 1)
PAIRS = {
    ("high_pass_1", False): filters.hpf_b3s1,
    ("high_pass_2", False): filters.hpf_b3s2,
    ("low_pass_1", False): filters.lpf_b3s1,
    ("low_pass_2", False): filters.lpf_b3s2,
    ("high_pass_1", True): filters.hpf_b3s1r,
    ("high_pass_2", True): filters.hpf_b3s2r,
    ("low_pass_1", True): filters.lpf_b3s1r,
    ("low_pass_2", True): filters.lpf_b3s2r,
}


def filtered(name, x, cutoff, backward):
    y = np.empty(x.size)
    memory = new_record(STATE_VARIABLE)
    getattr(state_variable, name)(x, y, memory, math.tan(math.pi * cutoff), backward)
    return y


@pytest.mark.cites("(A.2) to (A.19)")
@pytest.mark.parametrize(("name", "backward"), PAIRS)
@settings(deadline=None, max_examples=15)
@given(cutoff=CUTOFFS, seed=SEEDS, offset=st.floats(-1e3, 1e3))
def test_each_kernel_is_the_printed_recursion(name, backward, cutoff, seed, offset):
    x = offset + np.random.default_rng(seed).standard_normal(200)
    expected = PAIRS[name, backward](x, cutoff, 1.0)
    scale = np.abs(x).max()
    assert np.abs(filtered(name, x, cutoff, backward) - expected).max() <= 1e-12 * scale


@pytest.mark.parametrize("name", ["high_pass_1", "high_pass_2", "low_pass_1", "low_pass_2"])
def test_accuracy_holds_at_a_fiftieth_of_a_hertz_and_16_khz(name):
    x = np.random.default_rng(1).standard_normal(4000).cumsum()
    cutoff = 0.02 / 16_000.0
    expected = PAIRS[name, False](x, cutoff, 1.0)
    error = np.abs(filtered(name, x, cutoff, False) - expected).max()
    assert error <= 1e-12 * np.abs(x).max()


@settings(deadline=None, max_examples=25)
@given(cutoff=CUTOFFS, seed=SEEDS, backward=st.booleans(), lost=st.sets(st.integers(0, 63)))
def test_the_fused_kernel_is_its_two_parts(cutoff, seed, backward, lost):
    x = np.random.default_rng(seed).standard_normal(64)
    x[list(lost)] = np.nan
    c = math.tan(math.pi * cutoff)
    y = np.empty(x.size)
    second, first = new_record(STATE_VARIABLE), new_record(STATE_VARIABLE)
    state_variable.high_pass_21(x, y, second, first, c, backward)
    apart = filtered("high_pass_1", filtered("high_pass_2", x, cutoff, backward), cutoff, backward)
    assert np.abs(y - apart).max() <= 1e-12


@pytest.mark.parametrize(("name", "backward"), PAIRS)
@given(cutoff=CUTOFFS, seed=SEEDS, at=st.integers(1, 98))
@settings(deadline=None, max_examples=10)
def test_a_missing_sample_is_the_one_before_it(name, backward, cutoff, seed, at):
    x = np.random.default_rng(seed).standard_normal(100)
    held = x.copy()
    held[at] = x[at + 1] if backward else x[at - 1]
    x[at] = np.nan
    np.testing.assert_array_equal(
        filtered(name, x, cutoff, backward), filtered(name, held, cutoff, backward)
    )


def test_nothing_but_missing_samples_gives_zero():
    assert not filtered("high_pass_2", np.full(5, np.nan), 0.1, False).any()
