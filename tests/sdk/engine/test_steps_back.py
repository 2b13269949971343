"""A distance that goes back on a stretch is missing there, and in doubt behind it where it must."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.engine.steps_back import Forward, leave_out_steps_back
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

RATE, SPEED, LENGTH_S = 500.0, 20.0, 20.0
TIMES = np.arange(int(RATE * LENGTH_S)) / RATE
few = settings(deadline=None, max_examples=40)


def forward(values: np.ndarray, is_stamped: bool = False) -> Forward:
    clock = StampedClock.of(100.0 + TIMES) if is_stamped else UniformClock.of(RATE, 100.0)
    return leave_out_steps_back(Recording((Channel.of("distance", values, clock),)))


def kept(found: Forward) -> np.ndarray:
    return found.recording.channels[0].values


def test_a_distance_that_rolls_back_by_less_is_left_alone() -> None:
    values = SPEED * TIMES
    values[4000:4020] -= 0.9
    recording = Recording((Channel.of("distance", values, UniformClock.of(RATE)),))
    found = leave_out_steps_back(recording)
    assert found.recording is recording
    assert (found.doubts, found.lines) == ((), ())


@few
@given(
    first=st.integers(300, 9000),
    length=st.integers(2, 500),
    stamped=st.booleans(),
    low=st.sampled_from([0.0, -50.0, 3.0]),
)
def test_what_returns_at_once_is_missing_and_nothing_else_is_in_doubt(
    first: int, length: int, stamped: bool, low: float
) -> None:
    values = SPEED * TIMES
    values[first : first + length] = low
    found = forward(values, stamped)
    expected = SPEED * TIMES
    expected[first : first + length] = np.nan
    np.testing.assert_array_equal(kept(found), expected)
    assert found.doubts == ()
    (line,) = found.lines
    assert f"for {length} samples from {100.0 + TIMES[first]:.6g} s; counted as missing" in line


@few
@given(first=st.integers(300, 5000), back_m=st.floats(1.5, 100.0), stamped=st.booleans())
def test_behind_a_counter_that_was_set_back_no_place_is_known(
    first: int, back_m: float, stamped: bool
) -> None:
    values = SPEED * TIMES
    values[first:] -= back_m
    found = forward(values, stamped)
    (doubt,) = found.doubts
    ((begin_s, end_s),) = doubt.spans
    assert begin_s == pytest.approx(100.0 + TIMES[first])
    assert np.isinf(end_s)
    assert not doubt.fatal
    assert found.lines == (doubt.line,)
    known = kept(found)[~np.isnan(kept(found))]
    assert (np.diff(known) >= 0.0).all()


def test_places_are_known_behind_a_vehicle_that_rolled_back() -> None:
    # It stops within 10 s, rolls back by 4 m within 4 s, and goes on.
    slowing = np.clip(TIMES, 0.0, 10.0)
    rolled = -2.0 * (1.0 - np.cos(np.pi / 4.0 * np.clip(TIMES - 10.5, 0.0, 4.0)))
    away = 2.0 * np.clip(TIMES - 14.5, 0.0, None) ** 2
    found = forward(20.0 * slowing - slowing**2 + rolled + away)
    assert np.isnan(kept(found)).any()
    assert found.doubts == ()
    assert len(found.lines) == 1


def test_an_encoder_that_counts_backwards_from_the_begin_is_left_to_be_refused() -> None:
    found = forward(-SPEED * TIMES)
    assert not np.isnan(kept(found)).any()
    assert found.lines == ()
