"""The datum of a signal, and what is dropped."""

from fractions import Fraction

import numpy as np
import pytest

from floatref.stages.conditioning import Drop, FromFirst
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

LEFT, RIGHT, TIME = ChannelId("height", "left"), ChannelId("height", "right"), ChannelId("time")
HEADER = Header(
    Axis.TIME, 0.1, 0.0, Fraction(10), frozenset({LEFT, RIGHT, TIME}), ("left", "right")
)


def test_every_track_begins_at_zero_and_keeps_its_shape():
    stage = FromFirst("height")
    stage.start(HEADER)
    x = {LEFT: np.array([0.3, 0.5, 0.2]), RIGHT: np.array([-1.0, 2.0, 5.0]), TIME: np.ones(3)}
    out = stage.push(Block(0, x))
    for channel in (LEFT, RIGHT):
        assert out[channel] == pytest.approx(x[channel] - x[channel][0], abs=0)
    assert stage.push(Block(3, x))[LEFT][0] == 0.0


def test_a_missing_first_sample_is_no_datum():
    stage = FromFirst("height")
    stage.start(HEADER)
    late = np.array([np.nan, 4.0, 5.0])
    first = {LEFT: np.full(3, np.nan), RIGHT: late, TIME: np.ones(3)}
    assert stage.push(Block(0, first))[RIGHT][1:] == pytest.approx([0.0, 1.0])
    assert stage.push(Block(3, {**first, LEFT: late}))[LEFT][1:] == pytest.approx([0.0, 1.0])


def test_a_name_is_dropped_for_all_tracks():
    stage = Drop("height")
    assert stage.start(HEADER).channels == {TIME}
    block = Block(0, {LEFT: np.ones(2), RIGHT: np.ones(2), TIME: np.ones(2)})
    assert set(stage.push(block).values) == {TIME}
