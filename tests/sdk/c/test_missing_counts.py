"""Counts that are missing in C: the last speed is kept, as the SDK's travel speed does."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.stages.signals import DISTANCE, TRAVEL_SPEED
from floatref.stages.speed import TravelSpeed
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

RATE, COUNT_M, LENGTH = 250.0, 2.0**-10, 800
NO_COUNT = -(2**63)
MOST = 60_000
GAPS = st.lists(st.tuples(st.integers(1, LENGTH - 60), st.integers(1, 50)), max_size=3)


def drive(seed, gaps):
    """Return counts of a drive at a wavy speed, NO_COUNT where missing."""
    rng = np.random.default_rng(seed)
    speed = 12.0 + np.cumsum(rng.normal(size=LENGTH)) * 0.05
    counts = np.floor(np.cumsum(speed) / RATE / COUNT_M).astype(np.int64)
    for first, length in gaps:
        counts[first : first + length] = NO_COUNT
    return counts


def speed_of_the_sdk(counts):
    distance = np.where(counts == NO_COUNT, np.nan, counts * COUNT_M)
    stage = TravelSpeed()
    channels = frozenset({ChannelId(DISTANCE)})
    stage.start(Header(Axis.TIME, 1.0 / RATE, 0.0, Fraction(250), channels, ("main",)))
    block = stage.push(Block(0, {ChannelId(DISTANCE): distance}))
    return block[ChannelId(TRAVEL_SPEED)]


def through_c(library, counts, edges):
    """Return elevation and speed of the points."""
    encoder = {"travel__rate_hz": RATE, "travel__metres_per_count": COUNT_M}
    made = library.make("adaptive", interval_m=2.0**-10, missing=1, **encoder)
    x, h = np.sin(np.arange(LENGTH) / 9.0), np.cos(np.arange(LENGTH) / 11.0)
    points = []
    for begin, end in pairwise(edges):
        parts = x[begin:end], h[begin:end], counts[begin:end]
        status, *some = made.push(*parts, outputs=2, capacity=MOST)
        assert status == 0, library.text(status)
        points.append(some)
    return [np.concatenate(each) for each in zip(*points, strict=True)]


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), gaps=GAPS, cut=st.integers(1, LENGTH))
@example(seed=1, gaps=[(300, 40), (345, 1)], cut=320)
def test_the_speed_is_that_of_the_sdk_at_every_sample_that_is_known(double, seed, gaps, cut):
    counts = drive(seed, gaps)
    _, speed = through_c(double, counts, [0, cut, LENGTH])
    known = np.flatnonzero(counts != NO_COUNT)
    # A point for every count: the one at the count of a sample has its speed.
    place = (counts[known] - counts[0])[1:]
    np.testing.assert_allclose(speed[place], speed_of_the_sdk(counts)[known][1:], rtol=1e-12)


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), gaps=GAPS, cut=st.integers(1, LENGTH))
def test_any_split_gives_the_same_bits(build, seed, gaps, cut):
    for library in (build("double"), build("float")):
        whole = through_c(library, drive(seed, gaps), [0, LENGTH])
        parts = through_c(library, drive(seed, gaps), [0, cut, LENGTH])
        for one, two in zip(whole, parts, strict=True):
            np.testing.assert_array_equal(one, two)


def test_missing_counts_are_refused_at_the_beginning_and_where_nothing_is_bridged(double):
    encoder = {"travel__rate_hz": RATE, "travel__metres_per_count": COUNT_M}
    x, counts = np.ones(3), np.array([NO_COUNT, 5, 9])
    for missing, part in ((1, counts), (0, counts[::-1])):
        made = double.make("adaptive", interval_m=0.125, missing=missing, **encoder)
        before = made.memory.copy()
        status, *_ = made.push(x, x, part, outputs=2, capacity=99)
        assert double.status[status] == "FR_BAD_SAMPLE"
        assert (made.memory == before).all()
