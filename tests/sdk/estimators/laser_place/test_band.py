"""The filters in sections are those of scipy, which is not loaded for them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import butter, sosfiltfilt

from floatref.errors import InputError
from floatref.estimators.laser_place.band import EDGE, filter_both_ways, sections_of


@settings(deadline=None, max_examples=50)
@given(
    st.floats(1e-4, 0.5),
    st.floats(0.002, 0.49),
    st.booleans(),
    st.integers(EDGE + 1, 400),
    st.integers(0, 99),
)
def test_they_filter_as_scipy_does(step: float, share: float, high: bool, n: int, seed: int):
    x = np.random.default_rng(seed).standard_normal(n).cumsum()
    kind = "high" if high else "low"
    theirs = sosfiltfilt(butter(3, share / step, kind, fs=1.0 / step, output="sos"), x)
    ours = filter_both_ways(sections_of(share / step, step, high), x)
    np.testing.assert_allclose(ours, theirs, rtol=1e-9, atol=1e-9 * np.abs(x).max())


@pytest.mark.parametrize("frequency_hz", [0.0, 50.0, 80.0, float("nan")])
def test_a_frequency_that_samples_cannot_have_is_refused(frequency_hz: float):
    with pytest.raises(InputError, match="at 100 Hz; give less than half"):
        sections_of(frequency_hz, 0.01, high=True)


def test_a_signal_too_short_to_be_continued_is_refused():
    with pytest.raises(InputError, match="12 samples; give more than 12"):
        filter_both_ways(sections_of(1.0, 0.01, high=True), np.zeros(EDGE))
