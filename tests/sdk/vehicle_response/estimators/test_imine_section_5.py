"""Section V of Imine et al.: the chirp, the left wheel, and the right wheel that stands.

The motion is simulated apart, see `imine_cases` among the benchmarks, which draws the figures.
"""

import importlib
from pathlib import Path

import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"
SEEDS = [1, 2, 3]


@pytest.fixture(scope="module")
def cases():
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(BENCHMARKS))
        yield importlib.import_module("imine_cases")


@pytest.fixture(scope="module")
def left_drive(cases):
    """Return a drive whose left wheel alone has a road."""
    return cases.drive(cases.left_road())


def settled(case):
    """The samples at which the observer has settled, the same for both wheels."""
    settled = ~np.isnan(case.estimate.road)
    np.testing.assert_array_equal(settled[:, 0], settled[:, 1])
    return settled[:, 0]


@pytest.mark.slow
def test_the_chirp_is_followed_within_half_a_percent(cases):
    case = cases.observed(cases.drive(cases.chirps))
    assert case.road.shape == (2559, 2)
    assert np.abs(case.road).max() == pytest.approx(1e-3, rel=1e-3)
    assert np.abs(case.error[settled(case)]).max() <= 5e-6
    # Nothing but the start is left out: less than a second.
    assert settled(case)[128:].all()


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_the_left_wheel_is_followed_within_four_thousandths(cases, left_drive, seed):
    case = cases.observed(left_drive, cases.BENCH, seed)
    assert np.abs(case.road[:, 0]).max() == pytest.approx(cases.ROAD_M, rel=0.01)
    assert np.abs(case.error[settled(case), 0]).max() <= 0.004 * np.abs(case.road[:, 0]).max()


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_the_right_wheel_that_stands_varies_around_zero(cases, left_drive, seed):
    case = cases.observed(left_drive, cases.FIELD, seed)
    assert not case.road[:, 1].any()
    # It does not stand for the sensors: the body moves by nearly a centimetre.
    assert np.abs(case.displacements[:, 2]).max() > 5e-3
    right = case.estimate.road[settled(case), 1]
    assert np.abs(right).max() <= 2e-3
    assert right.min() < 0 < right.max()


@pytest.mark.parametrize("seed", SEEDS)
def test_sigma_tells_the_error_that_noise_makes(cases, left_drive, seed):
    case = cases.observed(left_drive, cases.BENCH, seed)
    error = case.error[settled(case)]
    share = np.mean(np.abs(error) <= 2.0 * case.estimate.road_sigma[settled(case)])
    assert 0.92 <= share <= 0.98
