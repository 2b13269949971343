"""Readings of the antenna's height that it cannot have: stuck, by leaps, or not fixed."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.gnss_height import gnss_faults, report_faults, report_jumps, report_unfixed
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

laws = settings(deadline=None, max_examples=30)
RATE, SECONDS = 20.0, 60
COUNT = int(RATE * SECONDS)
STAMPS = 5.0125 + np.arange(COUNT) / RATE
HEIGHT, VELOCITY, QUALITY = "gnss_height", "gnss_vertical_velocity", "gnss_quality"


def swaying(seed: int = 0, quantum: float = 0.0, still: bool = False) -> Recording:
    """A vehicle at 10 m/s over long waves, or one that stands; noise and rounding."""
    rng = np.random.default_rng(seed)
    height = 200.0 + (0.0 if still else 0.3) * np.sin(0.3 * STAMPS)
    height += 0.004 * rng.standard_normal(COUNT)
    if quantum:
        height = quantum * np.round(height / quantum)
    rising = (0.0 if still else 0.09) * np.cos(0.3 * STAMPS) + 0.03 * rng.standard_normal(COUNT)
    receiver, clock = StampedClock.of(STAMPS), UniformClock.of(100.0, 5.0)
    times = clock.times(100 * SECONDS)
    shake = (0.01 if still else 0.5) * rng.standard_normal(times.size)
    return Recording(
        (
            Channel.of(HEIGHT, height, receiver),
            Channel.of(VELOCITY, rising, receiver),
            Channel.of(QUALITY, np.full(COUNT, 4.0), receiver),
            Channel.of("vertical_specific_force", 9.8 + shake, clock),
            Channel.of("height", 0.3 + 0.001 * shake, clock),
            Channel.of("distance", (0.0 if still else 10.0) * times, clock),
        )
    )


def with_values(recording: Recording, name: str, values: np.ndarray | None) -> Recording:
    channels = []
    for channel in recording.channels:
        if channel.id.name != name:
            channels.append(channel)
        elif values is not None:
            channels.append(replace(channel, values=values))
    return replace(recording, channels=tuple(channels))


def with_height(recording: Recording, at: int, length: int, value: float) -> Recording:
    values = recording.channel(HEIGHT).values.copy()
    values[at : at + length] = value
    return with_values(recording, HEIGHT, values)


@laws
@given(
    seed=st.integers(0, 99),
    at=st.integers(0, 600),
    length=st.integers(42, 1100),
    quantum=st.sampled_from([0.0, 0.001]),
    frozen=st.booleans(),
)
def test_a_height_that_sticks_is_found(
    seed: int, at: int, length: int, quantum: float, frozen: bool
) -> None:
    """While the velocity goes on, or, if all the receiver is frozen, while the vehicle does."""
    recording = with_height(swaying(seed, quantum), at, length, 199.123456)
    if frozen:
        rising = recording.channel(VELOCITY).values.copy()
        rising[at : at + length] = 0.01
        recording = with_values(recording, VELOCITY, rising)
    faults = gnss_faults(recording)
    np.testing.assert_array_equal(faults, [[at, min(at + length, COUNT)]])
    (line,) = report_faults(recording, faults)
    assert line.startswith("channel gnss_height: stuck for ")
    assert line.endswith("; not used there")


def test_a_height_that_never_changes_is_told_as_that() -> None:
    recording = with_height(swaying(), 0, COUNT, 199.0)
    faults = gnss_faults(recording)
    np.testing.assert_array_equal(faults, [[0, COUNT]])
    (line,) = report_faults(recording, faults)
    assert line.startswith("channel gnss_height: every reading is 199 m")


@laws
@given(
    seed=st.integers(0, 99),
    drive=st.sampled_from(
        [(0.0, True), (0.001, True), (0.01, True), (0.0, False), (0.01, False), (0.1, False)]
    ),
)
def test_a_sound_height_is_not_suspected(seed: int, drive: tuple[float, bool]) -> None:
    """However coarse it is rounded, and where the vehicle stands."""
    recording = swaying(seed, *drive)
    faults = gnss_faults(recording)
    assert faults.size == 0
    assert list(report_faults(recording, faults)) == []
    assert list(report_jumps(recording, faults)) == []
    assert list(report_unfixed(recording, 5.0, 65.0)) == []


def test_a_height_may_rest_where_nothing_moves() -> None:
    recording = with_height(swaying(still=True), 200, 300, 200.0)
    rising = recording.channel(VELOCITY).values.copy()
    rising[200:500] = 0.0
    assert gnss_faults(with_values(recording, VELOCITY, rising)).size == 0
    assert gnss_faults(recording).size == 2
    assert gnss_faults(with_values(recording, HEIGHT, None)).size == 0


def test_a_recording_without_a_height_sensor_is_searched_as_well() -> None:
    recording = with_height(swaying(), 100, 300, 199.0)
    still = with_values(recording, VELOCITY, None)
    others = tuple(c for c in still.channels if c.id.name != "height")
    assert gnss_faults(replace(still, channels=others)).tolist() == [[100, 400]]


@laws
@given(
    seed=st.integers(0, 99),
    at=st.integers(2, COUNT - 2),
    by_m=st.one_of(st.floats(0.3, 50.0), st.floats(-50.0, -0.3)),
    back=st.integers(1, 400),
)
def test_a_jump_is_told_with_size_and_time(seed: int, at: int, by_m: float, back: int) -> None:
    recording = swaying(seed)
    values = recording.channel(HEIGHT).values.copy()
    values[at : at + back] += by_m
    (line,) = report_jumps(with_values(recording, HEIGHT, values), gnss_faults(recording))
    returns = at + back < COUNT
    assert line.startswith(f"channel gnss_height: jumps in {2 if returns else 1} place")
    jump_m = float(line.split("most by ")[1].split(" m at ")[0])
    assert abs(jump_m) == pytest.approx(abs(by_m), abs=0.05 + 0.01 * abs(by_m))
    assert any(f"at {STAMPS[k]:.6g} s" in line for k in (at, min(at + back, COUNT - 1)))


@laws
@given(seed=st.integers(0, 99), at=st.integers(20, 1000), outage=st.integers(40, 150))
def test_an_outage_or_unfixed_readings_hide_a_change(seed: int, at: int, outage: int) -> None:
    """What changed meanwhile is no jump; how long it took is told."""
    recording = swaying(seed)
    values, quality = (recording.channel(n).values.copy() for n in (HEIGHT, QUALITY))
    values[at:] += 1.0
    values[at : at + outage] += np.linspace(0, 3, outage)
    quality[at : at + outage] = 5.0
    recording = with_values(with_values(recording, HEIGHT, values), QUALITY, quality)
    assert list(report_jumps(recording, gnss_faults(recording))) == []
    (line,) = report_unfixed(recording, 5.0, 65.0)
    seconds = (outage + 1) / RATE
    assert line.startswith(
        f"channel gnss_height: no RTK-fixed reading for {seconds:.4g} s in 1 place"
    )


@pytest.mark.parametrize("kind", [0.0, 1.0, 2.0, 5.0])
def test_readings_that_are_never_fixed_are_told(kind: float) -> None:
    recording = with_values(swaying(), QUALITY, np.full(COUNT, kind))
    (line,) = report_unfixed(recording, 5.0, 65.0)
    assert line.startswith(f"channel gnss_quality: never 4 (RTK fixed), mostly {kind:g}; ")
    assert "constants take its place" in line


def test_without_a_quality_all_are_taken_as_fixed_and_that_is_told() -> None:
    (line,) = report_unfixed(with_values(swaying(), QUALITY, None), 5.0, 65.0)
    assert line.startswith("channel gnss_quality: missing; every reading")


def test_a_quality_of_its_own_times_goes_with_the_nearest_reading() -> None:
    recording = swaying()
    assert list(report_unfixed(with_quality(recording, STAMPS + 0.02), 5.0, 65.0)) == []
    (line,) = report_unfixed(with_quality(recording, STAMPS[: COUNT // 2]), 5.0, 65.0)
    assert line.startswith("channel gnss_height: no RTK-fixed reading for 29.9")
    slow = StampedClock.of(STAMPS[::2] + 0.01)
    quality = np.full(COUNT // 2, 4.0)
    quality[200:300] = 2.0
    others = tuple(c for c in recording.channels if c.id.name != QUALITY)
    recording = Recording((*others, Channel.of(QUALITY, quality, slow)))
    (line,) = report_unfixed(recording, 5.0, 65.0)
    assert line.startswith("channel gnss_height: no RTK-fixed reading for 10.0")


def with_quality(recording: Recording, times: np.ndarray) -> Recording:
    """Return the recording with a quality of fixed readings at these times alone."""
    others = tuple(c for c in recording.channels if c.id.name != QUALITY)
    fixed = Channel.of(QUALITY, np.full(times.size, 4.0), StampedClock.of(times))
    return Recording((*others, fixed))
