"""Pieces of a recording: together they are its samples, each at its time, in any cuts."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.devices.streams.pieces import (
    LONGEST_S,
    cut,
    drawn_cuts,
    even_cuts,
    span,
)


def joined(pieces):
    """Return the values of every channel, and check that the numbers of samples go on."""
    values = {}
    for piece in pieces:
        for name, part in piece.samples.items():
            mine = values.setdefault(name, [])
            assert part.first == sum(map(len, mine))
            mine.append(part.values)
    return {name: np.concatenate(parts) for name, parts in values.items()}


@pytest.mark.parametrize("by_turns", [False, True])
def test_all_samples_come_once_and_in_order(recording, by_turns):
    for cuts in (even_cuts(recording, 0.3), drawn_cuts(recording, 7)):
        found = joined(cut(recording, cuts, by_turns))
        assert found.keys() == {str(channel.id) for channel in recording.channels}
        for channel in recording.channels:
            np.testing.assert_array_equal(found[str(channel.id)], channel.values)


@pytest.mark.slow
@given(
    rate=st.floats(0.5, 5000.0),
    start_s=st.floats(-100.0, 100.0),
    count=st.integers(2, 300),
    seed=st.integers(0, 1000),
)
def test_no_sample_comes_before_its_time_and_each_with_the_first_cut_behind_it(
    rate, start_s, count, seed
):
    clock = UniformClock.of(rate, start_s)
    channel = Channel.of("distance", np.arange(float(count)), clock)
    recording = Recording((channel,), Setup())
    before_s = -np.inf
    for piece in cut(recording, drawn_cuts(recording, seed)):
        for part in piece.samples.values():
            times = channel.times_s[part.first : part.first + part.values.size]
            slack_s = 2e-6 / rate + 1e-9
            assert times[-1] <= piece.until_s + slack_s
            assert times[0] > before_s - slack_s
        before_s = piece.until_s


def test_by_turns_time_has_passed_when_the_last_channel_has_come(recording):
    pieces = list(cut(recording, even_cuts(recording, 0.5), by_turns=True))
    assert all(len(piece.samples) == 1 for piece in pieces)
    assert [piece.until_s for piece in pieces] == sorted(piece.until_s for piece in pieces)
    assert pieces[0].until_s == span(recording)[0]
    assert pieces[-1].until_s == pytest.approx(span(recording)[1])


@given(seed=st.integers(0, 10**6))
def test_drawn_pieces_are_never_later_than_a_channel_may_be(seed):
    recording = Recording(
        (Channel.of("distance", np.zeros(6000), UniformClock.of(100.0)),), Setup()
    )
    cuts = np.array([0.0, *drawn_cuts(recording, seed)])
    assert np.all(np.diff(cuts) > 0.0)
    assert np.max(np.diff(cuts)) <= LONGEST_S + 1e-9
    assert cuts[-1] == pytest.approx(59.99)
