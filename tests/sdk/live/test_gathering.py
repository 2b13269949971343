"""Pushes of any size come out as they went in, and are handed over at the ticks."""

from math import floor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref import InputError, join_points, start_stream
from floatref.live.as_live import clocks_of, run_as_live
from floatref.live.bounds import TICK_S
from floatref.live.declared_channels import Entrance
from floatref.live.gathering import Gathering
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock

HEIGHT, FORCE, DISTANCE = (
    ChannelId(name) for name in ("height", "vertical_specific_force", "distance")
)
KINDS = st.sampled_from([np.float64, np.float32, list])


def gathering_of(clocks):
    return Gathering(clocks, dict.fromkeys(clocks, 0)), Entrance(clocks)


@pytest.mark.slow
@given(
    st.sampled_from([3.0, 100.0, 333.3, 16_000.0]),
    st.sampled_from([0.0, 0.3, -7.25, 1234.5]),
    st.lists(st.tuples(st.integers(0, 200), st.integers(0, 9), KINDS), min_size=1, max_size=20),
)
def test_samples_come_out_in_order_and_as_soon_as_a_tick_is_reached(rate_hz, start_s, pushes):
    clock = UniformClock.of(rate_hz, start_s)
    gathering, entrance = gathering_of({HEIGHT: clock, DISTANCE: None})
    given_, found, reached, time_s = [], [], floor((start_s - 1.0 / rate_hz) / TICK_S), 0.0
    times_given, times_found = [], []
    for size, more, kind in pushes:
        first = len(given_)
        values = (first + np.arange(size, dtype=np.float32)) * 0.1
        own = values.tolist() if kind is list else values.astype(kind)
        given_ += list(np.asarray(own, np.float64))
        times = time_s + 0.07 * (1.0 + np.arange(more))
        times_given += list(times)
        passed = floor(time_s / TICK_S)
        time_s = float(times[-1]) if more else time_s
        due = gathering.take({"height": own, DISTANCE: (times, times)}, entrance)
        latest = floor((start_s + (len(given_) - 1) / rate_hz + 1e-9) / TICK_S)
        assert due or (latest <= reached and floor(time_s / TICK_S) == passed)
        if due:
            pieces = gathering.hand_over()
            found += list(pieces[HEIGHT].values) if HEIGHT in pieces else []
            times_found += list(pieces[DISTANCE].times_s) if DISTANCE in pieces else []
            reached = latest
    pieces = gathering.hand_over()
    found += list(pieces[HEIGHT].values) if HEIGHT in pieces else []
    times_found += list(pieces[DISTANCE].times_s) if DISTANCE in pieces else []
    assert found == given_
    assert times_found == times_given
    assert gathering.hand_over() == {}


def test_small_pushes_are_handed_over_twice_a_second():
    clocks = {HEIGHT: UniformClock.of(16_000.0), FORCE: UniformClock.of(16_000.0)}
    gathering, entrance = gathering_of(clocks)
    push = {"height": np.zeros(160), FORCE: np.zeros(160)}
    handed = 0
    for _ in range(1000):
        if gathering.take(push, entrance):
            handed += 1
            gathering.hand_over()
    # The ticks of ten seconds, of which the sample at 0 s reaches the first.
    assert handed == 20


def test_a_push_that_is_refused_leaves_nothing_behind():
    clocks = {HEIGHT: UniformClock.of(100.0), FORCE: UniformClock.of(100.0)}
    gathering, entrance = gathering_of(clocks)
    gathering.take({"height": np.arange(3.0)}, entrance)
    for bad in (np.array([1.0, np.inf]), np.zeros((2, 2)), "x"):
        with pytest.raises(InputError, match="channel vertical_specific_force"):
            gathering.take({"height": np.full(5, 9.0), "vertical_specific_force": bad}, entrance)
    with pytest.raises(InputError, match="was not declared"):
        gathering.take({"height": np.full(5, 9.0), "left.height": np.ones(1)}, entrance)
    pieces = gathering.hand_over()
    assert list(pieces) == [HEIGHT]
    np.testing.assert_array_equal(pieces[HEIGHT].values, np.arange(3.0))


def test_a_missing_sample_is_no_infinite_one_and_the_caller_may_write_again():
    gathering, entrance = gathering_of({HEIGHT: UniformClock.of(100.0)})
    own = np.array([1.0, np.nan, 3.0])
    gathering.take({"height": own}, entrance)
    own[:] = 5.0
    handed = gathering.hand_over()[HEIGHT].values
    gathering.take({"height": own}, entrance)
    np.testing.assert_array_equal(handed, [1.0, np.nan, 3.0])


@pytest.mark.slow
def test_pushes_of_a_few_samples_give_the_profile_of_the_whole_recording(drive, pieces, same):
    recording = drive([(20.0, 40.0)], tracks=("left", "right"), height_hz=333.0)
    expected = run_as_live(recording, "temporal-matched-hpf").profile
    points = []
    with start_stream(recording.setup, clocks_of(recording), "temporal-matched-hpf") as stream:
        for piece in pieces(recording, 7, most_s=0.06):
            stream.push(piece)
        points = stream.finish()
    same(join_points(points), expected)
