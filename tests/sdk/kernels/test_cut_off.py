"""Settings of the passes: both passes together reduce the wanted frequency by 3 dB."""

import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.kernels.cut_off import (
    high_pass_setting,
    high_pass_wavelength_setting,
    low_pass_setting,
)

HALF_POWER = 0.5**0.5


def two_pass_gain(ratio: float) -> float:
    """Gain of a third-order Butterworth filter passed twice, at f/f_c (low) or f_c/f (high)."""
    return 1.0 / (1.0 + ratio**6)


@pytest.mark.cites("(A.20) to (A.22)")
@given(st.floats(1e-3, 1e3))
def test_both_passes_are_down_3_db_where_it_was_asked_for(wanted: float) -> None:
    high, low = high_pass_setting(wanted), low_pass_setting(wanted)
    assert two_pass_gain(high / wanted) == pytest.approx(HALF_POWER)
    assert two_pass_gain(wanted / low) == pytest.approx(HALF_POWER)
    assert high_pass_wavelength_setting(1.0 / wanted) == pytest.approx(1.0 / high)


def test_the_printed_setting_for_91_44_m() -> None:
    assert high_pass_wavelength_setting(91.44) == pytest.approx(105.91, abs=5e-3)


def test_settings_need_no_compiler() -> None:
    code = (
        "import sys, floatref.kernels.cut_off, floatref.measures; sys.exit('numba' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
