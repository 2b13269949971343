"""What is missing: travel goes on as before, and without acceleration less is known."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.values.arrays import Flag
from floatref.values.channels import ChannelId

RATE = 100
HEIGHT, SIGMA = (ChannelId(n, "left") for n in ("floating_reference_height", "elevation_sigma"))
LINEAR = RoadPrior(most_sigma_share=1e6, road_memory_m=1e15, edge_sigmas=1e6)
"""No road is rough enough to be told from the run, and no reading so far off that it is an edge."""
ROUNDING = 1e-6
"""Covariances of conditions up to 2e8 are rounded at 2e-16."""
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
    expected = through(RoadPriorSmoother(constants), whole)[HEIGHT]
    np.testing.assert_allclose(silent, expected, rtol=0, atol=1e-7)


def deviations(drive, through, seed, gaps, constants=LINEAR):
    """Return 1-σ with and without the acceleration in slices ``gaps``, and the flags with each."""
    whole, found = drive(seed, 6.0, RATE), []
    for gap in (slice(0, 0), *gaps):
        a = whole.a.copy()
        a[gap] = np.nan
        out = through(RoadPriorSmoother(constants, tolerance_m=0.0), replace(whole, a=a))
        found.append((out[SIGMA], out.flags.get(HEIGHT, np.zeros(a.size, np.uint8))))
    return zip(*found, strict=True)


@laws
@example(seed=4294967294, begin=209, count=20, less=5)
@given(
    seed=SEEDS,
    begin=st.integers(200, 350),
    count=st.integers(20, 50),
    less=st.integers(1, 10),
)
def test_without_acceleration_less_is_known(drive, through, seed, begin, count, less):
    """Of Gaussians, the less there is, the larger is the variance of any sum of the states.

    So 1-σ grows with the gap everywhere, were it little: it is that of the filtered elevation, to
    which errors far from the gap add as well. Road and edges are not told by the readings here.
    """
    shorter, gap = slice(begin + less, begin + count - less + 1), slice(begin, begin + count)
    sigmas, flags = deviations(drive, through, seed, (shorter, gap))
    for one, other in pairwise(sigmas):
        assert (other >= one * (1 - ROUNDING)).all()
    assert (sigmas[2][gap] > sigmas[1][gap]).all()
    assert flags[2][gap].all()
    assert not flags[2][:begin].any()


@laws
@given(seed=SEEDS, missing=st.floats(0.01, 10.0))
def test_no_acceleration_at_all_is_an_accelerometer_of_so_much_noise(drive, through, seed, missing):
    constants = replace(LINEAR, missing_acceleration=missing)
    found, flags = deviations(drive, through, seed, (slice(None),), constants)
    noisy = replace(LINEAR, acceleration=missing)
    (expected, _), _ = deviations(drive, through, seed, (slice(0, 1),), noisy)
    np.testing.assert_allclose(found[1], expected, rtol=ROUNDING)
    assert flags[1].all()


@laws
@given(seed=SEEDS, share=st.floats(0.03, 3.0))
def test_what_is_less_sure_than_asked_for_is_flagged(drive, through, seed, share):
    """The memory is so long that the road bends as at the start: over 16 m, by (2.4)."""
    drawn, road = drive(seed, 20.0, RATE, (8.0, 12.0)), RoadPrior(road_memory_m=1e15)
    bend_m = np.sqrt(2 * 16 * road.road + 2 / 3 * 16**3 * road.long_waves)
    out = through(RoadPriorSmoother(replace(road, most_sigma_share=share)), drawn)
    flags = out.flags.get(HEIGHT, np.zeros(len(out), np.uint8))
    doubted = (flags & np.uint8(Flag.UNCERTAIN)) != 0
    np.testing.assert_array_equal(doubted, out[SIGMA] > share * bend_m)
