"""The plate: what counts as its rise, and what spoils it."""

import numpy as np
import pytest

from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.stationary.plate import (
    LIMITS,
    PLACE_LIMITS,
    PLATE_M,
    Plate,
    measure_plate,
)
from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import DeviceError, SuiteError

INTERVAL = 0.02
X = np.arange(25_000) * INTERVAL


def profile(z, interval=INTERVAL):
    return Profile(interval, (ProfileTrack.of("left", z),))


def plate(height=PLATE_M, start=120.0, length=3.0, flank=0.1):
    edges = [start, start + flank, start + flank + length, start + 2 * flank + length]
    return np.interp(X, edges, [0.0, height, height, 0.0])


TRUTH = profile(plate())


def rise(z, interval=INTERVAL):
    return Plate.find(TRUTH, "left").rise(profile(z, interval), "left")


def height_error(delivered):
    return measure_plate(delivered, TRUTH, "left")[0]


def displacement(z, interval=INTERVAL):
    return measure_plate(profile(high_pass(z, interval), interval), TRUTH, "left")[1]


@pytest.mark.parametrize("height", [0.0, 0.001, PLATE_M, -0.002])
def test_the_rise_is_the_plates_height_whatever_the_level_and_slope(height):
    assert rise(plate(height) + 0.3 - 0.001 * X) == pytest.approx(height, abs=1e-12)


def test_the_rise_needs_no_points_of_the_truths_interval():
    coarse = np.arange(2_000) * 0.25
    assert rise(np.interp(coarse, X, plate()), 0.25) == pytest.approx(PLATE_M, abs=1e-12)


def test_the_unfiltered_plate_misses_only_what_the_high_pass_takes():
    assert 0.0 < height_error(TRUTH).value < 0.25


@pytest.mark.parametrize(
    ("gain", "classes"),
    [
        (0.0, set()),
        (0.88, set()),
        (1.12, set()),
        (0.93, {DeviceClass.NOMINAL}),
        (0.97, {DeviceClass.NOMINAL, DeviceClass.ADEQUATE}),
        (0.999, set(DeviceClass)),
    ],
)
def test_a_profile_that_loses_or_adds_more_than_its_share_fails_its_class(gain, classes):
    delivered = profile(gain * high_pass(TRUTH.track("left").elevation, INTERVAL))
    measured = height_error(delivered)
    assert {c for c in DeviceClass if measured.within(c)} == classes


def test_the_limits_are_shares_of_the_plate_in_mm():
    assert [LIMITS[c] for c in DeviceClass] == pytest.approx([0.5, 0.25, 0.1])


def test_a_plate_without_elevation_is_the_devices_error():
    z = plate()
    z[np.abs(X - 121.5) < 0.5] = np.nan
    with pytest.raises(DeviceError, match=r"track left: .* without elevation"):
        rise(z)


def test_a_truth_without_a_plate_is_the_suites_error():
    with pytest.raises(SuiteError, match="no plate"):
        Plate.find(profile(np.zeros(X.size)), "left")


@pytest.mark.parametrize("shift", [-0.2, -0.07, 0.04, 0.1, 0.2])
def test_a_shifted_plate_is_displaced_by_the_shift_less_half_an_interval(shift):
    measured = displacement(plate(start=120.0 + shift))
    assert measured.value == pytest.approx(abs(shift) - INTERVAL / 2, abs=2e-3)
    assert (measured.class_reached is None) == (abs(shift) > 0.06)


def test_symmetrical_smoothing_and_noise_displace_nothing():
    kernel = np.full(25, 1 / 25)
    noise = 3e-5 * np.random.default_rng(1).standard_normal(X.size)
    assert displacement(np.convolve(plate(), kernel, "same") + noise).value < 2e-3


def test_a_trailing_average_displaces_by_half_its_length():
    trailing = np.convolve(plate(), np.full(13, 1 / 13))[: X.size]
    assert displacement(trailing).value == pytest.approx(0.12 - INTERVAL / 2, abs=2e-3)


@pytest.mark.parametrize("first", [0.0, 0.07, 0.15, 0.21])
def test_wide_points_do_not_displace_a_plate_that_lies_where_it_is(first):
    coarse = np.interp(np.arange(1_990) * 0.25, X - first, plate())
    shifted = profile(np.interp(X, X - first, TRUTH.track("left").elevation))
    measured = measure_plate(profile(high_pass(coarse, 0.25), 0.25), shifted, "left")
    assert measured[1].value < 0.005


@pytest.mark.parametrize("gain", [0.0, -1.0, 0.3])
def test_a_profile_without_the_plate_has_no_place_of_it_but_a_wrong_height(gain):
    (height,) = measure_plate(profile(gain * plate()), TRUTH, "left")
    assert height.class_reached is None


def test_a_step_in_place_of_the_plate_has_no_place_of_it():
    (height,) = measure_plate(profile(PLATE_M * (X > 119.0)), TRUTH, "left")
    assert height.class_reached is None


def test_the_place_is_allowed_two_and_a_half_ms_of_delay_at_72_km_h():
    assert [PLACE_LIMITS[c] / 20.0 for c in DeviceClass] == pytest.approx([2.5e-3, 2.5e-3, 1.25e-3])
