"""The known bump: what of it is lost or added, whatever else the profile does there."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.checks.driving.bump import LIMITS, measure_bump
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import DeviceError
from floatref_conformance.proving_ground.scenario import Scenario

INTERVAL, AT, HEIGHT = 0.01, 115.0, 0.02
X = np.arange(20000) * INTERVAL
SCENARIO = Scenario(bump_mm=1000 * HEIGHT, bump_at_m=AT)
QUICK = settings(deadline=None, max_examples=20)


def bump(at=AT):
    inside = np.abs(X - at) < 1.5
    return np.where(inside, HEIGHT * np.cos(np.pi * (X - at) / 3.0) ** 2, 0.0)


def ground(seed=0):
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 4e-5, X.size))


def error(result, truth=None):
    truth = ground() + bump() if truth is None else truth
    found = Compared("left", X, truth, result, np.ones(X.size, dtype=bool), INTERVAL)
    return measure_bump(found, SCENARIO).value


@QUICK
@given(st.floats(0.0, 0.5), st.booleans())
def test_the_share_of_the_bump_that_is_lost_or_added_is_the_error(share, added):
    result = ground() + (1 + share if added else 1 - share) * bump()
    assert error(result) == pytest.approx(100 * share, abs=0.5)


@QUICK
@given(st.floats(-0.1, 0.1), st.floats(-0.01, 0.01), st.floats(-0.8, 0.8))
def test_level_slope_and_place_do_not_matter(level, slope, shift):
    moved = np.interp(X - shift, X, ground() + bump())
    assert error(moved + level + slope * (X - AT)) < 1.5


def test_a_profile_of_the_ground_alone_lacks_all_of_it():
    assert error(ground()) == pytest.approx(100.0, abs=5.0)


def test_smoothing_over_two_metres_loses_more_than_any_class_may():
    window = round(2.0 / INTERVAL)
    smooth = np.convolve(ground() + bump(), np.full(window, 1.0 / window), mode="same")
    assert error(smooth) > LIMITS[DeviceClass.NOMINAL]


@pytest.mark.parametrize("device_class", DeviceClass)
def test_half_as_much_again_as_the_limit_fails_and_two_thirds_of_it_pass(device_class):
    limit = LIMITS[device_class] / 100
    assert error(ground() + (1 - 1.5 * limit) * bump()) > 100 * limit
    assert error(ground() + (1 - 0.67 * limit) * bump()) < 100 * limit


def test_a_point_without_elevation_there_is_the_devices_fault():
    with pytest.raises(DeviceError, match="at the bump, 115 m"):
        error(np.where(np.abs(X - AT - 2.0) < 0.02, np.nan, ground() + bump()))
