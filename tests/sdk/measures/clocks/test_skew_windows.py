"""A window whose samples no sensor gives is left out, without a warning or an error of numpy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.measures.clocks.skew_series import STEP_S
from floatref.measures.clocks.skew_windows import LARGEST, skew_window

COUNT, FIRST = 300, LARGEST + 1
SIZE = COUNT + 2 * (LARGEST + 1)


def swing() -> tuple[np.ndarray, np.ndarray]:
    """Return acceleration and height of a body that swings at 1.5 Hz."""
    omega, times = 2.0 * np.pi * 1.5, STEP_S * np.arange(SIZE)
    height = 0.01 * np.sin(omega * times)
    return -(omega**2) * height, height


def test_a_swing_has_no_skew() -> None:
    found = skew_window(*swing(), FIRST, COUNT)
    assert found is not None
    assert found.skew_s == pytest.approx(0.0, abs=1e-5)
    assert found.gain == pytest.approx(1.0, rel=1e-4)


@given(
    st.sampled_from([1e100, 1e160, 1e200, 1e300, np.inf, np.nan]),
    st.sampled_from([-1.0, 1.0]),
    st.sets(st.integers(0, COUNT - 1), min_size=1, max_size=5),
    st.sampled_from([0, 1]),
)
def test_samples_that_no_sensor_gives_leave_the_window_out(
    size: float, sign: float, places: set[int], which: int
) -> None:
    series = swing()
    series[which][[FIRST + place for place in places]] = sign * size
    assert skew_window(*series, FIRST, COUNT) is None
