"""The trace of a profilograph: a sine, a slope and one bump in closed form."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.kernels.cut_off import SIXTH_ORDER
from floatref.measures import Profilograph, profilograph_trace, valid_frames

INTERVAL, HALF = 0.0762, 50
BARE = Profilograph(low_pass_m=0.0)


def low_pass_gain(wavelength: float, cut_off: float, interval: float) -> float:
    """Return the gain of LPF_B3x2: 1/(1 + r⁶) of the bilinear transform."""
    ratio = math.tan(math.pi * interval / wavelength) / math.tan(math.pi * interval / cut_off)
    return 1.0 / (1.0 + ratio**6)


@pytest.mark.parametrize("wavelength", [1.0, 2.0, 7.62, 15.24, 60.0])
def test_a_sine(wavelength: float) -> None:
    """A sin(kx) (1 − cos(k 3.81 m)) times the gain of the low-pass."""
    k, interval = 2.0 * np.pi / wavelength, 0.0381
    z = np.sin(k * interval * np.arange(6000))
    gain = low_pass_gain(wavelength, 0.6096 * SIXTH_ORDER, interval)
    expected = z * gain * (1.0 - np.cos(k * 3.81))
    middle = slice(1500, -1500)
    np.testing.assert_allclose(profilograph_trace(z, interval)[middle], expected[middle], atol=1e-6)


def test_the_low_pass_loses_3_db_at_2_ft() -> None:
    assert low_pass_gain(0.6096, 0.6096 * SIXTH_ORDER, 1e-5) == pytest.approx(0.5**0.5, rel=1e-6)


def test_one_bump_without_low_pass() -> None:
    """The recording wheel sees it once, each wheel of two sees half of it upside down."""
    z = np.zeros(400)
    z[200] = 0.01
    trace = profilograph_trace(z, INTERVAL, BARE)
    assert np.flatnonzero(np.nan_to_num(trace)).tolist() == [150, 200, 250]
    assert trace[[150, 200, 250]].tolist() == [-0.005, 0.01, -0.005]


def test_many_wheels_share_a_bump() -> None:
    wheels = tuple(INTERVAL * n for n in (-52, -48, 47, 50, 53))
    z = np.zeros(400)
    z[200] = 0.01
    trace = profilograph_trace(z, INTERVAL, Profilograph(wheels, 0.0))
    seen = {200 - n: -0.002 for n in (-52, -48, 47, 50, 53)} | {200: 0.01}
    assert np.flatnonzero(np.nan_to_num(trace)).tolist() == sorted(seen)
    assert all(trace[k] == pytest.approx(value) for k, value in seen.items())


@given(slope=st.floats(-0.1, 0.1), level=st.floats(-1000.0, 1000.0))
def test_a_slope_is_no_roughness(slope: float, level: float) -> None:
    z = level + slope * INTERVAL * np.arange(300)
    trace = profilograph_trace(z, INTERVAL, BARE)
    assert np.abs(trace[HALF:-HALF]).max() < 1e-9


def test_there_is_a_trace_where_the_frame_is_on_the_road() -> None:
    z = np.zeros(300)
    z[:10], z[150] = np.nan, np.nan
    known = np.flatnonzero(np.isfinite(profilograph_trace(z, INTERVAL)))
    assert (known[0], known[-1]) == (60, 249)
    assert 150 not in known
    assert np.isnan(profilograph_trace(z[:100], INTERVAL)).all()


def test_a_frame_over_an_invalid_point_is_marked() -> None:
    valid = np.ones(300, dtype=bool)
    valid[150] = False
    sound = valid_frames(np.zeros(300), INTERVAL, valid=valid)
    assert np.flatnonzero(~sound).tolist() == list(range(100, 201))


def test_a_low_pass_that_cannot_act_is_not_reported() -> None:
    assert Profilograph().as_dict(0.3)["low_pass_m"] is None
    assert Profilograph().as_dict(0.05)["low_pass_m"] == 0.6096


@pytest.mark.parametrize(
    ("wheels", "low_pass", "text"),
    [
        ((), 0.6, "no wheel"),
        ((3.0, 4.0), 0.6, "no wheel"),
        ((-3.0, float("nan")), 0.6, "not finite"),
        ((-3.0, 3.0), -1.0, "low-pass"),
    ],
)
def test_an_impossible_machine_is_refused(wheels, low_pass: float, text: str) -> None:
    with pytest.raises(InputError, match=text):
        Profilograph(wheels, low_pass)
