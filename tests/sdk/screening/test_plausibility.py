"""What cannot be is refused by name; what can be bridged is a warning."""

import re
import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.screening.plausibility import examine
from floatref.values import scanning
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.needs import profiled_tracks
from floatref.values.recording import Channel, Recording, Setup, TrackSetup

SECONDS = 20
RATE = 200
COUNT = SECONDS * RATE
Arrays = dict[str, np.ndarray]


def good() -> Arrays:
    k = np.arange(COUNT)
    return {
        "vertical_specific_force": 9.8 + np.sin(k),
        "height": 0.3 + 0.01 * np.cos(k),
        "distance": 20.0 * k / RATE,
    }


def recorded(values: Arrays, rate: float = RATE, setup: Setup | None = None) -> Recording:
    clock = UniformClock.of(rate, 100.0)
    channels = tuple(Channel.of(name, array, clock) for name, array in values.items())
    return Recording(channels, setup or Setup())


def spoilt(name: str, change: Callable[[np.ndarray], Any]) -> Recording:
    values = good()
    values[name] = np.asarray(change(values[name].copy()), dtype=float)
    return recorded(values)


def put(*places: tuple[int | slice, float]) -> Callable[[np.ndarray], np.ndarray]:
    def change(array: np.ndarray) -> np.ndarray:
        for at, value in places:
            array[at] = value
        return array

    return change


def test_a_plausible_recording_gives_no_warning() -> None:
    assert examine(recorded(good())) == ()


@pytest.mark.parametrize("name", ["wheel_distance", "optical_distance"])
def test_a_second_distance_that_decreases_is_a_warning_since_nothing_reads_it(name: str) -> None:
    values = good()
    assert examine(recorded(values | {name: values["distance"]})) == ()
    (line,) = examine(recorded(values | {name: -values["distance"]}))
    assert re.fullmatch(rf"channel {name}: sample 1 goes back by 0\.1 m .*; it is not used", line)


@pytest.mark.parametrize("speed", [90.1, -1e200, 1.7e308])
def test_a_speed_by_gnss_that_no_profiler_reaches_is_a_warning(speed: float) -> None:
    values = good()
    speeds = np.full(values["distance"].size, 20.0)
    assert examine(recorded(values | {"gnss_speed": speeds})) == ()
    speeds[7] = speed
    (line,) = examine(recorded(values | {"gnss_speed": speeds}))
    assert line == (
        f"channel gnss_speed: sample 7 is {speed:.4g} m/s, faster than any profiler (90 m/s); "
        "such samples are not used"
    )


FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"
REFUSED: list[tuple[str, Callable[[np.ndarray], Any], str]] = [
    (FORCE, lambda a: a / 9.80665,
     "mean is 0.9994, expected about 9.8 m/s^2; looks like g, multiply by 9.80665 (map: unit"),
    (FORCE, lambda a: a - 9.80665, "; 1 g has been removed, add 9.80665 m/s^2 (map: offset = 9.80"),
    (FORCE, lambda a: a / 9.80665 - 1, "; 1 g has been removed, add 9.80665 m/s^2"),
    (FORCE, lambda a: -a, "mean is -9.8, expected about 9.8 m/s^2; the sign is inverted"),
    (FORCE, lambda a: -a / 9.80665, "looks like g with the sign inverted, multiply by -9.80665"),
    (FORCE, lambda a: a / 0.3048, "looks like ft/s^2, multiply by 0.3048 (map: unit = 'ft/s^2')"),
    (FORCE, lambda a: a * 1000, "looks like mm/s^2, multiply by 0.001"),
    (FORCE, lambda a: a * 2, "mean is 19.6, expected about 9.8 m/s^2; check unit, axis"),
    (FORCE, lambda a: a * 0 + 9.8, "every sample is 9.8, so it measures nothing; connect the acc"),
    (FORCE, lambda a: a * 1e306, "check unit, axis and offset"),
    (HEIGHT, lambda h: h * 1000, "expected a range below 10 m; if it is in mm, multiply by 0.001"),
    (HEIGHT, lambda h: -h, "expected a positive range in m; multiply by -1, or add the stand-off"),
    (HEIGHT, lambda h: h * 0, "every sample is 0; connect the height sensor"),
    (DISTANCE, lambda d: d * 1000, "is 2e+04 m/s, faster than any profiler; if the distance is in"),
    (DISTANCE, lambda d: d + 1e4 * (d >= 100), "1.001e+04 m in 0.5 s from 104.5 s is 2.002e+04"),
    (DISTANCE, lambda d: d[::-1], "sample 1 goes back by 0.1 m to 399.8 m; invert the sign"),
    (DISTANCE, lambda d: np.where(d > 100, 200 - d, d), "sample 1001 goes back by 0.1 m to 99.9 m"),
    (DISTANCE, lambda d: d * 0 + 7, "never leaves 7 m, less than the profile interval of 0.00508"),
    (DISTANCE, lambda d: d * 1e-6, "moves 0.0004 m, less than the profile interval of 0.00508 m"),
    (DISTANCE, put((slice(2000), -1.7e308)), "sample 0 is -1.7e+308 m, beyond 1e+10 m; subtract"),
    (DISTANCE, lambda d: d + 2e10, "sample 0 is 2e+10 m, beyond 1e+10 m; subtract an origin, such"),
    (HEIGHT, put((7, 100.5)), "sample 7 is 100.5 m, beyond 100 m; mark lost samples as NaN"),
    (HEIGHT, put((9, -1.7e308)), "sample 9 is -1.7e+308 m, beyond 100 m; mark lost"),
    (FORCE, put((7, 32768.0)), "sample 7 is 3.277e+04 m/s^2, beyond 10000 m/s^2; mark lost"),
    (FORCE, put((7, -9e4)), "sample 7 is -9e+04 m/s^2, beyond 10000 m/s^2; mark lost samples"),
    (FORCE, put((8, 1.7e308)), "sample 8 is 1.7e+308 m/s^2, beyond 10000 m/s^2; mark lost"),
    *(
        (name, put((slice(None), np.nan)), "4000 of 4000 samples are missing (100 %); record it")
        for name in (FORCE, HEIGHT, DISTANCE)
    ),
    (HEIGHT, put((slice(0, 2001), np.nan)), "2001 of 4000 samples are missing (50 %); record it"),
    *(
        (name, lambda a: a[: COUNT - 101], "ends at 119.49 s, but")
        for name in (FORCE, HEIGHT, DISTANCE)
    ),
    (HEIGHT, lambda h: h[:1], "height: ends at 100 s, but vertical_specific_force at 119.995 s"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "change", "text"), REFUSED)
def test_the_implausible_is_refused_by_name(
    name: str, change: Callable[[np.ndarray], Any], text: str
) -> None:
    with pytest.raises(InputError, match=re.escape(text)) as caught:
        examine(spoilt(name, change))
    assert str(caught.value).startswith(f"channel {name}: ")
    assert "\n" not in str(caught.value)


@given(
    name=st.sampled_from([FORCE, HEIGHT, DISTANCE]),
    at=st.integers(0, COUNT - 1),
    length=st.integers(1, COUNT // 2),
)
@settings(deadline=None, max_examples=40)
def test_a_gap_up_to_half_is_a_warning_with_its_place(name: str, at: int, length: int) -> None:
    length = min(length, COUNT - at)
    (line,) = examine(spoilt(name, put((slice(at, at + length), np.nan))))
    first, last = 100 + at / RATE, 100 + (at + length - 1) / RATE
    assert line == (
        f"channel {name}: {length} of {COUNT} samples missing ({100 * length / COUNT:.3g} %), "
        f"most in a row {length} from {first:.6g} s to {last:.6g} s; bridged and flagged"
    )


@given(
    bias=st.floats(-1.9, 1.9),
    range_m=st.floats(0.05, 5),
    speed=st.floats(0.2, 60),
    start=st.floats(-1e6, 1e6),
)
@settings(deadline=None, max_examples=40)
def test_bias_stand_off_speed_and_origin_are_free(
    bias: float, range_m: float, speed: float, start: float
) -> None:
    k = np.arange(COUNT)
    values = good() | {
        FORCE: 9.80665 + bias + 1e-3 * np.cos(k),
        HEIGHT: np.full(COUNT, range_m),
        DISTANCE: start + np.floor(speed * k / RATE / 0.005) * 0.005,
    }
    assert examine(recorded(values)) == ()


def test_whatever_the_chunk_the_verdict_is_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    cases = [spoilt(name, change) for name, change, _ in REFUSED]

    def verdicts() -> list[str]:
        lines = []
        for case in cases:
            with pytest.raises(InputError) as caught:
                examine(case)
            lines.append(str(caught.value))
        return lines

    whole = verdicts()
    monkeypatch.setattr(scanning, "CHUNK", 97)
    assert verdicts() == whole


@pytest.mark.parametrize("name", [FORCE, HEIGHT, DISTANCE])
def test_a_missing_channel_is_named_with_those_that_are_there(name: str) -> None:
    values = good()
    del values[name]
    here = ", ".join(values)
    with pytest.raises(InputError, match=rf"^channel {name}: missing; the recording holds {here}"):
        examine(recorded(values))


def test_a_track_without_height_is_left_out_and_one_without_accelerometer_is_named() -> None:
    clock, values = UniformClock.of(RATE), good()
    distance = Channel.of(DISTANCE, values[DISTANCE], clock)
    left = [Channel.of(name, values[name], clock, "left") for name in (FORCE, HEIGHT)]
    imu = Channel.of(FORCE, values[FORCE], clock, "right")
    recording = Recording((imu, *left, distance))
    assert profiled_tracks(recording) == ("left",)
    assert examine(recording) == ()
    blind = Channel.of(HEIGHT, values[HEIGHT], clock, "right")
    with pytest.raises(InputError, match=rf"channel right.{FORCE}: missing; the recording holds"):
        examine(Recording((*left, blind, distance)))
    shared = Channel.of(FORCE, values[FORCE], clock)
    assert examine(Recording((*left, blind, distance, shared))) == ()


def test_a_late_start_is_named() -> None:
    values = good()
    late = Channel.of(HEIGHT, values[HEIGHT][:-200], UniformClock.of(RATE, 101.0))
    others = recorded({name: values[name] for name in (FORCE, DISTANCE)}).channels
    with pytest.raises(InputError, match=f"channel height: starts at 101 s, but {FORCE} at 100 s"):
        examine(Recording((*others, late)))


def test_gnss_may_start_late_and_end_early_but_gyros_may_not() -> None:
    whole = recorded(good()).channels
    fixes = Channel.of("gnss_height", [1.0, 2.0], StampedClock.of([105.0, 106.0]))
    assert examine(Recording((*whole, fixes))) == ()
    gyro = Channel.of("pitch_rate", np.zeros(10), UniformClock.of(RATE, 100.0))
    with pytest.raises(InputError, match=r"channel pitch_rate: ends at 100.045 s, but"):
        examine(Recording((*whole, gyro)))


def test_a_rate_in_khz_is_named() -> None:
    with pytest.raises(InputError, match=r"16 samples per second are too few .* in Hz, not kHz"):
        examine(recorded(good(), rate=16.0))


def test_a_distance_in_km_and_unused_geometry_are_warnings() -> None:
    values = good()
    values[DISTANCE] /= 1000
    setup = Setup(tracks={"main": TrackSetup(), "rigth": TrackSetup()})
    slow, unused = examine(recorded(values, setup=setup))
    assert slow == (
        "channel distance: 0.3999 m in 20 s, at most 0.02 m/s; if the distance is in km, "
        "multiply by 1000"
    )
    assert unused == "setup.tracks.rigth: only main have channels; its offsets are not used"


def test_memory_is_bounded_whatever_the_length() -> None:
    k = np.arange(3 << 20, dtype=float)
    values = {FORCE: 9.8 + k % 2, HEIGHT: 0.3 + 0 * k, DISTANCE: 1e-3 * k}
    values[HEIGHT][5000:900000] = np.nan
    recording = recorded(values, rate=16000.0)
    tracemalloc.start()
    try:
        assert len(examine(recording)) == 1
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < values[HEIGHT].nbytes / 2
