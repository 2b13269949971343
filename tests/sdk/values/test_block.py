"""Blocks and headers change by making new ones; the old ones stay."""

from fractions import Fraction

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.block import Axis, Block, Header
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
    with pytest.raises(InputError, match="stage combine needs channel distance; add what makes it"):
        header.require("combine", A, ChannelId("distance"))
