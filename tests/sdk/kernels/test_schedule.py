"""The cut-off that follows the speed, to rounding, everywhere and however it is split."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import schedule

PRINTED = 0.45, 105.91, 2.778, 2.5
SPEEDS = st.floats(0.0, 60.0)
FEW = settings(deadline=None, max_examples=50)


def frequency(speed, *constants):
    out = np.empty(np.size(speed))
    schedule.frequencies(np.atleast_1d(np.asarray(speed, dtype=float)), out, *constants)
    return out


def printed(speed, low, wavelength, transition, steepness):
    """(5.3) as printed, in extended precision."""
    power = np.exp(np.longdouble(steepness) * (np.longdouble(speed) - np.longdouble(transition)))
    return (low + np.longdouble(speed) / np.longdouble(wavelength) * power) / (1 + power)


@pytest.mark.slow
@pytest.mark.cites("(5.3)")
@FEW
@given(
    speed=SPEEDS,
    low=st.floats(0.05, 2.0),
    transition=st.floats(0.5, 8.0),
    steepness=st.floats(0.3, 10.0),
)
def test_frequency_is_the_printed_one_to_rounding(speed, low, transition, steepness):
    constants = low, 105.91, transition, steepness
    expected = printed(speed, *constants)
    assert abs(frequency(speed, *constants)[0] / expected - 1) <= 1e-13


@pytest.mark.cites("(5.3)")
def test_nothing_overflows_and_both_ends_are_reached():
    ends = frequency([-1e300, 0.0, 1e6, 1e300], *PRINTED[:3], 1e3)
    assert np.isfinite(ends).all()
    assert ends[1] == pytest.approx(0.45)
    assert ends[2:] == pytest.approx([1e6 / 105.91, 1e300 / 105.91])
    assert np.isnan(frequency(np.nan, *PRINTED)).all()


@pytest.mark.cites("(5.3)")
@FEW
@given(speed=SPEEDS, interval=st.floats(0.003, 0.3))
def test_wave_number_is_frequency_over_speed_up_to_four_points_a_cycle(speed, interval):
    values = frequency(speed, *PRINTED)
    exact = float(values[0]) / speed if speed > 0 else math.inf
    schedule.wave_numbers(np.array([speed]), values, 1 / (4 * interval))
    assert values[0] == pytest.approx(min(exact, 1 / (4 * interval)), rel=1e-15)


@pytest.mark.cites("(A.11)")
@FEW
@given(cutoff=st.floats(0.0, 0.4999), step=st.sampled_from([1.0, 1 / 16_000, 0.00508]))
def test_tangent_is_the_library_s(cutoff, step):
    c = np.empty(1)
    assert schedule.tangents(np.array([cutoff / step]), step, c) == 0
    assert c[0] == pytest.approx(math.tan(math.pi * step * (cutoff / step)), rel=1e-15, abs=0)


@pytest.mark.parametrize("cutoff", [-1e-3, 0.5, 3.0])
def test_a_cut_off_out_of_range_is_counted(cutoff):
    cutoffs, c = np.array([0.1, cutoff, math.nan]), np.empty(3)
    assert schedule.tangents(cutoffs, 1.0, c) == 1
    assert np.isnan(c[2])
