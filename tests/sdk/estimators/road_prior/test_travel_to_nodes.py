"""A place between which and the last the encoder miscounts is not known; the pace goes on."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.estimators.road_prior.travel_to_nodes import Travel
from floatref.values.arrays import Flag
from floatref.values.block import Block
from floatref.values.channels import ChannelId

DISTANCE, COUNT = ChannelId("distance"), 240
EVERY = st.integers(1, 16)
MARKS = st.lists(st.integers(0, COUNT - 1), max_size=6, unique=True)
CUTS = st.lists(st.integers(1, COUNT - 1), max_size=8, unique=True)


def find(marks: list[int], every: int, cuts: list[int]) -> np.ndarray:
    """Return the places of all nodes, from blocks with borders at ``cuts``."""
    distance, flags = 0.1 * np.arange(COUNT), np.zeros(COUNT, np.uint8)
    flags[marks] = Flag.SLOW
    travel, found = Travel(), []
    for begin, end in pairwise([0, *sorted(cuts), COUNT]):
        part = flags[begin:end]
        own = {DISTANCE: part} if part.any() else {}
        block = Block(begin, {DISTANCE: distance[begin:end]}, flags=own)
        found.append(travel.find_places(block, np.arange(-begin % every, end - begin, every)))
    return np.concatenate(found)


@given(marks=MARKS, every=EVERY, cuts=CUTS)
def test_a_node_is_unknown_behind_a_sample_that_is_no_travel(
    marks: list[int], every: int, cuts: list[int]
) -> None:
    places = find(marks, every, cuts)
    for k, place in enumerate(places.tolist()):
        since = range((k - 1) * every + 1, k * every + 1)
        if any(mark in since for mark in marks):
            assert np.isnan(place)
        else:
            assert place == pytest.approx(0.1 * k * every)


@given(
    ways=st.lists(st.floats(0.0, 3.0), min_size=3, max_size=40),
    unknown=st.sets(st.integers(1, 39), max_size=6),
    cut=st.integers(1, 39),
)
def test_where_a_place_is_unknown_the_vehicle_goes_on_at_its_pace(
    ways: list[float], unknown: set[int], cut: int
) -> None:
    places = np.cumsum(ways)
    places[[k for k in unknown if k < len(ways)]] = np.nan
    travel = Travel()
    parts = [part for part in (places[:cut], places[cut:]) if part.size]
    found = np.concatenate([travel.take(part) for part in parts])
    pace = 0.0
    for k in range(1, len(ways)):
        if not np.isnan(places[k - 1 : k + 1]).any():
            pace = ways[k]
        assert found[k] == pytest.approx(pace, abs=1e-9)


def test_the_travel_since_the_last_node_is_nothing_where_its_place_is_unknown() -> None:
    travel = Travel()
    travel.take(np.array([0.0, 1.0, 2.5]))
    assert travel.since(3.0) == pytest.approx(0.5)
    assert travel.since(np.nan) == 0.0
    travel.take(np.array([np.nan]))
    assert travel.since(3.0) == 0.0
