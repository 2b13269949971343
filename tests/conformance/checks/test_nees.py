"""The NEES: one where sigma is right, four where the errors are twice as large."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.nees import PathNees, mean_nees, nees_ends, nees_of

DX = 0.05
SIGMA = 1e-3
laws = settings(deadline=None, max_examples=10)


def profile(elevation, sigma=None, valid=None, name="left", start_m=0.0):
    return Profile(DX, (ProfileTrack.of(name, elevation, valid, sigma),), start_m)


@laws
@given(seed=st.integers(0, 2**32 - 1), factor=st.sampled_from([0.5, 1.0, 2.0]))
def test_errors_as_large_as_stated_have_one(seed, factor):
    """Within six deviations of the mean of 4000 squares."""
    rng = np.random.default_rng(seed)
    road, sigma = rng.normal(size=4000), rng.uniform(0.5, 2.0, 4000) * SIGMA
    found = nees_of(profile(road), profile(road + factor * sigma * rng.normal(size=4000), sigma))
    (path,) = found
    assert (path.track, path.points) == ("left", 4000)
    assert path.mean == pytest.approx(factor**2, rel=6.0 * np.sqrt(2.0 / 4000))


def test_only_valid_points_with_a_sigma_count():
    road = np.zeros(400)
    sigma, valid = np.full(400, SIGMA), np.ones(400, np.bool_)
    result = np.where(np.arange(400) < 200, SIGMA, 9.0)
    valid[200:300] = False
    sigma[300:350], result[350:] = np.nan, np.nan
    (path,) = nees_of(profile(road), profile(result, sigma, valid))
    assert (path.mean, path.points) == (pytest.approx(1.0), 200)


def test_points_are_compared_at_their_own_places():
    """The truth is finer, and starts elsewhere."""
    x = 0.01 * np.arange(5000)
    truth = Profile(0.01, (ProfileTrack.of("left", 1e-3 * x),), -10.0)
    own = DX * np.arange(300)
    (path,) = nees_of(truth, profile(1e-3 * (own + 10.0) + SIGMA, np.full(300, SIGMA)))
    assert path.mean == pytest.approx(1.0)


def test_what_states_no_sigma_or_lies_elsewhere_has_none():
    road = np.zeros(100)
    assert nees_of(profile(road), profile(road)) == ()
    assert nees_of(profile(road), profile(road, road + SIGMA, name="other")) == ()
    assert nees_of(profile(road), profile(road, road + SIGMA, np.zeros(100, np.bool_))) == ()
    assert nees_of(profile(road), profile(road, road + SIGMA, start_m=900.0)) == ()


def test_a_sigma_of_nothing_does_not_count():
    error, sigma = np.array([1.0, 2.0, np.nan]), np.array([0.0, 1.0, 1.0])
    assert mean_nees(error, sigma) == (4.0, 1)
    assert mean_nees(error, np.zeros(3)) == (None, 0)


def test_ends_name_the_highest():
    cases = [
        ("a", [PathNees("left", 1.0, 9), PathNees("right", 7.0, 9)]),
        ("b", ()),
        ("a", [PathNees("left", 2.0, 9)]),
    ]
    found = nees_ends(cases)
    assert found is not None
    assert (found.wheel_paths, found.lowest, found.median, found.highest) == (3, 1.0, 2.0, 7.0)
    assert (found.highest_case, found.highest_track) == ("a", "right")
    assert nees_ends([("a", ())]) is None
