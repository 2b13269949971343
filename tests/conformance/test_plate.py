"""The plate: what counts as its rise, and what spoils it."""

import numpy as np
import pytest

from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.plate import LIMITS, PLATE_M, Plate, measure_plate
from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import DeviceError, SuiteError

INTERVAL = 0.02
X = np.arange(25_000) * INTERVAL


def profile(z, interval=INTERVAL):
    return Profile(interval, (ProfileTrack.of("left", z),))


def plate(height=PLATE_M, start=120.0, length=10.0, flank=1.0):
    edges = [start, start + flank, start + flank + length, start + 2 * flank + length]
    return np.interp(X, edges, [0.0, height, height, 0.0])


TRUTH = profile(plate())


def rise(z, interval=INTERVAL):
    return Plate.found(TRUTH, "left").rise(profile(z, interval), "left")


@pytest.mark.parametrize("height", [0.0, 0.001, PLATE_M, -0.002])
def test_the_rise_is_the_plates_height_whatever_the_level_and_slope(height):
    assert rise(plate(height) + 0.3 - 0.001 * X) == pytest.approx(height, abs=1e-12)


def test_the_rise_needs_no_points_of_the_truths_interval():
    coarse = np.arange(5_000) * 0.1
    assert rise(np.interp(coarse, X, plate()), 0.1) == pytest.approx(PLATE_M, abs=1e-12)


def test_the_unfiltered_plate_misses_only_what_the_high_pass_takes():
    value = measure_plate(TRUTH, TRUTH, "left").value
    assert 0.0 < value < 0.25


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
    from floatref.measures import high_pass

    delivered = profile(gain * high_pass(TRUTH.track("left").elevation, INTERVAL))
    measured = measure_plate(delivered, TRUTH, "left")
    assert {c for c in DeviceClass if measured.within(c)} == classes


def test_the_limits_are_shares_of_the_plate_in_mm():
    assert [LIMITS[c] for c in DeviceClass] == pytest.approx([0.5, 0.25, 0.1])


def test_a_plate_without_elevation_is_the_devices_error():
    z = plate()
    z[np.abs(X - 126.0) < 0.5] = np.nan
    with pytest.raises(DeviceError, match=r"track left: .* without elevation"):
        rise(z)


def test_a_truth_without_a_plate_is_the_suites_error():
    with pytest.raises(SuiteError, match="no plate"):
        Plate.found(profile(np.zeros(X.size)), "left")
