"""The encoder: what float64 holds of its distance, direction, speed, and held counts."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values import scanning
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.encoder.direction import stretches_behind
from floatref.values.encoder.plausible_distance import DISTANCES, check_distance, check_origins
from floatref.values.recording import Channel, Clock

RATE = 1000.0
COUNT = 4000
few = settings(deadline=None, max_examples=40)


def warned(values: np.ndarray, interval_m: float, clock: Clock | None = None) -> tuple[str, ...]:
    channel = Channel.of("distance", values, clock or UniformClock.of(RATE))
    return tuple(check_distance(channel, channel.scan.summary, interval_m))


def travel(speed: float) -> np.ndarray:
    return speed * np.arange(COUNT) / RATE


@pytest.mark.parametrize("name", DISTANCES)
@pytest.mark.parametrize("size", [1.01e10, -1e160, 3e227])
def test_a_number_that_no_distance_has_is_refused_before_it_is_squared(
    name: str, size: float
) -> None:
    values, clock = travel(20.0), UniformClock.of(RATE)
    channels = [Channel.of("distance", travel(20.0), clock)]
    if name != "distance":
        channels.append(Channel.of(name, values.copy(), clock))
    check_origins(channels)
    values[7] = size
    channels[-1] = Channel.of(name, values, clock)
    with pytest.raises(InputError, match=rf"{name}: sample 7 is .* beyond 1e\+10 m; subtract"):
        check_origins(channels)


@few
@given(origin=st.floats(-1e10, 1e10), interval=st.sampled_from([1e-5, 1e-3, 0.00508, 0.25]))
def test_a_distance_is_refused_where_it_cannot_tell_a_thousandth_of_the_interval(
    origin: float, interval: float
) -> None:
    assume(abs(origin) < 9.9e9)
    values = origin + travel(20.0)
    ends = np.abs(values[[0, -1]]).max()
    if np.nextafter(ends, np.inf) - ends <= interval / 1000:
        assert warned(values, interval) == ()
        return
    with pytest.raises(InputError, match=r"^channel distance: .* m is rounded to .* subtract an"):
        warned(values, interval)


@few
@given(speed=st.floats(1.0, 40.0), ratio=st.floats(1.1, 30.0), chunk=st.integers(50, 5000))
def test_held_counts_above_the_interval_are_a_warning_with_their_size(
    speed: float, ratio: float, chunk: int
) -> None:
    count = 0.1 * ratio
    values = count * np.floor(travel(speed) / count)
    assume(values[-1] >= 2 * count)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scanning, "CHUNK", chunk)
        (line,) = warned(values, 0.1)
        assert warned(values, 1.01 * count) == ()
    assert line == (
        f"channel distance: held between counts of {count:.4g} m, more than the profile interval "
        "of 0.1 m; deliver only the counts, with a time_file, so that it is linear between them"
    )


def test_a_slow_encoder_that_is_held_is_a_warning() -> None:
    held = np.repeat(travel(20.0)[::10], 10)
    assert len(warned(held, 0.00508)) == 1


def test_the_counts_alone_are_none() -> None:
    held = 0.1 * np.floor(travel(20.0) / 0.1)
    first = np.flatnonzero(np.diff(held, prepend=-1.0))
    assert warned(held[first], 0.00508, StampedClock.of(first / RATE)) == ()


def test_a_coarse_clock_of_its_own_and_a_stop_are_none() -> None:
    steps = np.full(400, 0.2)
    steps[100:300] = 0.0
    assert warned(np.cumsum(steps), 0.00508, UniformClock.of(100.0)) == ()


def test_a_gap_is_no_count() -> None:
    values = 0.005 * np.floor(travel(20.0) / 0.005)
    values[100:3000] = np.nan
    assert warned(values, 0.00508) == ()


@pytest.mark.parametrize("back_m", [0.0003, 0.999])
def test_a_vehicle_may_roll_back_a_little(back_m: float) -> None:
    values = travel(20.0)
    assert warned(np.concatenate((values, values[-1:] - back_m)), 0.00508) == ()


def test_time_stamps_are_held_to_the_same_speed() -> None:
    times = np.array([100.0, 101.0, 102.5, 110.0, 119.9])
    assert warned(20 * times, 0.00508, StampedClock.of(times)) == ()
    burst = StampedClock.of([100.0, 110.0, 110.0001, 119.9])
    assert warned(np.array([0.0, 200.0, 200.1, 398.0]), 0.00508, burst) == ()
    jump = np.array([0.0, 20.0, 2000.0, 2100.0, 2300.0])
    with pytest.raises(InputError, match=r"distance: 1980 m in 1.5 s from 101 s is 1320 m/s"):
        warned(jump, 0.00508, StampedClock.of(times))


def test_more_points_than_memory_holds_are_refused() -> None:
    long = np.linspace(0.0, 80_000.0, 1_000_000)
    with pytest.raises(InputError, match=r"too many points; choose a longer setup.profile_interv"):
        warned(long, 1e-5)


@few
@given(
    at=st.sets(st.integers(1, COUNT - 2).map(lambda n: n // 3 * 3 + 1), min_size=1, max_size=5),
    height=st.floats(1.5, 1e3),
    up=st.booleans(),
    chunk=st.integers(50, 5000),
)
def test_a_sample_that_comes_back_at_once_is_no_step_back(at, height, up, chunk):
    values = travel(20.0)
    values[[n for n in at if n < COUNT - 1]] += height if up else -height
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scanning, "CHUNK", chunk)
        assert warned(values, 0.1) == ()
        assert stretches_behind(Channel.of("distance", values, UniformClock.of(RATE))).size == 0
