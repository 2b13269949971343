"""What a stream holds over days: samples of one window, and nothing that grows."""

import os
import threading
import time
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from floatref import InputError, Setup, start_stream
from floatref.live.declared_channels import Piece
from floatref.live.following import Following
from floatref.live.joints import WindowPoints
from floatref.live.points import LivePoints, State, carry_events, join_points
from floatref.live.session.answers import of_points
from floatref.live.starting import settle
from floatref.live.stream import WAITING
from floatref.live.window_run import Processed
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.profile import ProfileTrack

RATE_HZ, PIECE_S = 100.0, 20.0
FORCE, HEIGHT, DISTANCE = (
    ChannelId(n, t)
    for n, t in (("vertical_specific_force", "main"), ("height", "main"), ("distance", None))
)
SPEEDS = 20.0, 0.0, 0.004, 0.5, 35.0, 3.0
"""Speeds in m/s of successive ten minutes: a standstill, and creeping, too."""


@pytest.fixture
def following():
    """Return what follows nominal channels; its windows are counted and not processed."""
    clocks = {name: UniformClock.of(RATE_HZ) for name in (FORCE, HEIGHT, DISTANCE)}
    made = Following(settle(Setup(), clocks, "temporal-basic"))
    made.windows = []

    def process(cut, recording):
        made.windows.append(recording.channel("height", "main").values.size)
        return Processed(WindowPoints(0, ()), None)

    made.runs.process = process
    return made


def hours(count):
    """Yield pieces of all channels over ``count`` hours."""
    size, distance_m = round(PIECE_S * RATE_HZ), 0.0
    for number in range(round(count * 3600.0 / PIECE_S)):
        speed = SPEEDS[int(number * PIECE_S // 600.0) % len(SPEEDS)]
        travelled = distance_m + speed / RATE_HZ * np.arange(1, size + 1)
        distance_m = float(travelled[-1])
        noise = np.full(size, 9.8)
        yield {FORCE: Piece(noise), HEIGHT: Piece(noise), DISTANCE: Piece(travelled)}


@pytest.mark.slow
def test_no_more_samples_are_held_than_stated_over_a_day(following):
    most = 0
    for pieces in hours(24.0):
        list(following.push(pieces))
        most = max(most, *(each.values.count for each in following.held.values()))
    limit = RATE_HZ * (following.order.bounds.longest_s + PIECE_S)
    assert most <= limit
    assert max(following.windows) <= limit
    assert len(following.windows) > 24
    assert len(following.plan.places) <= 1000


@pytest.mark.slow
def test_memory_does_not_grow_with_the_hours(following):
    drive = iter(hours(6.0))
    peaks = []
    tracemalloc.start()
    try:
        for _ in range(6):
            tracemalloc.reset_peak()
            for _ in range(round(3600 / PIECE_S)):
                list(following.push(next(drive)))
            following.windows.clear()
            peaks.append(tracemalloc.get_traced_memory()[1])
    finally:
        tracemalloc.stop()
    samples = 3 * 8 * RATE_HZ * (following.order.bounds.longest_s + PIECE_S)
    # The window that is cut is a copy.
    assert max(peaks) <= 2.2 * samples
    assert peaks[-1] <= 1.02 * max(peaks[:-1])


def test_a_stream_ends_its_thread(drive):
    recording = drive([(20.0, 20.0)])
    channels = {c.id: 200.0 for c in recording.channels}
    before = threading.active_count()
    for end in ("finish", "close"):
        with start_stream(recording.setup, channels, "temporal-basic") as stream:
            stream.push({c.id: c.values for c in recording.channels})
            assert threading.active_count() == before + 1
            getattr(stream, end)()
        assert threading.active_count() == before


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="the system does not list handles")
def test_a_stream_opens_no_file_and_has_one_thread_all_along(drive):
    recording = drive([(20.0, 90.0), (0.0, 8.0), (20.0, 90.0)], rate_hz=100.0)
    channels = {c.id: 100.0 for c in recording.channels}

    def held():
        return len(os.listdir("/proc/self/fd")), threading.active_count()

    start_stream(recording.setup, channels, "temporal-adaptive-hpf").close()
    files, threads = held()
    with start_stream(recording.setup, channels, "temporal-adaptive-hpf") as stream:
        points = []
        for first in range(0, recording.channels[0].values.size, 700):
            part = slice(first, first + 700)
            stream.push({c.id: c.values[part] for c in recording.channels})
            points += stream.ready(wait=True)
            assert held() == (files, threads + 1)
        assert any(p.state is State.FINAL for p in points)
        stream.finish()
    assert held() == (files, threads)


def test_a_push_waits_for_a_slow_thread_and_loses_nothing(monkeypatch):
    monkeypatch.setattr("floatref.live.stream.WAITING", 1000)
    goes_on, taken = threading.Event(), []

    def push(self, pieces):
        goes_on.wait(60.0)
        taken.append(pieces[HEIGHT].values.size)
        return iter(())

    monkeypatch.setattr(Following, "push", push)
    channels = dict.fromkeys((FORCE, HEIGHT, DISTANCE), RATE_HZ)
    with start_stream(Setup(), channels, "temporal-basic") as stream:
        stream.push({HEIGHT: np.ones(600)})
        stream.push({HEIGHT: np.ones(300)})
        third = threading.Thread(target=stream.push, args=({HEIGHT: np.ones(5000)},))
        third.start()
        third.join(0.2)
        assert third.is_alive()
        goes_on.set()
        third.join(60.0)
        assert not third.is_alive()
        stream.ready(wait=True)
    assert taken == [600, 300, 5000]
    assert WAITING == 1 << 23


def test_a_full_queue_is_drained_before_a_push_goes_on(monkeypatch):
    """Else the caller would wake for each piece, and share the interpreter with the thread."""
    monkeypatch.setattr("floatref.live.stream.WAITING", 8000)
    steps, taken = threading.Semaphore(0), []

    def push(self, pieces):
        steps.acquire(timeout=10.0)
        taken.append(pieces[HEIGHT].values.size)
        return iter(())

    monkeypatch.setattr(Following, "push", push)
    channels = dict.fromkeys((FORCE, HEIGHT, DISTANCE), RATE_HZ)
    with start_stream(Setup(), channels, "temporal-basic") as stream:
        for _ in range(8):
            stream.push({HEIGHT: np.ones(1000)})
        ninth = threading.Thread(target=stream.push, args=({HEIGHT: np.ones(1000)},))
        waits, wait_for = threading.Event(), stream._changed.wait_for

        def watched(predicate):
            if threading.current_thread() is ninth:
                waits.set()
            return wait_for(predicate)

        monkeypatch.setattr(stream._changed, "wait_for", watched)
        ninth.start()
        assert waits.wait(60.0)
        for done in range(4):
            assert ninth.is_alive(), done
            steps.release()
            while len(taken) <= done:
                time.sleep(0.001)
        ninth.join(60.0)
        assert not ninth.is_alive()
        for _ in range(5):
            steps.release()
        stream.ready(wait=True)
    assert taken == [1000] * 9


def test_an_error_of_the_thread_is_raised_by_the_next_call(monkeypatch):
    def push(self, pieces):
        raise InputError("channel height: leaps")

    monkeypatch.setattr(Following, "push", push)
    channels = dict.fromkeys((FORCE, HEIGHT, DISTANCE), RATE_HZ)
    with start_stream(Setup(), channels, "temporal-basic") as stream:
        stream.push({HEIGHT: np.ones(10)})
        for call in (lambda: stream.ready(wait=True), lambda: stream.push({}), stream.finish):
            with pytest.raises(InputError, match="channel height: leaps"):
                call()


def test_what_is_refused_before_the_first_point_is_said_at_once(following):
    following.runs.process = lambda cut, recording: Processed(
        WindowPoints(0, ()), None, lines=("a line",), refused=InputError("no light")
    )
    pushed = [each for pieces in hours(0.1) for each in following.push(pieces)]
    assert pushed
    for each in pushed:
        assert (len(each), each.state) == (0, State.FINAL)
        assert each.events[0] == "a line"
        assert each.events[1].endswith("no elevation; no light")
        assert "2 events" in repr(each)
        assert [answer.body["first"] for answer in of_points(each)] == [None, None]
    with pytest.raises(InputError, match="no final point"):
        join_points(pushed)


def test_a_reader_gets_events_with_the_next_points():
    track = ProfileTrack.of("main", [0.0, 1.0])
    silent, said = (LivePoints(0, 0.1, (), State.FINAL, events=(line,)) for line in ("a", "b"))
    first = LivePoints(0, 0.1, (track,), State.PROVISIONAL, events=("c",))
    second = LivePoints(2, 0.1, (track,), State.FINAL)
    taken, points = carry_events([silent, said, first, second, said])
    assert taken == [silent, said, first, second]
    assert [each.events for each in points] == [("a", "b", "c"), ()]
    assert points[1] is second
    assert carry_events([silent]) == ([], [])
