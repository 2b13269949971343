"""Events of a drive that is known: stops, slow travel, braking, and missing samples."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel
from floatref.viewer.events import (
    HARD_G,
    Event,
    events_of_journey,
    invalid_stretches,
    missing_samples,
    slow_stretches,
)
from floatref.viewer.journey import STEP_S, Journey

CRUISE = 20.0


def journey(brake_g: float, stand_s: float) -> tuple[Journey, float, float]:
    """Return a drive that brakes to a stop after 20 s, and when it stands."""
    brake_s = CRUISE / (9.80665 * brake_g)
    stops, goes = 20.0 + brake_s, 20.0 + brake_s + stand_s
    times = np.arange(0.0, goes + 60.0, STEP_S)
    speed = CRUISE * np.interp(times, [20.0, stops, goes, goes + 30.0], [1.0, 0.0, 0.0, 1.0])
    return Journey(0.0, 0.0, STEP_S, np.cumsum(speed) * STEP_S), stops, goes


@given(st.floats(0.1, 0.5), st.floats(2.0, 60.0))
@settings(max_examples=20)
def test_a_stop_lasts_as_long_as_it_does_and_hard_braking_is_named(
    brake_g: float, stand_s: float
) -> None:
    made, stops, goes = journey(brake_g, stand_s)
    found = events_of_journey(made)
    (stop,) = [event for event in found if event.kind == "stop"]
    assert (stop.begin, stop.end) == pytest.approx((stops, goes), abs=0.7)
    (slow,) = [event for event in found if event.kind == "slow"]
    assert slow.begin < stop.begin < stop.end < slow.end
    braking = [event for event in found if event.kind == "braking"]
    if abs(brake_g - HARD_G) > 0.01:
        assert bool(braking) == (brake_g > HARD_G)
    for event in braking:
        assert event.begin + 1.0 >= 20.0
        assert event.end <= stops + 1.0
        assert float(event.detail.split()[2]) == pytest.approx(brake_g, abs=0.02)


@given(st.lists(st.tuples(st.integers(0, 400), st.integers(1, 60)), max_size=4))
@example([(0, 10)])
@settings(max_examples=20)
def test_missing_samples_are_where_they_are(spans: list[tuple[int, int]]) -> None:
    values = np.zeros(500)
    for first, count in spans:
        values[first : first + count] = np.nan
    channel = Channel.of("height", values, UniformClock.of(100.0, 5.0))
    marked = np.zeros(values.size, np.bool_)
    for event in missing_samples(channel):
        first, end = np.rint((np.array([event.begin, event.end]) - 5.0) * 100.0).astype(int)
        assert np.isnan(values[first:end]).all()
        assert end - first >= 10
        marked[first:end] = True
    edges = np.flatnonzero(np.diff(np.isnan(values), prepend=False, append=False)).reshape(-1, 2)
    for first, end in edges:
        assert marked[first] == (end - first >= 10)


def test_invalid_stretches_have_their_places_and_wheel_paths() -> None:
    valid = np.ones(100, np.bool_)
    valid[10:21] = valid[99] = False
    run = Profile(0.5, (ProfileTrack.of("left", np.zeros(100), valid),), start_m=3.0)
    assert invalid_stretches(run, "run") == [
        Event(8.0, 13.0, "not valid", "run, left, 5.00 m", "distance"),
        Event(52.5, 52.5, "not valid", "run, left, 0.00 m", "distance"),
    ]


def test_a_recorded_speed_is_slow_between_its_knots() -> None:
    along, speed = np.array([0.0, 100.0, 200.0]), np.array([20.0, 0.0, 20.0])
    (event,) = slow_stretches(along, speed)
    reach = 4.4704 / 0.2
    assert (event.begin, event.end) == pytest.approx((100.0 - reach, 100.0 + reach), abs=0.01)
