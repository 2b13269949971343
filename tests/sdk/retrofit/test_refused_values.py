"""What a class alone refuses: arrays, rates and settings that cannot be, each in one line."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

from floatref import (
    AdaptiveHighPass,
    HeightReflection,
    HighPass,
    InputError,
    LocalSuppression,
    MatchedHighPass,
    SpatialHighPass,
    TimerDistortion,
    TravelSpeed,
)

X = np.linspace(0.0, 1.0, 10)


def said(error):
    assert "\n" not in str(error.value)
    return str(error.value)


@pytest.mark.parametrize("value", [np.inf, -np.inf])
def test_an_infinite_sample_is_refused_by_number(value):
    bad = np.where(np.arange(10) == 6, value, X)
    with pytest.raises(InputError, match=r"HighPass.height: h sample 6 is -?inf; give NaN"):
        HighPass(100.0).height(bad)


@pytest.mark.parametrize(
    "values",
    [
        ["here", "there"],
        ["1.0", "2.0"],
        [1.0, None],
        [1.0, 2.0j],
        [[1.0], [2.0, 3.0]],
        [1.0, 10**400],
        np.array(["1.0"], dtype=object),
        np.array(["2026-01-01"], dtype="datetime64[s]"),
        np.array([1], dtype="timedelta64[s]"),
        None,
        {},
    ],
)
def test_what_is_no_number_is_refused(values):
    with pytest.raises(InputError, match=r"TravelSpeed.of: distance is not an array of") as error:
        TravelSpeed(100.0).of(values)
    said(error)


@pytest.mark.parametrize("rate", [np.float32(100), "100", None, Decimal(100), True, 1j, [100.0]])
@pytest.mark.parametrize(
    "make", [HighPass, AdaptiveHighPass, MatchedHighPass, LocalSuppression, TravelSpeed]
)
def test_a_rate_that_is_no_exact_number_is_refused(make, rate):
    with pytest.raises(InputError, match=r"rate_hz is .*; give int, float or Fraction") as error:
        make(rate)
    said(error)


@pytest.mark.parametrize("rate", [100, 100.0, np.int32(100), np.float64(100.0), Fraction(100)])
def test_exact_rates_are_the_same_rate(rate):
    found = TravelSpeed(rate).of(X)
    np.testing.assert_array_equal(found, TravelSpeed(100).of(X))


def test_a_chunk_of_distance_given_twice_is_refused_and_counts_for_nothing():
    travel, other = TravelSpeed(100.0), TravelSpeed(100.0)
    first = travel.of(X)
    with pytest.raises(InputError, match="distance sample 0 goes back by 1 m to 0 m; give each"):
        travel.of(X)
    np.testing.assert_array_equal(first, other.of(X))
    np.testing.assert_array_equal(travel.of(X + 1.0), other.of(X + 1.0))


def test_a_distance_that_goes_back_is_named_and_its_rounding_is_not():
    distance = np.array([1e5, np.nan, 1e5 + 1.0, 1e5 + 1.0 - 1e-9, np.nan, 1e5 + 0.5])
    TravelSpeed(100.0).of(distance[:5])
    with pytest.raises(InputError, match=r"distance sample 5 goes back by 0.5 m"):
        TravelSpeed(100.0).of(distance)


@pytest.mark.parametrize("wrong", [-0.001, np.nan])
def test_a_step_that_goes_back_or_is_missing_is_refused(wrong):
    steps = np.array([0.0, 0.01, wrong])
    with pytest.raises(InputError, match=r"dt sample 2 is (-0.001|nan) s; a step is zero"):
        TimerDistortion(0.05).time_step(steps)
    for given in ((X[:3], steps, X[:3], X[:3]), (X[:3], X[:3], steps, X[:3])):
        with pytest.raises(InputError, match="time_step sample 2"):
            HeightReflection().reference_height(*given)


@pytest.mark.parametrize(
    "make",
    [
        lambda: HighPass(0.0),
        lambda: HighPass(np.nan),
        lambda: HighPass(100.0, cutoff_hz=50.0),
        lambda: HighPass(100.0, cutoff_hz=0.0),
        lambda: SpatialHighPass(-0.05),
        lambda: SpatialHighPass(0.05, cutoff_wavelength_m=0.1),
        lambda: SpatialHighPass(0.05, cutoff_wavelength_m=0.0),
        lambda: AdaptiveHighPass(100.0, low_speed_cutoff_hz=0.0),
        lambda: MatchedHighPass(np.inf),
        lambda: LocalSuppression(100.0, below_mps=-1.0),
        lambda: LocalSuppression(100.0, integral_per_s=0.0),
        lambda: TimerDistortion(0.05, slow_speed_mps=0.0),
        lambda: TimerDistortion(0.0),
        lambda: TravelSpeed(100.0, window_s=0.0),
        lambda: TravelSpeed(100.0, window_s=61.0),
        lambda: TravelSpeed(100.0, window_s="0.05"),
        lambda: HighPass(100.0, cutoff_hz="1"),
        lambda: SpatialHighPass(None),
        lambda: AdaptiveHighPass(100.0, low_speed_cutoff_hz=None),
    ],
)
def test_settings_that_make_no_sense_are_refused(make):
    with pytest.raises(InputError) as error:
        make()
    said(error)
