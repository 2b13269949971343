"""Windows: they cover the run, overlap as stated, and depend on the distance alone."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.live.bounds import (
    BEFORE_S,
    CORE_S,
    MOVES_M,
    OVERDUE,
    RUN_IN_S,
    RUN_OUT_S,
    STANDS_S,
    TICK_S,
    Bounds,
)
from floatref.live.window_plan import SLOW_MPS, End, WindowPlan, last_sound

SPEEDS = st.sampled_from([0.0, 0.002, 0.3, 2.0, 8.0, 20.0, 36.0])
LEGS = st.lists(st.tuples(SPEEDS, st.integers(1, 300)), min_size=1, max_size=12)
BOUNDS = st.sampled_from([Bounds(), Bounds(settle_s=61.3, settle_m=50.0), Bounds(core_m=300.0)])


def places_of(legs):
    """Return the distance at every tick."""
    return np.cumsum([speed * TICK_S for speed, ticks in legs for _ in range(ticks)])


def cuts_of(places, bounds):
    """Return the windows, and the number of ticks of which the plan held the distance."""
    plan, found, held = WindowPlan(bounds), [], [0]
    for tick, place in enumerate(places):
        cut = plan.step(tick, float(place))
        found += [] if cut is None else [cut]
        held.append(len(plan.places))
    last = plan.finish()
    return [*found, *([] if last is None else [last])], max(held)


@pytest.mark.slow
@given(LEGS, BOUNDS)
def test_windows_cover_all_travel(legs, bounds):
    places = places_of(legs)
    cuts, _ = cuts_of(places, bounds)
    covered = np.zeros(places.size, np.bool_)
    for cut in cuts:
        ticks = TICK_S * np.arange(places.size)
        covered |= (ticks > cut.begin_s) & (ticks <= cut.end_s)
    steps = np.diff(places, prepend=places[0])
    missed_m = steps[~covered].sum()
    # Of each standstill, less than the travel that counts as one in its duration is missed.
    stops = sum(cut.end is End.STANDSTILL for cut in cuts) + 1
    assert missed_m <= MOVES_M * stops * (1 + places.size * TICK_S / STANDS_S)


@pytest.mark.slow
@given(LEGS, BOUNDS)
def test_windows_overlap_by_run_in_and_run_out(legs, bounds):
    places = places_of(legs)
    cuts, _ = cuts_of(places, bounds)
    for cut, behind in pairwise(cuts):
        if cut.joint_s is None:
            assert behind.begin_s >= cut.end_s or behind.begin_s >= cut.end_s - BEFORE_S
            continue
        joint, end = round(cut.joint_s / TICK_S), round(cut.end_s / TICK_S)
        run_out_m = places[end] - places[joint]
        assert run_out_m >= bounds.fade_m + bounds.settle_m or end - joint >= RUN_OUT_S / TICK_S
        assert cut.end_s - cut.joint_s >= min(bounds.settle_s, RUN_OUT_S)
        assert behind.at_s == cut.joint_s
        begin = max(round(behind.begin_s / TICK_S), 0)
        run_in_m = places[joint] - places[begin]
        reaches_back = behind.begin_s == cut.begin_s
        long_ago = cut.joint_s - behind.begin_s >= RUN_IN_S
        assert run_in_m >= bounds.settle_m - 1e-9 or long_ago or reaches_back or begin == 0


@pytest.mark.slow
@given(LEGS, BOUNDS)
def test_a_window_is_no_longer_than_stated(legs, bounds):
    places = places_of(legs)
    cuts, held = cuts_of(places, bounds)
    longest_s = RUN_IN_S + OVERDUE * CORE_S + RUN_OUT_S
    assert held * TICK_S <= longest_s + TICK_S
    for cut in cuts:
        if np.isfinite(cut.begin_s) and np.isfinite(cut.end_s):
            assert cut.end_s - cut.begin_s <= longest_s


@pytest.mark.slow
@given(LEGS, BOUNDS, st.integers(0, 2**32 - 1))
def test_a_decision_depends_on_nothing_that_follows(legs, bounds, seed):
    places = places_of(legs)
    rng = np.random.default_rng(seed)
    keep = int(rng.integers(1, places.size + 1))
    other = np.concatenate((places[:keep], places[keep - 1] + np.arange(200) * 3.0))
    limit_s = (keep - 1) * TICK_S
    one, two = (
        [cut for cut in cuts_of(given, bounds)[0] if cut.end_s <= limit_s]
        for given in (places, other)
    )
    assert one == two


@given(st.integers(10, 40))
def test_joints_avoid_stops_where_the_core_permits(speed):
    bounds = Bounds()
    # A stop of 10 s just where the core is complete.
    before = int(bounds.core_m / speed / TICK_S) - 2
    places = places_of([(speed, before), (0.0, 20), (speed, 200), (speed, 400)])
    joint_s = cuts_of(places, bounds)[0][0].joint_s
    joint = round(joint_s / TICK_S)
    around = np.diff(places[joint - 4 : joint + 5]) / TICK_S
    assert around.min() >= SLOW_MPS


@pytest.mark.parametrize("stood_s", [40.0, 600.0, 10_800.0])
def test_a_standstill_ends_a_window_and_the_next_begins_as_the_vehicle_moves(stood_s):
    places = places_of([(20.0, 100), (0.0, round(stood_s / TICK_S)), (20.0, 100)])
    cuts, held = cuts_of(places, Bounds())
    assert [cut.end for cut in cuts] == [End.STANDSTILL, End.FINISH]
    assert cuts[0].end_s == pytest.approx(50.0 + STANDS_S, abs=2 * TICK_S)
    assert cuts[1].begin_s == pytest.approx(50.0 + stood_s - BEFORE_S, abs=2 * TICK_S)
    assert held * TICK_S <= 50.0 + STANDS_S + TICK_S


def test_a_short_stop_ends_no_window():
    places = places_of([(20.0, 60), (0.0, round(STANDS_S / TICK_S) - 2), (20.0, 60)])
    assert [cut.end for cut in cuts_of(places, Bounds())[0]] == [End.FINISH]


def test_a_vehicle_that_never_moves_has_no_window_after_the_first_standstill():
    assert cuts_of(np.full(200, 5.0), Bounds())[0] == []


def test_a_counter_that_is_set_back_ends_a_window():
    places = np.concatenate((places_of([(20.0, 100)]), places_of([(20.0, 100)])))
    first, second = cuts_of(places, Bounds())[0]
    assert (first.end, first.set_back_m) == (End.SET_BACK, pytest.approx(990.0))
    assert first.end_s == 99 * TICK_S
    assert second.begin_s == 100 * TICK_S


@given(st.integers(0, 4), st.sampled_from([-1e5, -50.0, -1.2, 1.2, 50.0, 1e5]))
def test_the_distance_of_a_tick_is_never_a_wrong_sample(at, error_m):
    times = 0.01 * np.arange(50)
    distances = 100.0 + 20.0 * times
    distances[-5 + at] += error_m
    assert last_sound(times, distances) == pytest.approx(100.0 + 20.0 * times[-1], abs=0.21)


def test_sound_distances_are_taken_as_they_are():
    times = 0.1 * np.arange(50)
    for distances in (3.0 * times**2, np.floor(20.0 * times), np.zeros(50), 90.0 * times):
        assert last_sound(times, distances) == distances[-1]
    assert last_sound(times[:1], np.array([7.0])) == 7.0
    assert last_sound(times[:2], np.array([7.0, 1e5])) == 1e5


def test_a_leap_that_stays_is_taken():
    times = 0.01 * np.arange(50)
    distances = np.where(times < times[-3], 100.0, 2.0)
    assert last_sound(times, distances) == 2.0
