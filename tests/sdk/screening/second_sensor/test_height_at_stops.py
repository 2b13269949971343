"""Height against force at a stop: gain and lag of a swing over a road that does not move."""

import numpy as np
import pytest

from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.height_at_stops import cut, stop_doubts, stops_of
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording, Setup, TrackSetup

RATE, LENGTH_S, STOPS_S = 1000.0, 30.0, 12.0
TIMES = np.arange(int(RATE * LENGTH_S)) / RATE


def swing(times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the height of a body that swings from the stop on, and its acceleration."""
    since = np.maximum(times - STOPS_S, 0.0)
    z, pole = 0.02, complex(-0.6, 2 * np.pi * 1.4)
    wave = np.exp(pole * since)
    moving = times > STOPS_S
    height, acceleration = z * wave.real, z * (pole**2 * wave).real
    return np.where(moving, height, z), np.where(moving, acceleration, 0.0)


def recording(gain: float = 1.0, late_s: float = 0.0, ahead_m: float = 0.0) -> Recording:
    """Return a drive that stops for 8 s and goes on, its height ``gain`` times the swing."""
    source = np.random.default_rng(0)
    travel = 10.0 * np.minimum(TIMES, STOPS_S) + 10.0 * np.maximum(TIMES - 20.0, 0.0)
    height = 0.3 + gain * swing(TIMES - late_s)[0] + 1e-5 * source.standard_normal(TIMES.size)
    force = STANDARD_GRAVITY + swing(TIMES)[1] + 1e-3 * source.standard_normal(TIMES.size)
    clock = UniformClock.of(RATE)
    channels = (
        Channel.of("distance", travel, clock),
        Channel.of("vertical_specific_force", force, clock, "left"),
        Channel.of("height", height, clock, "left"),
    )
    setup = Setup(tracks={"left": TrackSetup(laser_offset_m=(ahead_m, 0.0, 0.0))})
    return Recording(channels, setup)


def doubts(gain: float = 1.0, late_s: float = 0.0, ahead_m: float = 0.0) -> list[Doubt]:
    return list(stop_doubts(recording(gain, late_s, ahead_m), ("left",)))


def test_a_stop_is_found_where_the_vehicle_stands() -> None:
    ((begin, end),) = stops_of(recording().channel("distance"))
    assert begin < STOPS_S < end


def test_stamped_counts_show_the_same_stop() -> None:
    even = recording().channel("distance")
    counts = np.append(np.flatnonzero(np.diff(even.values) > 0), even.values.size - 1)
    stamped = Channel.of("distance", even.values[counts], StampedClock.of(TIMES[counts]))
    (found,) = stops_of(stamped)
    (expected,) = stops_of(even)
    assert found == pytest.approx(expected, abs=0.2)


def test_a_sound_pair_raises_no_doubt() -> None:
    assert not doubts()
    assert not doubts(late_s=0.003)


@pytest.mark.parametrize(
    ("gain", "fatal"), [(-1.0, True), (0.5, True), (0.73, False), (1.28, False), (2.0, True)]
)
def test_a_wrong_gain_is_named_and_refused_beyond_three_tenths(gain: float, fatal: bool) -> None:
    doubt = doubts(gain)[0]
    assert doubt.fatal == fatal
    assert f"moves {gain:.3g} times as far" in doubt.line


def test_a_laser_ahead_may_move_more() -> None:
    # 0.3 m ahead of its accelerometer, on a body that pitches about a point 1.5 m behind.
    assert not doubts(1.4, ahead_m=0.3)
    assert doubts(1.4, ahead_m=0.1)


@pytest.mark.parametrize("late_s", [0.01, 0.03])
def test_a_late_laser_is_named_with_its_lag(late_s: float) -> None:
    (doubt,) = doubts(late_s=late_s)
    assert "left.height: " in doubt.line
    assert f"{1e3 * late_s:.1f} ms later" in doubt.line
    assert not doubt.fatal


def test_a_part_of_a_channel_keeps_its_times() -> None:
    part = cut(recording().channel("distance"), 3.0005, 4.0)
    assert part is not None
    assert part.times_s[0] == pytest.approx(3.001)
    assert part.values[0] == pytest.approx(30.01)
    assert cut(part, 10.0, 11.0) is None
