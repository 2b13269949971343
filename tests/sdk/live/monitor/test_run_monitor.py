"""What is shown does not depend on the order of the calls, and views make no run wait."""

from dataclasses import replace
from threading import Thread
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref.live.bounds import Latency
from floatref.live.monitor.run_monitor import EVENTS, RunMonitor
from floatref.live.monitor.sections import SECTION_M
from floatref.live.monitor.shown_state import Status
from floatref.live.points import LivePoints, State
from floatref.live.session.messages import Piece
from floatref.live.session.watch import Taken
from floatref.values.clock import UniformClock

LATENCY = Latency(2382.4, 5.5, 35.5, 350.5, 5.5)
CLOCKS = {"left.height": UniformClock.of(100.0), "distance": UniformClock.of(100.0)}
STREAM = SimpleNamespace(pipelines=("test",), latency=LATENCY, late={"distance": 4})


def begun():
    monitor = RunMonitor("run", lambda: 5.0)
    monitor.declared(CLOCKS)
    monitor.started(STREAM)
    return monitor


def push(monitor, place_m, seed):
    values = np.random.default_rng(seed).normal(size=50)
    monitor.read({"left.height": Piece(values), "distance": Piece(place_m + values)})
    monitor.took(Taken({"left.height": 50, "distance": 50}, 1.0, place_m, 20.0))


@settings(max_examples=4, deadline=None, phases=[Phase.explicit, Phase.generate])
@given(st.integers(0, 2**31), st.randoms(use_true_random=False))
def test_the_order_of_samples_and_points_is_irrelevant(made, seed, random):
    profile = made.profile(seed, 700.0, 0.25)
    final = made.points(profile, seed, most_m=400.0, events=("one", "two"))
    provisional = made.points(profile, seed + 1, State.PROVISIONAL, most_m=200.0)
    shown = []
    for _ in range(2):
        monitor = begun()
        queues = [
            [lambda m, p=p: m.gave(p) for p in final],
            [lambda m, k=k: push(m, 10.0 * k, k) for k in range(8)],
        ]
        # Points of one kind come in order; provisional ones before any final one.
        for points in provisional:
            monitor.gave(points)
        while any(queues):
            random.choice([q for q in queues if q]).pop(0)(monitor)
        shown.append(repr(monitor.shown()))
    assert shown[0] == shown[1]
    assert "fault=''" in shown[0]


def test_a_run_of_days_takes_no_more_memory(made):
    monitor = begun()
    for k in range(3000):
        push(monitor, 2.0 * k, k)
        monitor.event(f"event {k} " + "x" * 10_000)
    shown = monitor.shown()
    assert [event.number for event in shown.events] == list(range(3001 - EVENTS, 3001))
    assert max(len(event.text) for event in shown.events) <= 400
    assert len(repr(shown.document())) < 10_000


def test_the_next_final_point_is_as_far_as_the_latency_states(made):
    monitor = begun()
    assert monitor.shown().to_final is None
    push(monitor, 100.0, 0)
    push(monitor, 600.0, 1)
    to = monitor.shown().to_final
    assert (to.place_m, to.travel_m) == (100.0, pytest.approx(2382.4 - 500.0))
    for points in made.points(made.profile(0, 400.0, 0.25, first=400), 0):
        monitor.gave(points)
    to = monitor.shown().to_final
    assert to.place_m == pytest.approx(500.0)
    assert to.travel_m == pytest.approx(2382.4 - 100.0)
    push(monitor, 5000.0, 2)
    assert monitor.shown().to_final.travel_m == 0.0


def test_a_distance_that_is_set_back_goes_on_from_where_it_was():
    monitor = begun()
    for place_m in (100.0, 600.0, 3.0, 13.0):
        push(monitor, place_m, 0)
    assert monitor.shown().distance_m == pytest.approx(610.0)


def test_late_and_dropped_samples_are_counted():
    monitor = begun()
    monitor.missed("left.height", 12)
    shown = monitor.shown()
    assert (shown.dropped, shown.late) == (12, 4)


def test_status_follows_the_connection_and_the_speed_of_a_silent_distance_is_not_known():
    now = [0.0]
    monitor = RunMonitor("run", lambda: now[0])
    assert monitor.shown().status is Status.WAITING
    monitor.declared(CLOCKS)
    monitor.started(STREAM)
    push(monitor, 50.0, 0)
    assert (monitor.shown().status, monitor.shown().speed_mps) == (Status.RUNNING, 20.0)
    monitor.waited(True)
    now[0] = 60.0
    # No message is read while points are calculated.
    assert (monitor.shown().speed_mps, monitor.shown().calculates_s) == (20.0, 60.0)
    monitor.waited(False)
    assert monitor.shown().speed_mps is None
    monitor.ended("peer: has gone")
    assert (monitor.shown().status, monitor.shown().reason) == (
        Status.INTERRUPTED,
        "peer: has gone",
    )
    monitor.started(STREAM)
    assert (monitor.shown().status, monitor.shown().reason) == (Status.RUNNING, "")
    monitor.completed()
    monitor.ended("complete")
    assert monitor.shown().status is Status.COMPLETE


def test_a_run_that_is_resumed_shows_the_sections_of_all_its_points(made):
    profile = made.profile(5, 6000.0, 0.5, first=100)
    low = 9000
    whole, resumed = begun(), begun()
    for points in made.points(profile, 5):
        whole.gave(points)
    resumed.recall(replace(profile, tracks=made.cut(profile, 0, low)))
    rest = replace(profile, tracks=made.cut(profile, low, 12_000), start_m=(100 + low) * 0.5)
    for points in made.points(rest, 5):
        resumed.gave(points)
    one, other = whole.shown(), resumed.shown()
    assert (one.fault, other.fault) == ("", "")
    assert len(one.sections) == len(other.sections)
    for a, b in zip(one.sections, other.sections, strict=True):
        assert a.start_m == b.start_m
        for x, y in zip(a.tracks, b.tracks, strict=True):
            assert x.iri_m_per_km == pytest.approx(y.iri_m_per_km, rel=1e-7, nan_ok=True)


def test_a_complete_run_has_a_last_section_and_nothing_provisional(made):
    monitor = begun()
    profile = made.profile(1, 400.0, 0.25)
    for points in made.points(profile, 1, State.PROVISIONAL):
        monitor.gave(points)
    for points in made.points(profile, 1):
        monitor.gave(points)
    monitor.completed()
    shown = monitor.shown()
    assert all(s.is_final and not s.is_running for s in shown.sections)
    assert sum(s.length_m for s in shown.sections) == pytest.approx(399.75)
    assert len(shown.sections) == int(400.0 / SECTION_M) + 1
    assert (shown.running, shown.to_final) == (None, None)


def test_what_fails_in_a_display_is_shown_and_ends_no_run():
    monitor = begun()
    monitor.read({"unknown": Piece(np.zeros(3))})
    assert monitor.shown().fault == "KeyError: 'unknown'"


def test_a_view_that_computes_lets_the_run_go_on(made, monkeypatch):
    monitor, waits = begun(), []
    monitor.gave(LivePoints(0, 0.25, made.cut(made.profile(1, 100.0, 0.25), 0, 400), State.FINAL))

    def running(sections):
        # Another thread pushes while the view is in the middle of its work.
        pushing = Thread(target=push, args=(monitor, 7.0, 0))
        pushing.start()
        pushing.join(60.0)
        waits.append(pushing.is_alive())

    monkeypatch.setattr("floatref.live.monitor.sections.Sections.running", running)
    monitor.shown()
    assert waits == [False]
    assert monitor.shown().distance_m == 7.0
