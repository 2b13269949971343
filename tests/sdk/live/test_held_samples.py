"""What is held is what was pushed: any pieces, any part, and no more than is needed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.live.declared_channels import Piece
from floatref.live.held_samples import HeldChannel, Pieces
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock, UniformClock

NAME = ChannelId("height", "left")
SIZES = st.lists(st.integers(0, 40), min_size=1, max_size=12)


@given(SIZES, st.data())
def test_parts_of_pieces_are_parts_of_the_whole(sizes, data):
    whole = np.arange(float(sum(sizes)))
    pieces, merged = Pieces(), 0
    for size in sizes:
        pieces.append(whole[pieces.end : pieces.end + size])
        if data.draw(st.booleans()):
            pieces.merge(merged)
            merged = pieces.end
    first = data.draw(st.integers(0, whole.size))
    pieces.drop(first)
    low, high = data.draw(st.integers(0, whole.size)), data.draw(st.integers(0, whole.size))
    np.testing.assert_array_equal(pieces.take(low, high), whole[max(low, first) : high])
    value = data.draw(st.floats(-1.0, whole.size + 1.0))
    assert pieces.search(value) == max(first, np.searchsorted(whole, value, "right"))
    assert pieces.count <= whole.size - first + max([*sizes, sum(sizes)])


@given(SIZES, st.floats(-50.0, 50.0), st.sampled_from([3.0, 100.0, 333.3]), st.data())
def test_a_cut_has_the_samples_between_two_times(sizes, start_s, rate_hz, data):
    clock, count = UniformClock.of(rate_hz, start_s), sum(sizes)
    values, times = np.arange(float(count)), UniformClock.of(rate_hz, start_s).times(count)
    stamped = data.draw(st.booleans())
    held, done = HeldChannel(NAME, None if stamped else clock), 0
    for size in sizes:
        part = slice(done, done + size)
        held.add(Piece(values[part], times[part] if stamped else None))
        done += size
    begin_s, end_s = sorted(data.draw(st.tuples(st.floats(-60, 60), st.floats(-60, 60))))
    inside = (times > begin_s) & (times <= end_s)
    near = np.minimum(np.abs(times - begin_s), np.abs(times - end_s)) * rate_hz < 1e-5
    found = held.cut(begin_s, end_s)
    got = np.zeros(0) if found is None else found.values
    assert set(values[inside & ~near]) <= set(got) <= set(values[inside | near])
    if found is not None:
        expected = times[got.astype(int)]
        np.testing.assert_allclose(found.times_s, expected, rtol=0, atol=1e-9)
        assert isinstance(found.clock, StampedClock if stamped else UniformClock)


def test_samples_that_come_after_their_time_has_passed_are_missing():
    held = HeldChannel(NAME, UniformClock.of(10.0))
    held.add(Piece(np.arange(10.0)))
    held.pass_time(2.0)
    assert held.add(Piece(np.arange(10.0, 25.0))) == 11
    assert held.add(Piece(np.arange(25.0, 30.0))) == 0
    values = held.cut(-np.inf, np.inf).values
    np.testing.assert_array_equal(values[:10], np.arange(10.0))
    assert np.isnan(values[10:21]).all()
    np.testing.assert_array_equal(values[21:], np.arange(21.0, 30.0))


def test_the_same_of_samples_with_times():
    held = HeldChannel(NAME, None)
    held.pass_time(2.0)
    assert held.add(Piece(np.arange(4.0), np.array([1.0, 2.0, 3.0, 4.0]))) == 2
    np.testing.assert_array_equal(held.cut(-np.inf, np.inf).times_s, [3.0, 4.0])


def test_a_channel_that_begins_a_year_before_the_others_takes_no_memory():
    held = HeldChannel(NAME, UniformClock.of(16_000.0))
    held.pass_time(3e7)
    assert held.values.count == 0
    assert held.add(Piece(np.zeros(100))) == 100


@pytest.mark.parametrize("stamped", [False, True])
def test_what_is_dropped_gives_its_memory_back(stamped):
    clock = UniformClock.of(100.0)
    held = HeldChannel(NAME, None if stamped else clock)
    for second in range(1000):
        values = np.zeros(100)
        held.add(Piece(values, clock.times(100, 100 * second) if stamped else None))
        held.pass_time(float(second))
        held.drop(second - 10.0)
        assert held.values.count + held.times.count <= 2 * 12 * 100
