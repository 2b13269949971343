"""The stage is the literal smoother of the road prior: heights, and how sure they are."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.estimators.smoothing.sigma import Settled, covariances
from floatref.values.channels import ChannelId
from floatref_reference.road_prior.least_squares import least_squares
from floatref_reference.road_prior.smoother import smooth

HEIGHT = ChannelId("floating_reference_height", "left")
C = RoadPrior(
    acceleration=2e-3,
    acceleration_walk=1e-4,
    walk_along=5e-3,
    reading_m=1e-3,
    road=1e-5,
    long_waves=3e-6,
    road_memory_m=1e15,
    edge_sigmas=1e6,
    lean_sigma_rad=0.02,
)
"""The reference's road is the same all the way: the run's own takes its place nowhere, nor has it
edges, which readings drawn without a road would tell of."""
LITERAL = 3e-6
"""Of the largest state. The literal smoother inverts covariances of seven states at every sample,
whose condition numbers go up to 2e8: 2e-16 of rounding each, at random in up to 2400 samples."""
LEAST_SQUARES = 1e-7
"""Of the largest height: it inverts no covariance, so that it is held to far closer."""
laws = settings(deadline=None, max_examples=5, phases=[Phase.explicit, Phase.generate])
PRIORS = (C.lean_sigma_rad, C.tilt_sigma)
SEEDS = st.integers(0, 2**32 - 1)
STOPS = st.tuples(st.floats(0.4, 1.2), st.floats(0.1, 1.0))


def assert_literal(ours, expected):
    """Compare heights, the difference being the literal smoother's rounding and no more."""
    atol = LITERAL * np.abs(expected.x).max()
    np.testing.assert_allclose(ours, expected.r[0], rtol=0, atol=atol)


@pytest.mark.cites("(1.5)", "(2.2)")
@laws
@given(seed=SEEDS, rate=st.sampled_from([150, 300, 500]), stop=STOPS, share=st.floats(0.3, 1.0))
@example(seed=322, rate=500, stop=(1.1999999999999997, 1.0), share=0.5398218456511824)
def test_heights_and_covariances_agree(drive, through, seed, rate, stop, share):
    drawn = drive(seed, 2.4, rate, (stop[0], sum(stop)), share=share)
    a_x, response = drawn.excitation(C)
    expected = smooth(*drawn.literally(C, (a_x, a_x * response), a_x, PRIORS))
    ours = through(RoadPriorSmoother(C, tolerance_m=0.0), drawn)[HEIGHT]
    assert_literal(ours - drawn.h[0], expected)
    stage = RoadPriorSmoother(C, tolerance_m=0.0)
    stage.start(drawn.header)
    stage.push(drawn.blocks()[0])
    line = stage.memory["backlog"].lines["left"]
    stage.memory["excitation"].end()
    stage._filter_known()
    line.end_segment()
    (segment,) = line.segments
    found = np.diag(covariances(Settled.of([segment.marks])))
    sure = expected.sigma_r[0][segment.marks.at]
    np.testing.assert_allclose(np.sqrt(found), sure, rtol=1e-5)


@pytest.mark.slow
@laws
@given(
    seed=SEEDS,
    rate=st.sampled_from([60, 150, 500]),
    stop=st.tuples(st.floats(0.2, 0.5), st.floats(0.05, 0.4)),
    share=st.floats(0.3, 1.0),
)
def test_short_drives_agree_with_least_squares_to_the_rounding_of_both(
    drive, through, seed, rate, stop, share
):
    """120 samples; the stop is at a share of them."""
    lasts = 120 / rate
    drawn = drive(seed, lasts, rate, (lasts * stop[0], lasts * sum(stop)), share=share)
    a_x, response = drawn.excitation(C)
    literally = drawn.literally(C, (a_x, a_x * response), a_x, PRIORS)
    expected = least_squares(*literally).x[:, 0]
    ours = through(RoadPriorSmoother(C, tolerance_m=0.0), drawn)[HEIGHT] - drawn.h[0]
    atol = LEAST_SQUARES * np.abs(expected).max()
    np.testing.assert_allclose(ours, expected, rtol=0, atol=atol)


@pytest.mark.slow
@laws
@given(seed=SEEDS, rate=st.sampled_from([1000, 1500, 2000]), stop=STOPS)
def test_between_nodes_they_agree_as_well(drive, through, seed, rate, stop):
    """The literal smoother goes from sample to sample, with heights at the nodes alone."""
    constants, every = replace(C, walk_along=0.0), rate // 500
    drawn = drive(seed, 1.2, rate, (0.5 * stop[0], 0.5 * sum(stop)))
    nodes = np.arange(0, drawn.a.size, every)
    a_x, response = drawn.excitation(C, every)
    inputs = [np.interp(np.arange(drawn.a.size), nodes, u) for u in (a_x, a_x * response)]
    h = np.full(drawn.h.size, np.nan)
    h[nodes] = drawn.h[nodes]
    literally = replace(drawn, h=h).literally(constants, inputs, np.zeros(h.size), PRIORS)
    expected = smooth(*literally)
    ours = through(RoadPriorSmoother(constants, tolerance_m=0.0), drawn)[HEIGHT]
    assert_literal(ours - drawn.h[0], expected)


@pytest.mark.slow
@laws
@given(seed=SEEDS, begin=st.floats(9.5, 10.4))
def test_lean_and_tilt_of_a_brake_are_others_after_a_constant_speed(drive, through, seed, begin):
    """A brake before and one behind: the literal smoother is given coefficients for each."""
    one, rate = drive(seed, 6.0, 60, (-0.8, -0.4)), 60
    other = drive(seed + 1, 20.0, rate, (begin, begin + 0.5))
    drawn = one.followed_by(other)
    a_x, response = drawn.excitation(C)
    anew = [k * 4 * rate for k in range(1, 7) if _steady(drawn, k * 4 * rate)]
    assert anew
    part = np.searchsorted(anew, np.arange(a_x.size), "right")
    inputs = [
        np.where(part == k, u, 0.0) for k in range(len(anew) + 1) for u in (a_x, a_x * response)
    ]
    expected = smooth(*drawn.literally(C, inputs, a_x, PRIORS * (len(anew) + 1)))
    ours = through(RoadPriorSmoother(C, tolerance_m=0.0), drawn)[HEIGHT]
    assert_literal(ours - drawn.h[0], expected)


def _steady(drive, sample):
    at = sample - drive.rate * np.arange(5)
    if at[-1] < 0:
        return False
    speeds = -np.diff(drive.distance[at])
    return speeds.min() > 5.0 and np.ptp(speeds) < 0.4
