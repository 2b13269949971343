"""An accelerometer on a wheel or a body tells gravity; one that does not is told how to."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping.channel_map.conversion import Conversion
from floatref.mapping.channel_map.entries import ChannelEntry
from floatref.mapping.channel_map.unit_limits import TOLERANCES, check_gravity, check_limits
from floatref.values.channels import CHANNELS
from floatref.values.clock import UniformClock
from floatref.values.native import Column
from floatref.values.recording import Channel

NATIVE = [
    ("m/s^2", 9.81, {}, {}),
    ("g", 1.0, {"unit": "m/s^2"}, {"unit": "g"}),
    ("g", -1.0, {"unit": "m/s^2"}, {"unit": "g", "sign": -1}),
    ("m/s^2", -9.7, {}, {"sign": -1}),
    ("m/s^2", 0.02, {}, {"offset": 9.80665}),
    ("g", 0.002, {}, {"offset": 1.0}),
    ("ft/s^2", 32.2, {"unit": "m/s^2"}, {"unit": "ft/s^2"}),
]
"""Unit and mean of a native accelerometer, what a wrong map and what the right one states."""


def mapped(name: str, native: tuple[str, float], stated: dict) -> Channel:
    unit, mean = native
    ripple = np.tile([-0.3, 0.3], 50)
    values = Conversion(ChannelEntry("a", name, **stated), Column("a", unit))
    times = np.arange(100) / 100
    return Channel.of(name, values(mean + ripple, times), UniformClock.of(100.0))


@pytest.mark.parametrize("name", TOLERANCES)
@pytest.mark.parametrize(("unit", "mean", "wrong", "right"), NATIVE)
def test_what_is_advised_is_what_cures(
    name: str, unit: str, mean: float, wrong: dict, right: dict
) -> None:
    check_limits(mapped(name, (unit, mean), right))
    if wrong == right:
        return
    with pytest.raises(InputError, match=r"mean is .*, expected about 9\.8 m/s\^2") as caught:
        check_limits(mapped(name, (unit, mean), wrong))
    for key, value in right.items():
        assert f"{key} = {value!r}".removesuffix(".0") in str(caught.value)


@pytest.mark.parametrize("name", TOLERANCES)
def test_a_mean_that_nothing_explains_is_told_to_be_checked(name: str) -> None:
    for mean in (3.0, 20.0, -20.0, 500.0):
        with pytest.raises(InputError, match="check unit, axis and offset"):
            check_gravity(name, mean)


@given(st.floats())
def test_channels_that_have_no_gravity_may_have_any_mean(mean: float) -> None:
    for name in CHANNELS:
        if name not in TOLERANCES:
            check_gravity(name, mean)


@pytest.mark.parametrize("name", TOLERANCES)
def test_a_bias_of_a_sensor_passes_and_a_larger_one_does_not(name: str) -> None:
    check_gravity(name, np.nan)
    for side in (-1, 1):
        check_gravity(name, 9.80665 + 0.99 * side * TOLERANCES[name])
        with pytest.raises(InputError):
            check_gravity(name, 9.80665 + 1.01 * side * TOLERANCES[name])


def test_a_wheel_may_shake_with_fifty_g() -> None:
    shaken = 9.8 + 500.0 * np.sin(0.7 * np.arange(10_000))
    check_limits(Channel.of("unsprung_specific_force", shaken, UniformClock.of(1000.0)))
