"""Blocks and headers change by making new ones; the old ones stay."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.block import Axis, Block, Event, Header, join_blocks
from floatref.values.channels import ChannelId

A = ChannelId("vertical_specific_force", "left")
H = ChannelId("height", "left")


@pytest.fixture
def header() -> Header:
    return Header(Axis.TIME, 1 / 16000, 0.0, Fraction(16000), frozenset({A, H}), ("left", "right"))


@pytest.fixture
def block() -> Block:
    values = {A: np.full(3, 9.8), H: np.array([0.3, np.nan, 0.3])}
    return Block(7, values, {H: np.array([True, False, True])}, {H: np.array([0, 1, 0], np.uint8)})


def test_a_block_is_as_long_as_its_channels(block: Block) -> None:
    assert len(block) == 3
    assert len(Block(7, {})) == 0


def test_setting_leaves_the_old_block_and_freezes_the_new_samples(block: Block) -> None:
    fresh = np.zeros(3)
    new = block.setting({H: fresh}, {A: np.ones(3, np.uint8)})
    assert (new.first, new[H].tolist(), set(new.flags)) == (7, [0.0] * 3, {A, H})
    assert block[H][0] == 0.3
    assert set(block.flags) == {H}
    with pytest.raises(ValueError, match="read-only"):
        fresh[0] = 1.0


def test_a_channel_left_out_takes_its_masks_along(block: Block) -> None:
    new = block.without("height")
    assert (set(new.values), set(new.fresh), set(new.flags)) == ({A}, set(), set())
    assert set(block.values) == {A, H}


def test_a_header_adds_leaves_out_and_replaces_channels(header: Header) -> None:
    left, right = (ChannelId("elevation", track) for track in header.tracks)
    assert header.adding(left).channels == {A, H, left}
    assert header.without("height").channels == {A}
    assert header.replacing("height", "elevation").channels == {A, left, right}
    assert header.channels == {A, H}


def test_the_distance_axis_keeps_the_rate_of_time(header: Header) -> None:
    new = header.on_distance(0.00508, 12.0)
    assert (new.axis, new.step, new.origin, new.rate) == (Axis.DISTANCE, 0.00508, 12.0, header.rate)


def test_what_a_stage_needs_and_lacks_is_named(header: Header) -> None:
    header.require("combine", A, H)
    with pytest.raises(
        InputError, match="stage combine needs channel distance; add a stage that makes it"
    ):
        header.require("combine", A, ChannelId("distance"))


def _long(count: int) -> Block:
    rng = np.random.default_rng(count)
    return Block(
        100,
        {A: rng.normal(size=count), H: rng.normal(size=count)},
        {H: rng.uniform(size=count) < 0.5},
        {A: rng.integers(0, 4, count).astype(np.uint8)},
        (Event(0.5, {A: 1.0}), Event(0.7, {A: 2.0})),
    )


def _same(one: Block, other: Block) -> None:
    assert (one.first, one.events) == (other.first, other.events)
    for name in ("values", "fresh", "flags"):
        found, wanted = getattr(one, name), getattr(other, name)
        assert found.keys() == wanted.keys()
        for channel, samples in found.items():
            assert samples.dtype == wanted[channel].dtype
            np.testing.assert_array_equal(samples, wanted[channel])


@settings(deadline=None)
@given(count=st.integers(1, 40), cuts=st.sets(st.integers(1, 39)))
def test_parts_joined_are_the_block(count: int, cuts: set[int]) -> None:
    block = _long(count)
    edges = [0, *sorted(cut for cut in cuts if cut < count), count]
    parts = [block.part(a, b) for a, b in pairwise(edges)]
    assert [part.first for part in parts] == [100 + a for a in edges[:-1]]
    assert [len(part) for part in parts] == np.diff(edges).tolist()
    assert [part.events for part in parts[1:]] == [()] * (len(parts) - 1)
    _same(join_blocks(parts), block)


def test_where_one_of_the_joined_has_no_mask_its_samples_are_fresh_and_trusted(
    block: Block,
) -> None:
    bare = Block(10, {A: np.zeros(2), H: np.zeros(2)})
    whole = join_blocks([block, bare])
    assert whole.fresh[H].tolist() == [True, False, True, True, True]
    assert whole.flags[H].tolist() == [0, 1, 0, 0, 0]
    assert (set(whole.fresh), set(whole.flags)) == ({H}, {H})
    assert join_blocks([block]) is block
