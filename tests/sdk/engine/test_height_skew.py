"""A height that a stop shows to be late is moved to its accelerometer's time, any other is left."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.engine.height_skew import align_heights
from floatref.measures.clocks.sensor_skew import sensor_skew, skew_at_stops
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

RATE, STOP_S = 2000, 10.0
SENSORS = "vertical_specific_force", "height", "distance"


def swing(late_s: float, stamped: bool = False, tracks: tuple[str, ...] = ("left",)) -> Recording:
    """Return a vehicle that stops at 10 s and still swings by 5 mm at 1.5 Hz."""
    t = np.arange(round(18.0 * RATE)) / RATE
    omega, decay = 2 * np.pi * 1.5, 0.8

    def height(at: np.ndarray) -> np.ndarray:
        since = np.maximum(at - STOP_S + 1.0, 0.0)
        return 0.005 * since**2 * np.exp(-decay * since) * np.sin(omega * since)

    force = STANDARD_GRAVITY + np.gradient(np.gradient(height(t), t), t)
    distance = np.minimum(10.0 * t, 10.0 * (STOP_S - 1.0))
    later = StampedClock.of(t) if stamped else UniformClock.of(RATE)
    clock, channels = (
        UniformClock.of(RATE),
        [Channel.of("distance", distance, UniformClock.of(RATE))],
    )
    for track in tracks:
        channels.append(Channel.of(SENSORS[0], force, clock, track))
        channels.append(Channel.of("height", 0.3 + height(t - late_s), later, track))
    return Recording(tuple(channels))


@pytest.mark.slow
@settings(deadline=None, max_examples=10)
@given(st.floats(-0.01, 0.01).filter(lambda x: abs(x) > 1e-3), st.booleans())
def test_a_late_height_is_moved_by_what_it_is_late(late_s: float, stamped: bool) -> None:
    recording = swing(late_s, stamped)
    aligned = align_heights(recording)
    assert aligned.later_s["left"] == pytest.approx(late_s, abs=2e-4)
    before, after = (r.channel("height", "left") for r in (recording, aligned.recording))
    assert after.values is before.values
    moved = before.times_s - after.times_s
    np.testing.assert_allclose(moved, aligned.later_s["left"], atol=1e-9)
    (line,) = aligned.warnings
    assert "later than" in line
    assert line.endswith("here the height was moved by that")
    assert not align_heights(aligned.recording).later_s


@pytest.mark.parametrize("late_s", [0.0, 2e-4])
def test_what_is_in_time_is_left_as_it_is(late_s: float) -> None:
    recording = swing(late_s)
    aligned = align_heights(recording)
    assert aligned.recording is recording
    assert not aligned.later_s
    assert not aligned.warnings


def test_every_wheel_path_has_its_own() -> None:
    late, right = swing(0.003, tracks=("left", "right")), swing(0.0, tracks=("right",))
    height = right.channel("height", "right")
    channels = tuple(height if c.id == height.id else c for c in late.channels)
    aligned = align_heights(replace(late, channels=channels))
    assert list(aligned.later_s) == ["left"]
    assert aligned.recording.channel("height", "right") is height


def test_stops_alone_say_what_the_whole_drive_says() -> None:
    sensors = [swing(0.003).channel(name, "left") for name in SENSORS]
    alone, whole = skew_at_stops(*sensors), sensor_skew(*sensors)
    assert alone.skew_s == pytest.approx(whole.skew_s, abs=1e-4)


def test_without_a_sensor_or_a_stop_nothing_is_moved() -> None:
    recording = swing(0.003)
    channels = tuple(c for c in recording.channels if c.id.name != "height")
    assert not align_heights(replace(recording, channels=channels)).later_s
    t = recording.channel("distance").times_s
    moving = Channel.of("distance", 10.0 * t, UniformClock.of(RATE))
    channels = tuple(moving if c.id.name == "distance" else c for c in recording.channels)
    assert not align_heights(replace(recording, channels=channels)).later_s
