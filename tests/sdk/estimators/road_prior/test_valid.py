"""What is vouched for: 1-σ is at most a share of how far the road bends, over 16 m."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.values.arrays import Flag
from floatref.values.channels import ChannelId

HEIGHT, SIGMA = (ChannelId(n, "left") for n in ("floating_reference_height", "elevation_sigma"))
RATE, SECONDS, SPEED = 100, 80.0, 16.0
RENEWED = 5 * RATE
"""No road is renewed before."""


def run_over(drive, through, seed, rougher, constants):
    """Return 1-σ and flags of a level run over a road ``rougher`` times the start's, and it."""
    drawn, rng = drive(seed, SECONDS, RATE, speed=SPEED), np.random.default_rng(seed)
    travel, count = SPEED / RATE, drawn.a.size
    slope = np.cumsum(np.sqrt(constants.long_waves * travel) * rng.normal(size=count))
    walk = np.sqrt(constants.road * travel) * rng.normal(size=count)
    road = rougher * np.cumsum(walk + travel * (slope - slope.mean()))
    level = replace(drawn, a=1e-4 * rng.normal(size=count), h=0.3 - road)
    out = through(RoadPriorSmoother(constants), level)
    return out[SIGMA], out.flags.get(HEIGHT, np.zeros(count, np.uint8)) == Flag.UNCERTAIN, road


def bend_of_start(constants):
    """Return the RMS second difference over 16 m by (2.4)."""
    return np.sqrt(2 * 16 * constants.road + 2 / 3 * 16**3 * constants.long_waves)


def share_between(sigma, low_m, high_m):
    """Return a share of which ``sigma`` is more of ``low_m``, less of ``high_m``."""
    return float(np.median(sigma)) / np.sqrt(low_m * high_m)


@pytest.mark.cites("(2.4)")
@pytest.mark.parametrize("seed", range(3))
def test_a_rougher_road_vouches_for_more_once_it_is_known(drive, through, seed):
    """Its own bends count, as they are found by looking at it: 16 m are 100 samples."""
    usual = RoadPrior()
    sigma, _, road = run_over(drive, through, seed, 8.0, usual)
    late = slice(4000, -2000)
    bend_m = np.sqrt(np.mean((road[200:] - 2 * road[100:-100] + road[:-200]) ** 2))
    low_m = bend_of_start(usual)
    share = share_between(sigma[late], low_m, bend_m)
    constants = replace(usual, most_sigma_share=share)
    sigma, flagged, _ = run_over(drive, through, seed, 8.0, constants)
    np.testing.assert_array_equal(flagged[:RENEWED], (sigma > share * low_m)[:RENEWED])
    assert (sigma > share * low_m)[late].all()
    assert not flagged[late].any()


@pytest.mark.cites("(2.4)")
@pytest.mark.parametrize("seed", range(3))
def test_a_smoother_road_is_held_to_that_of_the_start(drive, through, seed):
    usual = RoadPrior()
    sigma, _, _ = run_over(drive, through, seed, 0.2, usual)
    low_m = bend_of_start(usual)
    late = slice(4000, -2000)
    share = share_between(sigma[late], low_m, 0.5 * low_m)
    constants = replace(usual, most_sigma_share=share)
    sigma, flagged, _ = run_over(drive, through, seed, 0.2, constants)
    np.testing.assert_array_equal(flagged, sigma > share * low_m)
    assert not flagged[late].any()
    assert (sigma > 0.5 * share * low_m)[late].all()
