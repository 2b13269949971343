"""The laws of the stage protocol, with segments that close and samples that are missing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.estimators.road_prior import RoadPriorSmoother
from floatref.values.channels import ChannelId
from floatref_conformance.testing import StageLaws

pytestmark = pytest.mark.slow

RATE, LENGTH = 100, 2100
HEIGHT, SIGMA = (ChannelId(n, "left") for n in ("floating_reference_height", "elevation_sigma"))
laws = settings(deadline=None, max_examples=5)
SEEDS = st.integers(0, 2**32 - 1)


def smoother():
    return RoadPriorSmoother(wavelength_m=20.0, tolerance_m=1e-3, waiting_s=0.0)


def lacking(drive, seed):
    drawn = drive(seed, LENGTH / RATE, RATE, (9.0, 11.0), share=0.95)
    rng = np.random.default_rng(seed)
    drawn.a[rng.uniform(size=LENGTH) < 0.01] = np.nan
    drawn.distance[700:705] = np.nan
    return drawn


@laws
@given(
    seed=SEEDS,
    cuts=st.lists(st.integers(1, LENGTH - 1), max_size=8, unique=True),
    every=st.sampled_from([1, 7, 512, 1300]),
)
def test_any_split_gives_the_same_bits(drive, through, seed, cuts, every):
    drawn = lacking(drive, seed)
    whole = through(smoother(), drawn)
    for pieces in (cuts, range(every, LENGTH, every)):
        found = through(smoother(), drawn, pieces)
        for channel, samples in whole.values.items():
            np.testing.assert_array_equal(found[channel], samples, err_msg=str(channel))
        for channel, marks in whole.flags.items():
            np.testing.assert_array_equal(found.flags[channel], marks, err_msg=str(channel))
    assert np.isfinite(whole[HEIGHT]).all()
    assert np.isfinite(whole[SIGMA]).all()


def test_blocks_between_two_nodes_give_the_same_bits(drive, through):
    """Some of them have no node at all."""
    drawn = drive(5, 0.5, 3200)
    whole = through(smoother(), drawn)
    found = through(smoother(), drawn, range(2, drawn.a.size, 2))
    for channel, samples in whole.values.items():
        np.testing.assert_array_equal(found[channel], samples, err_msg=str(channel))


@laws
@given(seed=SEEDS)
def test_segments_come_out_before_the_run_ends(drive, seed):
    drawn = drive(seed, 60.0, RATE, (20.0, 30.0))
    stage = smoother()
    stage.start(drawn.header)
    out = [stage.push(block) for block in drawn.blocks(range(50, 6000, 50))]
    assert 0 < sum(map(len, out)) < 6000
    assert sum(map(len, out)) + sum(map(len, stage.finish())) == 6000


@pytest.mark.parametrize("length", [1, 2, 3, 512, 513])
def test_a_run_of_any_length_comes_out_whole(drive, through, length):
    out = through(smoother(), drive(1, length / RATE, RATE))
    assert len(out) == length
    assert all(np.isfinite(samples).all() for samples in out.values.values())


@pytest.mark.parametrize("missing", ["vertical_acceleration", "height", "distance"])
def test_a_channel_that_is_not_there_is_named(drive, missing):
    header = drive(1, 0.1, RATE).header.without(missing)
    with pytest.raises(
        InputError, match=f"needs channel (left.)?{missing}; add a stage that makes it"
    ):
        smoother().start(header)


def test_it_works_in_time_alone(drive):
    with pytest.raises(InputError, match="the stream is not on the time axis"):
        smoother().start(drive(1, 0.1, RATE).header.on_distance(0.05, 0.0))


class TestRoadPriorSmoother(StageLaws):
    """Two wheel paths, and samples that agree with no drive."""

    reads = ("vertical_acceleration", "height")
    shared = ("distance",)
    reach = None

    def make(self):
        return RoadPriorSmoother()
