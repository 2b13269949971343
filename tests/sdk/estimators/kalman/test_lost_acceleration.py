"""Where the vertical acceleration is lost for long, little is known, and nothing is made up."""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref.values.arrays import Flag
from floatref.values.block import Block
from floatref.values.channels import ChannelId

RATE, LENGTH = 250, 2000
UP = ChannelId("vertical_acceleration", "left")
HEIGHT, SIGMA = (ChannelId(n, "left") for n in ("floating_reference_height", "elevation_sigma"))
laws = settings(deadline=None, max_examples=6)
SEEDS = st.integers(0, 2**32 - 1)


def flagged(block, begin, end):
    at = block.first + np.arange(len(block))
    marks = np.where((at >= begin) & (at < end), Flag.MISSING | Flag.DRIFT, 0).astype(np.uint8)
    return Block(block.first, block.values, flags={UP: marks}, events=block.events)


def run(stage, drive, begin, end, cuts=()):
    stage.start(drive.header)
    out = [stage.push(flagged(block, begin, end)) for block in drive.blocks(cuts)]
    out = [block for block in (*out, *stage.finish()) if len(block)]
    return {c: np.concatenate([block[c] for block in out]) for c in out[0].values}


@laws
@given(
    seed=SEEDS,
    begin=st.integers(500, 1200),
    count=st.integers(3, 250),
    cuts=st.lists(st.integers(1, LENGTH - 1), max_size=6, unique=True),
    stage=st.sampled_from([KalmanFilter, KalmanSmoother]),
)
def test_any_split_gives_the_same_bits(drive, seed, begin, count, cuts, stage):
    drawn = drive(seed, LENGTH / RATE, RATE, (3.0, 5.0))
    whole, cut = (
        run(stage(Plan(), Noise()), drawn, begin, begin + count, c) for c in ((), sorted(cuts))
    )
    np.testing.assert_array_equal(whole[HEIGHT], cut[HEIGHT])


@laws
@given(seed=SEEDS, begin=st.integers(500, 1200), count=st.integers(50, 250))
def test_it_is_near_the_truth_and_sure_of_little(drive, seed, begin, count):
    """Acceleration that is told as zero for up to a second; GNSS bounds what that does."""
    drawn = drive(seed, LENGTH / RATE, RATE)
    u = drawn.u.copy()
    u[begin : begin + count, 2] = 9.80665
    silent = replace(drawn, u=u)
    whole = run(KalmanSmoother(Plan(), Noise()), drawn, 0, 0)
    found = run(KalmanSmoother(Plan(), Noise()), silent, begin, begin + count)
    off = np.abs(found[HEIGHT] - whole[HEIGHT])
    believed = run(KalmanSmoother(Plan(), Noise()), silent, 0, 0)
    assert off.max() < np.abs(believed[HEIGHT] - whole[HEIGHT]).max()
    inside = slice(begin + count // 2, begin + count // 2 + 1)
    assert (found[SIGMA][inside] > whole[SIGMA][inside]).all()
    outside = np.r_[: begin - 250, begin + count + 250 : LENGTH]
    assert np.median(off[outside]) < 0.02
