"""The reference's indices of a lane, by closed forms."""

import numpy as np
import pytest

from floatref_reference.chapter_2.section_2_1_4_waveband import (
    INDICES,
    h_moving_average,
    h_suspension_stroke,
)
from floatref_reference.ride_measures.lane import (
    half_car_roughness_index,
    mean_path,
    mean_roughness_index,
    profile_index,
    ride_number,
)
from floatref_reference.signals import samples


def test_a_lane_of_equal_paths_and_one_of_opposite_paths() -> None:
    z = np.cumsum(np.random.default_rng(1).normal(0.0, 1e-3, 300))
    same = mean_roughness_index(z, z, 0.1)
    assert half_car_roughness_index(z, z, 0.1) == pytest.approx(same, rel=1e-15)
    assert half_car_roughness_index(z, -z, 0.1) == 0
    assert samples(mean_path(z, -z)) == [0] * 300


@pytest.mark.parametrize("wavelength", [2.0, 5.0])
def test_profile_index_of_a_sine(wavelength: float) -> None:
    interval, amplitude, nu = 0.025, 1e-3, 1 / wavelength
    index = INDICES["PTRN"]
    gain = abs(h_suspension_stroke(nu, index)) * h_moving_average(nu, index.B)
    z = amplitude * np.sin(2 * np.pi * nu * interval * np.arange(8000))
    expected = amplitude * 2 * np.pi * nu / np.sqrt(2) * gain
    assert float(profile_index(z, interval)) == pytest.approx(expected, rel=2e-2)


def test_ride_number_by_its_equation() -> None:
    assert ride_number(0.0) == 5
    assert float(ride_number(np.log(2.0) / 160)) == pytest.approx(2.5)
    # Of 3 and 4 thousandths the root of the mean square is 3.5355 thousandths.
    assert float(ride_number(0.003, 0.004)) == pytest.approx(5 * np.exp(-0.56568542))
