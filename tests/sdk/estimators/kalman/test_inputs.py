"""What the filter takes out of blocks, however these are cut."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman.inputs import (
    GNSS,
    IMU,
    QUALITY,
    InputChannels,
    Quiet,
    Readings,
    stretch_of,
)
from floatref.estimators.kalman.references import Plan
from floatref.values.block import Axis, Block, Event, Header
from floatref.values.channels import ChannelId

ORIGIN_S, STEP, COUNT = 3.5, 0.01, 100
NONE = np.empty(0, np.int64), np.empty((0, 5))
laws = settings(deadline=None, max_examples=50)
CUTS = st.sets(st.integers(1, COUNT - 1), max_size=6)
TIMES = st.lists(st.floats(0.0, COUNT - 0.6), min_size=1, max_size=30, unique=True)


def event(place, height=300.0, quality=4.0):
    values = dict.fromkeys(GNSS, 0.25) | {GNSS[0]: height, QUALITY: quality}
    return Event(ORIGIN_S + place * STEP, values)


def taken(events, cuts=()):
    """Return what is read from blocks cut at ``cuts``, each with the events within it."""
    readings, found = Readings(ORIGIN_S, STEP), []
    for begin, end in pairwise([0, *sorted(cuts), COUNT]):
        begin_s, end_s = (ORIGIN_S + edge * STEP for edge in (begin, end))
        inside = [e for e in events if begin_s <= e.time_s < end_s]
        found.append(readings.take(inside, end))
        assert ((found[-1][0] >= begin) & (found[-1][0] < end)).all()
    return tuple(np.concatenate(part) for part in zip(*found, strict=True))


@laws
@given(places=TIMES, cuts=CUTS)
@example(places=[9.6, 9.9, 10.2], cuts={10})
@example(places=[14.5], cuts=set())
def test_each_reading_is_at_the_sample_next_to_it_and_no_two_at_one(places, cuts):
    events = [event(place, height=place) for place in sorted(places)]
    at, rows = taken(events, cuts)
    assert (np.diff(at) > 0).all()
    assert np.abs(rows[:, 0] - at).max() <= 0.5 + 1e-6
    for place in places:  # half-way between two samples, either is next to it
        assert {round(place - 1e-6), round(place + 1e-6)} & set(at.tolist())
    for one, other in zip((at, rows), taken(events), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.slow
@laws
@given(
    drawn=st.lists(
        st.tuples(st.sampled_from([4.0, 5.0, 1.0, 0.0]), st.sampled_from([300.0, np.nan])),
        min_size=1,
        max_size=20,
    )
)
def test_a_reading_counts_if_it_has_a_height_and_is_fixed(drawn):
    """And its interval is that from the one before that counts, a second at most."""
    places = np.arange(len(drawn)) * 5.0
    at, rows = taken([event(p, h, q) for p, (q, h) in zip(places, drawn, strict=True)])
    usable = [p for p, (q, h) in zip(places, drawn, strict=True) if q == 4.0 and h == h]
    np.testing.assert_array_equal(at, usable)
    intervals = np.minimum(np.diff(usable, prepend=-np.inf) * STEP, 1.0)
    np.testing.assert_allclose(rows[:, 4], intervals)


def test_a_reading_may_lack_what_is_not_height_and_say_nothing_of_quality():
    bare = Event(ORIGIN_S, {GNSS[0]: 300.0, GNSS[2]: 0.01})
    at, rows = taken([bare])
    assert at.tolist() == [0]
    np.testing.assert_array_equal(rows, [[300.0, np.nan, 0.01, np.nan, 1.0]])


def test_inputs_are_in_the_order_of_the_model():
    own = ChannelId("longitudinal_specific_force", "right")
    names = [own, *(ChannelId(name) for name in IMU)]
    up = [ChannelId("vertical_acceleration", track) for track in ("left", "right")]
    values = {c: np.array([k, np.nan]) for k, c in enumerate([*names, *up], start=1)}
    header = Header(Axis.TIME, STEP, 0.0, Fraction(100), frozenset(values), ("left", "right"))
    block = Block(0, values)
    found = [np.array(InputChannels.of(header, t).inputs(block)[1:]) for t in header.tracks]
    np.testing.assert_array_equal(found[0][:, 0], [2, 3, 7, 4, 5, 6])
    np.testing.assert_array_equal(found[1][:, 0], [1, 3, 8, 4, 5, 6])
    assert np.isnan(found[0][:, 1]).all()


def test_it_stands_below_the_speed_and_reads_heights_that_are_there_and_trusted():
    height = ChannelId("height", "left")
    speed = np.array([0.0, 0.04, 0.05, np.nan, 0.01])
    values = {ChannelId("travel_speed"): speed, height: np.array([0.3, np.nan, 0.3, 0.3, 0.3])}
    block = Block(7, values, flags={height: np.array([0, 0, 0, 0, 2], np.uint8)})
    stretch = stretch_of(block, "left", Plan(), NONE, NONE[0])
    assert stretch.first == 7
    assert stretch.standing.tolist() == [True, True, False, False, True]
    assert stretch.there.tolist() == [True, False, False, False, False]


@laws
@given(
    speeds=st.lists(st.sampled_from([3.0, 9.8, 10.0, 10.3, 20.0]), min_size=1, max_size=30),
    cuts=st.sets(st.integers(1, 290), max_size=5),
)
def test_a_constant_speed_is_one_for_four_seconds(speeds, cuts):
    """At ten samples a second, each of ``speeds`` for two seconds."""
    speed = np.repeat(speeds, 20)
    distance = np.concatenate(([0.0], np.cumsum(speed)[:-1])) / 10
    quiet, found = Quiet(10), []
    edges = [0, *sorted(cut for cut in cuts if cut < speed.size), speed.size]
    for begin, end in pairwise(edges):
        found += quiet.take(begin, distance[begin:end]).tolist()
    expected = []
    for sample in range(40, speed.size, 40):
        seconds = np.diff(distance[sample - 40 : sample + 1 : 10])
        if seconds.min() > 5.0 and np.ptp(seconds) < 0.4:
            expected.append(sample)
    assert found == expected
