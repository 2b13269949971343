"""HPF_B3x2 and LPF_B3x2 against the printed recursions and against their transfer functions."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures.roughness.zero_phase import high_pass_b3x2, low_pass_b3x2
from floatref_reference.appendix_a import filters

INTERVAL = 0.00508


@pytest.mark.parametrize(
    ("fast", "literal"),
    [(high_pass_b3x2, filters.hpf_b3x2), (low_pass_b3x2, filters.lpf_b3x2)],
)
@settings(deadline=None, max_examples=15)
@given(wavelength=st.floats(3.0, 500.0), seed=st.integers(0, 2**32 - 1))
def test_each_set_is_the_printed_one(fast, literal, wavelength, seed):
    x = np.random.default_rng(seed).standard_normal(300)
    expected = literal(x, 1.0 / wavelength, 1.0)
    assert np.abs(fast(x, 1.0, wavelength) - expected).max() <= 1e-11


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 2**32 - 1))
def test_the_middle_of_a_long_signal_has_no_phase(seed):
    x = np.zeros(4001)
    x[1500:2501] = np.random.default_rng(seed).standard_normal(1001)
    mirrored = high_pass_b3x2(x[::-1].copy(), 1.0, 60.0)[::-1]
    assert np.abs(high_pass_b3x2(x, 1.0, 60.0) - mirrored).max() <= 1e-9


def test_one_point_and_none():
    assert high_pass_b3x2(np.zeros(0), INTERVAL, 105.91).size == 0
    assert low_pass_b3x2(np.array([2.0]), INTERVAL, 1.0) == pytest.approx([2.0])
