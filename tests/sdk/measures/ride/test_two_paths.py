"""MRI, HRI and Ride Number: laws, and the Ride Number of a sine in closed form."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import (
    RIDE_NUMBER_CAR,
    half_car_roughness_index,
    iri,
    join_profile_indices,
    mean_path,
    mean_roughness_index,
    ride_number,
    ride_profile_index,
)
from floatref.measures.roughness.quarter_car import KMH, moving_average_response

FEW = settings(deadline=None, max_examples=15)
seeds = st.integers(0, 2**32 - 1)
INTERVAL = 0.1


def rough_road(seed: int) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 1e-3, 600))


@given(seed=seeds)
@FEW
def test_equal_paths_have_one_roughness(seed: int) -> None:
    z = rough_road(seed)
    value = iri(z, INTERVAL)
    assert half_car_roughness_index(z, z, INTERVAL) == pytest.approx(value, rel=1e-12)
    assert mean_roughness_index(value, value) == value


@given(seed=seeds)
@FEW
def test_opposite_paths_roll_and_do_not_bounce(seed: int) -> None:
    z = rough_road(seed)
    assert half_car_roughness_index(z, -z, INTERVAL) == pytest.approx(0.0, abs=1e-12)


@given(seed=seeds)
@FEW
def test_the_half_car_is_never_rougher_than_the_mean(seed: int) -> None:
    left, right = rough_road(seed), rough_road(seed + 1)
    mean = mean_roughness_index(iri(left, INTERVAL), iri(right, INTERVAL))
    assert half_car_roughness_index(left, right, INTERVAL) <= mean + 1e-12


def test_a_point_missing_in_one_path_is_missing_in_the_mean() -> None:
    left, right = rough_road(1), rough_road(2)
    left[100], right[200] = np.nan, np.nan
    mean = mean_path(left, right, INTERVAL)
    assert np.flatnonzero(np.isnan(mean)).tolist() == [100, 200]


def test_paths_of_different_lengths_are_refused() -> None:
    with pytest.raises(InputError, match="600 and 500 points"):
        mean_path(rough_road(1), rough_road(2)[:500], INTERVAL)


@pytest.mark.parametrize("wavelength", [1.0, 3.0, 6.0, 12.0])
def test_profile_index_of_a_sine(wavelength: float) -> None:
    """A k/√2 |H_MA| |H_car|, the gains at the sine's wave number."""
    interval, amplitude = 0.025, 1e-3
    x = interval * np.arange(150_000)
    wave_number = np.array([1.0 / wavelength])
    omega = 2.0 * np.pi * wave_number * 80.0 * KMH
    gain = np.abs(RIDE_NUMBER_CAR.stroke_response(omega)) * moving_average_response(
        wave_number, 0.25
    )
    expected = amplitude * 2.0 * np.pi / wavelength / np.sqrt(2.0) * abs(float(gain[0]))
    z = amplitude * np.sin(2.0 * np.pi * x / wavelength)
    assert ride_profile_index(z, interval) == pytest.approx(expected, rel=3e-3)


@given(seed=seeds, factor=st.floats(0.1, 10.0))
@FEW
def test_profile_index_grows_with_the_road(seed: int, factor: float) -> None:
    z = rough_road(seed)
    assert ride_profile_index(factor * z, INTERVAL) == pytest.approx(
        factor * ride_profile_index(z, INTERVAL), rel=1e-9
    )


def test_a_straight_slope_has_the_highest_ride_number() -> None:
    z = 0.03 * INTERVAL * np.arange(600)
    assert ride_number(ride_profile_index(z, INTERVAL)) == pytest.approx(5.0, abs=1e-9)


def test_ride_number_by_its_equation() -> None:
    """At PI = ln 2/160 it is halved."""
    assert ride_number(np.log(2.0) / 160.0) == pytest.approx(2.5)
    assert ride_number(0.0) == 5.0


@given(left=st.floats(0.0, 0.02), right=st.floats(0.0, 0.02))
def test_a_lane_lies_between_its_paths_nearer_the_rougher(left: float, right: float) -> None:
    lane = join_profile_indices(left, right)
    assert min(left, right) - 1e-15 <= lane <= max(left, right) + 1e-15
    assert lane >= (left + right) / 2.0 - 1e-15


def test_a_negative_profile_index_is_refused() -> None:
    with pytest.raises(InputError, match=r"profile index is -0\.001 m/m"):
        ride_number(-0.001)
