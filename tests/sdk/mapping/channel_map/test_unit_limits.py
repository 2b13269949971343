"""Samples that no vehicle gives are refused; those that one gives are not."""

import math

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.mapping.channel_map.unit_limits import LIMITS, check_limits
from floatref.mapping.channel_map.units import unit_of
from floatref.values.channels import CHANNELS
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

CLOCK = UniformClock.of(100.0)
RUNS = {
    "gnss_latitude": [math.radians(-90), math.radians(89.99), math.radians(52.5)],
    "gnss_longitude": [math.radians(-180), math.radians(180), math.radians(359.99)],
    "gnss_height": [-430.0, 0.0, 5800.0],
    "gnss_vertical_velocity": [-3.0, 0.1, 3.0],
    "gnss_speed": [0.0, 41.0, 22.0],
    "wheel_speed": [0.0, 41.0, 22.0],
    "wheel_distance": [0.0, 999e3, 2000.0],
    "optical_distance": [0.0, 999e3, 2000.0],
    "gnss_pitch": [-0.3, 0.3],
    "gnss_roll": [-0.4, 0.4],
    "gnss_quality": [0, 1, 2, 4, 5],
    "roll_rate": [-2.0, 2.0, 0.1],
    "pitch_rate": [-2.0, 2.0, 0.1],
    "yaw_rate": [-1.0, 1.0, 0.2],
    "longitudinal_specific_force": [-9.8, 6.0, 0.4],
    "lateral_specific_force": [-9.8, 9.8, 0.1],
    "unsprung_specific_force": [-490.0, 510.0, 14.0],
    "rear_unsprung_specific_force": [-980.0, 1000.0, 6.0],
    "sprung_specific_force": [-5.0, 25.0, 9.8],
    "equipment_specific_force": [-5.0, 25.0, 10.5],
    "suspension_deflection": [-0.15, 0.2, 0.02],
    "rear_suspension_deflection": [-0.15, 0.2, 0.005],
    "unsprung_displacement": [-0.3, 0.3, 0.02],
    "rear_unsprung_displacement": [-8.0, 12.0, 0.02],
    "sprung_displacement": [-0.3, 0.3, 0.01],
    "equipment_displacement": [-0.3, 0.3, 0.01],
    "unsprung_velocity": [-8.0, 8.0, 0.3],
    "rear_unsprung_velocity": [-8.0, 8.0, 0.3],
    "sprung_velocity": [-2.0, 2.0, 0.1],
    "equipment_velocity": [-2.0, 2.0, 0.1],
    "pitch_angle": [-0.1, 0.08, 0.01],
    "roll_angle": [-0.15, 0.15, 0.02],
    "pitch_acceleration": [-60.0, 80.0, 1.5],
    "roll_acceleration": [-60.0, 60.0, 1.0],
}
"""What vehicles on the roads of the earth do, in SI units, typical values last and most often."""


def channel(name: str, values: list[float]) -> Channel:
    return Channel.of(name, values, CLOCK)


def usual(name: str) -> list[float]:
    return [*RUNS[name], *[RUNS[name][-1]] * 9]


def test_every_channel_is_looked_at_here_or_where_it_is_processed() -> None:
    assert set(RUNS) == set(LIMITS)
    assert set(CHANNELS) - set(LIMITS) == {"vertical_specific_force", "height", "distance"}


@pytest.mark.parametrize("name", LIMITS)
def test_what_a_vehicle_does_is_accepted(name: str) -> None:
    check_limits(channel(name, usual(name)))
    check_limits(channel(name, [*usual(name), np.nan]))
    check_limits(channel(name, [np.nan, np.nan]))


@pytest.mark.parametrize("name", [n for n in LIMITS if n != "gnss_quality"])
def test_the_same_run_in_the_unit_that_is_suggested_is_refused_with_it(name: str) -> None:
    other = unit_of(LIMITS[name].other)
    assert other.si == CHANNELS[name].unit
    assert LIMITS[name].per_unit == pytest.approx(1 / other.factor)
    native = [x / other.factor for x in usual(name)]
    with pytest.raises(InputError, match="which no vehicle reaches; if the file has") as caught:
        check_limits(channel(name, native))
    assert f"state unit = '{LIMITS[name].other}'" in str(caught.value)


def test_a_quality_of_another_table_is_refused() -> None:
    with pytest.raises(InputError, match=r"a sample is 50, which .*; it is from another table"):
        check_limits(channel("gnss_quality", [4, 50]))


@pytest.mark.parametrize("name", ["height", "distance", "vertical_specific_force"])
def test_what_the_processing_looks_at_is_left_to_it(name: str) -> None:
    check_limits(channel(name, [1e9]))


def test_a_single_wild_sample_is_seen_wherever_it_is() -> None:
    values = np.zeros(300_000)
    for at in (0, 123_457, 299_999):
        values[at] = -60.0
        with pytest.raises(InputError, match="a sample is 60 rad/s"):
            check_limits(channel("yaw_rate", values.tolist()))
        values[at] = 0.0
