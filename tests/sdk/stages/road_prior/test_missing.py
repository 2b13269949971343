"""What is missing: travel goes on as before, and without acceleration less is known."""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.stages.road_prior import RoadPrior, RoadPriorSmoother
from floatref.values.arrays import Flag
from floatref.values.channels import ChannelId

RATE = 100
HEIGHT, SIGMA = (ChannelId(n, "left") for n in ("floating_reference_height", "elevation_sigma"))
laws = settings(deadline=None, max_examples=10)
SEEDS = st.integers(0, 2**32 - 1)


@laws
@given(seed=SEEDS, begin=st.integers(50, 300), count=st.integers(1, 200))
def test_at_a_constant_speed_the_encoder_may_be_silent(drive, through, seed, begin, count):
    """Standing would freeze the road; it goes on at the pace of the node before."""
    whole = drive(seed, 6.0, RATE)
    distance = whole.distance.copy()
    distance[begin : begin + count] = np.nan
    constants = RoadPrior(road_memory_m=1e15)
    silent = through(RoadPriorSmoother(constants), replace(whole, distance=distance))[HEIGHT]
    told = through(RoadPriorSmoother(constants), whole)[HEIGHT]
    np.testing.assert_allclose(silent, told, rtol=0, atol=1e-7)


@laws
@given(seed=SEEDS, begin=st.integers(200, 350), count=st.integers(20, 50))
def test_without_acceleration_less_is_known(drive, through, seed, begin, count):
    whole = drive(seed, 6.0, RATE)
    a = whole.a.copy()
    a[begin : begin + count] = np.nan
    vouched = RoadPrior(most_sigma_share=1e6)
    out = through(RoadPriorSmoother(vouched), replace(whole, a=a))
    usual = through(RoadPriorSmoother(vouched), whole)
    gap = slice(begin, begin + count)
    assert (out[SIGMA][gap] > 1.05 * usual[SIGMA][gap]).all()
    assert out.flags[HEIGHT][gap].all()
    assert not out.flags[HEIGHT][:begin].any()


@laws
@given(seed=SEEDS, share=st.floats(0.03, 3.0))
def test_what_is_less_sure_than_asked_for_is_flagged(drive, through, seed, share):
    """The memory is so long that the road bends as at the start: over 16 m, by (2.4)."""
    drawn, road = drive(seed, 20.0, RATE, (8.0, 12.0)), RoadPrior(road_memory_m=1e15)
    bend_m = np.sqrt(2 * 16 * road.road + 2 / 3 * 16**3 * road.long_waves)
    out = through(RoadPriorSmoother(replace(road, most_sigma_share=share)), drawn)
    flags = out.flags.get(HEIGHT, np.zeros(len(out), np.uint8))
    np.testing.assert_array_equal(flags == Flag.UNCERTAIN, out[SIGMA] > share * bend_m)
