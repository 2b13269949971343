"""What a tyre levels over its contact, given back."""

from functools import partial

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.stages.signals import ELEVATION
from floatref.values.arrays import Flag, FloatArray
from floatref.values.block import Axis
from floatref.values.channels import ChannelId
from floatref.vehicle_response.stages import RestoreContact
from floatref_conformance.testing import StageLaws, Stream

CONTACT_M, STEP_M = 0.25, 0.01
CHANNEL = ChannelId(ELEVATION, "left")


class TestRestoreContact(StageLaws):
    reads = (ELEVATION,)
    axis = Axis.DISTANCE
    reach = 300

    def make(self) -> RestoreContact:
        return RestoreContact(0.02)


def restored(values: FloatArray, contact_m: float = CONTACT_M) -> FloatArray:
    stream = Stream(lambda: RestoreContact(contact_m), {CHANNEL: values}, ("left",), Axis.DISTANCE)
    return stream.run([values.size])[CHANNEL]


def wave(length_m: float, points: int = 3000) -> FloatArray:
    return np.sin(2 * np.pi * STEP_M * np.arange(points) / length_m)


def levelled(values: FloatArray) -> FloatArray:
    """Return the mean over the contact about every point, from point 12 on to the 13th last."""
    return np.convolve(values, np.full(25, 1 / 25), "same")


@pytest.mark.parametrize("length_m", [0.6, 0.8, 1.2, 3.0, 30.0])
def test_what_a_contact_levels_is_given_back(length_m: float) -> None:
    inner = slice(500, -500)
    found = restored(levelled(wave(length_m)))
    # A mean of 25 points is one over 25 intervals but for terms of the interval's own.
    np.testing.assert_allclose(found[inner], wave(length_m)[inner], atol=6e-3)


def test_waves_that_the_contact_all_but_removes_are_left() -> None:
    values = wave(0.27)
    np.testing.assert_allclose(restored(values)[500:-500], values[500:-500], atol=5e-3)


@pytest.mark.parametrize("datum", [0.0, 100.0])
def test_a_slope_is_left_as_it_is(datum: float) -> None:
    line = datum + 0.02 * STEP_M * np.arange(3000)
    np.testing.assert_allclose(restored(line), line, atol=1e-11 * max(datum, 1.0))


def test_beside_a_missing_point_nothing_is_changed() -> None:
    values = np.random.default_rng(0).standard_normal(3000)
    values[1500] = np.nan
    found = restored(values)
    reach = round(8 * CONTACT_M / STEP_M)
    near = slice(1500 - reach, 1500 + reach + 1)
    np.testing.assert_array_equal(found[near], values[near])
    np.testing.assert_array_equal(found[:reach], values[:reach])
    changed = np.flatnonzero(found[reach:-reach] != values[reach:-reach]) + reach
    assert {changed[0], changed[-1]} == {reach, 3000 - reach - 1}
    assert np.isnan(found[1500])


@pytest.mark.parametrize("contact_m", [0.0, -0.1, float("nan"), float("inf")])
def test_a_contact_that_is_none_is_refused(contact_m: float) -> None:
    with pytest.raises(InputError, match="contact of"):
        RestoreContact(contact_m)


@pytest.mark.parametrize(("flag", "restores"), [(Flag.MISSING, False), (Flag.BRAKING, True)])
def test_only_points_flagged_as_missing_are_no_part_of_it(flag: Flag, restores: bool) -> None:
    values = np.random.default_rng(0).standard_normal(3000)
    marks = np.zeros(3000, np.uint8)
    marks[1500] = flag
    make = partial(RestoreContact, CONTACT_M)
    stream = Stream(make, {CHANNEL: values}, ("left",), Axis.DISTANCE, flags={CHANNEL: marks})
    found = stream.run([1400, 1501])[CHANNEL]
    near = slice(1490, 1511)
    assert (found[near] != values[near]).all() == restores
