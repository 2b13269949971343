"""The encoder: what float64 holds of its distance, and counts that are held too long."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values import scanning
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.encoder import check_distance
from floatref.values.recording import Channel, Clock
from floatref.values.scanning import Summary

RATE = 1000.0
COUNT = 4000
few = settings(deadline=None, max_examples=40)


def warned(values: np.ndarray, interval_m: float, clock: Clock | None = None) -> tuple[str, ...]:
    channel = Channel.of("distance", values, clock or UniformClock.of(RATE))
    return tuple(check_distance(channel, Summary.of(channel.values), interval_m))


def travel(speed: float) -> np.ndarray:
    return speed * np.arange(COUNT) / RATE


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
