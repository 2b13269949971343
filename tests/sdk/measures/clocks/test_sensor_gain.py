"""A height of a wrong unit, scale or sign is found where the vehicle stands and swings."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.measures.clocks.drives import driven, parts

from floatref.measures.clocks.sensor_gain import gain_warning, sensor_gain
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

VEHICLES = ["loaded-van", "minivan", "pickup", "trailer", "soft-van"]


def times(channel: Channel, scale: float) -> Channel:
    return replace(channel, values=scale * channel.values)


@pytest.mark.slow
@settings(deadline=None, max_examples=25)
@given(
    vehicle=st.sampled_from(VEHICLES),
    seed=st.integers(1, 3),
    scale=st.one_of(
        st.sampled_from([1.0, -1.0, 10.0, 25.4, 0.0254]), st.floats(0.1, 10.0), st.floats(-10, -0.1)
    ),
)
def test_a_stop_tells_scale_and_sign(vehicle: str, seed: int, scale: float) -> None:
    force, height, distance = parts(driven("stop", vehicle, seed))
    gain = sensor_gain(force, times(height, scale), distance)
    assert gain == pytest.approx(scale, rel=0.02)
    line = gain_warning(gain, height)
    if abs(scale - 1) < 0.2:
        assert line is None
    if abs(scale - 1) > 0.3:
        assert line is not None
        assert line.startswith("channel left.height: moves ")
        assert ("sign" in line) is (scale < 0)


@pytest.mark.slow
@pytest.mark.parametrize("vehicle", VEHICLES)
@pytest.mark.parametrize("manoeuvre", ["near-stop", "creeping"])
def test_a_vehicle_that_goes_on_tells_nothing(manoeuvre: str, vehicle: str) -> None:
    force, height, distance = parts(driven(manoeuvre, vehicle, 2))
    for scale in (1.0, -1.0, 10.0):
        gain = sensor_gain(force, times(height, scale), distance)
        assert np.isnan(gain)
        assert gain_warning(gain, height) is None


def test_short_and_slow_channels_and_noise_tell_nothing() -> None:
    force, height, distance = parts(driven("stop", "minivan", 1))
    slow = Channel.of("height", height.values[::80], UniformClock.of(50.0), "left")
    assert np.isnan(sensor_gain(force, slow, distance))
    short = replace(force, values=force.values[:100])
    assert np.isnan(sensor_gain(short, height, distance))
    noise = 0.3 + 0.005 * np.random.default_rng(1).normal(size=height.values.size)
    assert np.isnan(sensor_gain(force, replace(height, values=noise), distance))


def test_lasers_that_are_late_do_not_look_inverted() -> None:
    force, height, distance = parts(driven("stop", "pickup", 1))
    assert isinstance(height.clock, UniformClock)
    for late in (-0.3, -0.04, 0.005, 0.04, 0.3):
        shifted = replace(height, clock=replace(height.clock, start_s=late))
        assert not sensor_gain(force, shifted, distance) < 0


def swinging(parts: list[tuple[float, float, float]], beside_m: float = 0.0) -> float:
    """Return the gain of a height that stands: rms in m, gain and seconds of each part.

    Beside its own swing at 1.5 Hz the height moves by ``beside_m`` at 3.3 Hz.
    """
    omega, force, height = 3 * np.pi, [], []
    for motion_m, gain, seconds in parts:
        times = np.arange(int(1000 * seconds)) / 1000
        z = 2**0.5 * motion_m * np.sin(omega * times)
        force.append(9.8 - omega**2 * z)
        height.append(0.3 + gain * z + 2**0.5 * beside_m * np.sin(20.7 * times))
    clock = UniformClock.of(1000.0)
    series = np.concatenate(force), np.concatenate(height)
    names = "vertical_specific_force", "height"
    sensors = [Channel.of(n, x, clock) for n, x in zip(names, series, strict=True)]
    return sensor_gain(*sensors, Channel.of("distance", 0 * series[0], clock))


def test_what_moves_too_little_or_otherwise_tells_nothing() -> None:
    assert swinging([(0.005, 3.0, 9.0)]) == pytest.approx(3.0, rel=0.02)
    assert np.isnan(swinging([(0.00005, 3.0, 9.0)]))
    assert np.isnan(swinging([(0.005, 3.0, 9.0)], beside_m=0.005))


def test_the_window_with_the_most_motion_tells() -> None:
    parts = [(0.001, 3.0, 6.0), (0.02, 1.0, 6.0), (0.001, 3.0, 6.0)]
    assert swinging(parts) == pytest.approx(1.0, rel=0.02)


def test_a_wrong_unit_is_wrong_in_every_window() -> None:
    jolt, swing, still = (0.002, 1.4, 6.0), (0.0001, 1.0, 6.0), (0.00001, 1.0, 6.0)
    assert swinging([jolt, swing]) == pytest.approx(1.0, rel=0.02)
    assert swinging([jolt, still]) == pytest.approx(1.4, rel=0.05)
    for gain in (0.5, 1.4, 3.0, -1.0):
        always = [(motion_m, gain, seconds) for motion_m, _, seconds in (jolt, swing)]
        assert swinging(always) == pytest.approx(gain, rel=0.02)
