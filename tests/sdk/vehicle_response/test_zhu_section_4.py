"""Section 4 of Zhu et al.: random roads of class E, the obstacle, and the rate tied to the speed.

The motion is integrated apart, see `zhu_simulation` among the benchmarks, and `bench_zhu`, which
draws the figures.
"""

import importlib
from pathlib import Path

import numpy as np
import pytest

from floatref.vehicle_response import Hold

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
LARGEST_OF_TABLE_2 = 10.34
SHARE_OF_OBSTACLE = 0.15


@pytest.fixture(scope="module")
def bench():
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(BENCHMARKS))
        yield importlib.import_module("bench_zhu")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_every_random_road_is_within_the_largest_of_table_2(bench, seed):
    spacing = bench.SPEED / bench.RATE
    front, _, both = bench.random_road(seed, spacing, Hold.ZERO_ORDER)
    assert both <= front <= LARGEST_OF_TABLE_2
    assert bench.random_road(seed, spacing, Hold.FIRST_ORDER)[2] <= LARGEST_OF_TABLE_2


def test_a_road_that_is_rough_between_samples_is_within_it_as_well(bench):
    assert bench.random_road(1, 0.005, Hold.FIRST_ORDER)[2] <= LARGEST_OF_TABLE_2


@pytest.mark.parametrize("seed", range(2))
def test_the_obstacle_is_found_within_15_percent(bench, seed):
    place, true, found = bench.over_obstacle(seed)
    assert true.max() == 0.2
    assert place[true > 0.1][[0, -1]] == pytest.approx([8.0, 8.8], abs=0.05)
    # At its ends the road jumps at a sample.
    edges = np.minimum(np.abs(place - 8.0), np.abs(place - 8.8)) < 0.02
    assert np.abs(found - true)[~edges].max() <= SHARE_OF_OBSTACLE * 0.2


@pytest.mark.slow
def test_with_the_tied_rate_two_speeds_give_like_spectra(bench):
    slow, fast = (bench.at_speed(*pair, 200.0) for pair in ((10.0, 200.0), (20.0, 400.0)))
    np.testing.assert_allclose(slow[0], fast[0])
    np.testing.assert_allclose(slow[2], fast[2], rtol=1e-3)
    for waves, found, road in (slow, fast):
        np.testing.assert_allclose(bench.band_ratios(waves, found, road), 1.0, atol=0.15)
    np.testing.assert_allclose(bench.band_ratios(slow[0], slow[1], fast[1]), 1.0, atol=0.15)
