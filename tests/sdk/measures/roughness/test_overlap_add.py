"""A convolution in blocks is the sum that defines it."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures.roughness.overlap_add import convolve, middle

SIZES = st.one_of(st.integers(1, 40), st.integers(1, 3000))


@settings(deadline=None, max_examples=60)
@given(SIZES, SIZES, st.integers(0, 99))
def test_a_convolution_is_its_sum(n: int, m: int, seed: int):
    rng = np.random.default_rng(seed)
    x, y = rng.standard_normal(n), rng.standard_normal(m)
    np.testing.assert_allclose(convolve(x, y), np.convolve(x, y), rtol=0, atol=1e-11)


@given(st.integers(1, 30), st.integers(1, 30))
def test_the_middle_is_that_of_numpy(n: int, m: int):
    x, y = np.arange(float(n)), np.arange(float(m))
    whole, long, short = np.convolve(x, y), max(n, m), min(n, m)
    np.testing.assert_array_equal(middle(whole, long), np.convolve(x, y, "same"))
    np.testing.assert_array_equal(middle(whole, long - short + 1), np.convolve(x, y, "valid"))
