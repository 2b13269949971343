"""A stream gives what `process(as_live=True)` gives, however its samples come in."""

import threading
import warnings

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

import floatref
from floatref import InputError, StageError, join_points, start_stream
from floatref.live.as_live import clocks_of, run_as_live
from floatref.live.points import State

LEGS = [(20.0, 100.0), (0.0, 8.0), (20.0, 60.0), (1.0, 10.0), (25.0, 60.0)]
"""Speeds in m/s and times in s: a stop, and creeping."""
CASES = {
    "one clock": {},
    "own rates": {"height_hz": 333.0},
    "distance with times": {"distance": "times", "start_s": 1234.5},
    "two wheel paths, counts": {"tracks": ("left", "right"), "count_m": 0.01, "at_m": 77.7},
}


@pytest.fixture(scope="module")
def made(drive):
    """Return a function that returns a recording of `CASES`, and what `as_live` makes of it."""
    known = {}

    def make(case, pipeline):
        if (case, pipeline) not in known:
            recording = drive(LEGS, **CASES[case])
            known[case, pipeline] = recording, run_as_live(recording, pipeline).profile
        return known[case, pipeline]

    return make


def stream_of(recording, pipeline, **more):
    return start_stream(recording.setup, clocks_of(recording), pipeline, **more)


def points_of(recording, pipeline, pieces, **more):
    with stream_of(recording, pipeline, **more) as stream:
        points = []
        for piece in pieces:
            stream.push(piece)
            points += stream.ready()
        return [*points, *stream.finish()]


@pytest.mark.slow
@settings(max_examples=20, phases=[Phase.explicit, Phase.reuse, Phase.generate])
@given(
    st.sampled_from(sorted(CASES)),
    st.sampled_from(["temporal-basic", "temporal-adaptive-hpf-spatial-backward", "spatial-hpf"]),
    st.integers(0, 2**31),
    st.sampled_from([0.0, 4.9]),
)
def test_any_pieces_give_the_same_profile(made, pieces, same, case, pipeline, seed, lateness_s):
    recording, expected = made(case, pipeline)
    drawn = pieces(recording, seed, lateness_s=lateness_s)
    same(join_points(points_of(recording, pipeline, drawn)), expected)


def test_process_as_live_is_the_same(made, same):
    recording, expected = made("one clock", "temporal-basic")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = floatref.process(recording, "temporal-basic", as_live=True)
    same(found, expected)
    ends = [window["end"] for window in found.provenance["live"]["windows"]]
    assert ends == ["joint", "joint", "end of the stream"]


def test_final_points_follow_one_another_and_are_never_repeated(made, pieces):
    recording, expected = made("one clock", "temporal-basic")
    points = points_of(recording, "temporal-basic", pieces(recording, 1))
    for state in State:
        own = [p for p in points if p.state is state]
        numbers = np.concatenate([p.first + np.arange(len(p)) for p in own])
        assert (np.diff(numbers) == 1).all(), state
    assert sum(len(p) for p in points if p.state is State.FINAL) == len(expected["left"].elevation)


def test_points_are_ready_as_often_as_one_asks(made, pieces, same):
    recording, expected = made("one clock", "temporal-basic")
    with stream_of(recording, "temporal-basic") as stream:
        points = []
        for piece in pieces(recording, 2):
            stream.push(piece)
            points += stream.ready(wait=True)
        before = [p for p in points if p.state is State.FINAL]
        points += stream.finish()
    assert len(before) == 2
    same(join_points(points), expected)


def test_a_channel_that_is_too_late_is_missing_there_and_reported(drive, pieces):
    recording = drive([(20.0, 60.0)], tracks=("left", "right"))
    late = recording.channel("height", "right")
    with stream_of(recording, "temporal-basic") as stream:
        points, kept, number = [], [], 0
        for piece in pieces(recording, 3, most_s=1.0):
            own = piece.pop(str(late.id))
            kept.append(own)
            number += own.size
            # Its samples of 20 to 35 s come together, at 35 s.
            if not 20.0 < number / 200.0 < 35.0:
                piece[str(late.id)] = np.concatenate(kept)
                kept = []
            stream.push(piece)
        points = stream.finish()
    profile = join_points(points)
    assert any(
        line.startswith("channel right.height: ")
        and line.endswith(
            "samples came more than 5 s later than another channel; counted as missing"
        )
        for each in points
        for line in each.events
    )
    where = profile.distance_m
    gap = (where > 420.0) & (where < 580.0)
    assert not profile["right"].valid[gap].any()
    assert profile["left"].valid[gap].all()
    assert profile["right"].valid[(where > 100.0) & (where < 380.0)].all()


def test_a_channel_that_never_comes_is_named(drive):
    recording = drive([(20.0, 40.0)])
    with stream_of(recording, "temporal-basic") as stream:
        stream.push({c.id: c.values for c in recording.channels if c.id.name != "height"})
        with pytest.raises(InputError, match=r"channel left\.height: "):
            stream.finish()


def test_a_stream_that_has_ended_takes_no_samples(drive):
    recording = drive([(20.0, 10.0)])
    stream = stream_of(recording, "temporal-basic")
    stream.close()
    with pytest.raises(StageError, match="push: the stream has ended"):
        stream.push({})
    with pytest.raises(StageError, match="finish: the stream has ended"):
        stream.finish()


@pytest.mark.parametrize("end", ["finish", "close"])
def test_a_lock_that_a_signal_has_left_keeps_no_thread(made, pieces, end):
    """Python gives a signal to the main thread, also as the lock of a `with` is released."""
    recording, _ = made("one clock", "temporal-basic")
    stream = stream_of(recording, "temporal-basic")
    for piece in pieces(recording, 0):
        stream.push(piece)

    def interrupted():
        stream._changed.acquire()
        getattr(stream, end)()

    ending = threading.Thread(target=interrupted, daemon=True)
    ending.start()
    ending.join(60.0)
    assert not ending.is_alive()
