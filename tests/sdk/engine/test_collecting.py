"""What is gathered piece by piece is what lies in the pieces."""

import tracemalloc
from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.engine.collecting import Growing, collect_profile, collect_tracks
from floatref.engine.lookup import pipeline
from floatref.values.block import Axis, Block, Header
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
    found = collect_tracks(iter(blocks), ("left", "right"))
    left, right = found["left"], found["right"]
    assert (left.elevation.tolist(), left.flags.tolist()) == ([1.0, 2.0, 4.0], [0, 0, 0])
    assert (right.elevation.tolist(), right.flags.tolist()) == ([5.0, 6.0, 8.0], [3, 0, 0])
    assert (left.sigma, right.sigma) == (None, None)


def test_every_track_gets_its_own_sigma_if_there_is_one():
    sigmas = ChannelId("elevation_sigma", "left"), ChannelId("elevation_sigma", "right")
    known = dict(zip(sigmas, (np.array([0.1, 0.2]), np.array([0.5, 0.6])), strict=True))
    blocks = [
        Block(0, {LEFT: np.array([1.0, 2.0]), RIGHT: np.array([5.0, 6.0]), **known}),
        Block(
            2, {LEFT: np.ones(1), RIGHT: np.ones(1), sigmas[0]: np.ones(1), sigmas[1]: np.ones(1)}
        ),
    ]
    found = collect_tracks(iter(blocks), ("left", "right"), with_sigma=True)
    assert found["left"].sigma.tolist() == [0.1, 0.2, 1.0]
    assert found["right"].sigma.tolist() == [0.5, 0.6, 1.0]
    assert collect_tracks(iter(blocks), ("left", "right"))["left"].sigma is None


def test_a_profile_takes_its_own_memory_and_none_that_grows_with_it():
    points, piece = 3_000_000, 100_000
    channels, tracks = frozenset({LEFT, RIGHT}), ("left", "right")
    header = Header(Axis.DISTANCE, 0.005, 0.0, Fraction(16000), channels, tracks)
    z, marks = np.zeros(piece), np.zeros(piece, np.uint8)
    blocks = (
        Block(first, {LEFT: z, RIGHT: z}, flags={LEFT: marks, RIGHT: marks})
        for first in range(0, points, piece)
    )
    tracemalloc.start()
    made = collect_profile(header, blocks, pipeline("temporal-hpf"), {}, points)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    own = sum(track.elevation.nbytes + track.valid.nbytes for track in made.tracks)
    assert own == 2 * 9 * points
    # Pieces of 2 MB on their way; a copy of the flags of one track would be 3 MB more.
    assert peak - own < 2e6
