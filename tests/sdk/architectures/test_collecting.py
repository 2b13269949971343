"""What is gathered piece by piece is what lies in the pieces."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.architectures.collecting import Growing, collected
from floatref.values.block import Block
from floatref.values.channels import ChannelId

LEFT, RIGHT = ChannelId("elevation", "left"), ChannelId("elevation", "right")


@given(sizes=st.lists(st.integers(0, 300), max_size=20))
@settings(deadline=None, max_examples=50)
def test_pieces_put_together_are_the_whole_and_no_more(sizes):
    whole = np.arange(sum(sizes), dtype=np.float64)
    growing = Growing(np.float64)
    for piece in np.split(whole, np.cumsum(sizes)[:-1]) if sizes else ():
        growing.extend(piece)
    np.testing.assert_array_equal(growing.close(), whole)


def test_every_track_gets_its_elevation_and_no_flags_are_zeros():
    marks = np.array([3, 0], np.uint8)
    blocks = [
        Block(0, {LEFT: np.array([1.0, 2.0]), RIGHT: np.array([5.0, 6.0])}, flags={RIGHT: marks}),
        Block(2, {LEFT: np.array([4.0]), RIGHT: np.array([8.0])}),
    ]
    found = collected(iter(blocks), ("left", "right"))
    assert [x.tolist() for x in found["left"]] == [[1.0, 2.0, 4.0], [0, 0, 0]]
    assert [x.tolist() for x in found["right"]] == [[5.0, 6.0, 8.0], [3, 0, 0]]
