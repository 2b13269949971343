"""Marks at a standstill are let go of, and what passed through them stays."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.smoothing.sigma import Settled, sigma

STATES, NOISE_M, WAVE_M = 3, 1e-3, 20.0


def drawn(seed: int, place: np.ndarray) -> Settled:
    """Return marks at ``place`` of a filter that does not exist."""
    rng, n = np.random.default_rng(seed), place.size
    passed = np.eye(STATES) * 0.9 + 0.05 * rng.standard_normal((n, STATES, STATES))
    root = 0.2 * rng.standard_normal((n, STATES, STATES))
    column = 0.1 * rng.standard_normal((n, STATES))
    left = np.empty((n, STATES))
    return Settled(np.arange(n), place, column, passed, root @ root.transpose(0, 2, 1), left)


@settings(deadline=None, max_examples=40)
@given(seed=st.integers(0, 999), stops=st.lists(st.integers(1, 9), min_size=1, max_size=6))
def test_the_marks_that_stay_are_settled_as_among_all(seed: int, stops: list[int]) -> None:
    place = np.repeat(3.0 * np.arange(len(stops)), stops)
    marks = drawn(seed, place)
    later = drawn(seed + 1, place[-1] + np.arange(1.0, 6.0))
    thin = marks.without_standing()
    kept = [
        k
        for k in range(place.size)
        if not (0 < k < place.size - 1 and place[k - 1] == place[k] == place[k + 1])
    ]
    np.testing.assert_array_equal(thin.at, kept)
    whole, some = later.behind(marks), later.behind(thin)
    chosen = [*kept, *range(place.size, place.size + 5)]
    np.testing.assert_allclose(some.left, whole.left[chosen], rtol=1e-9, atol=1e-12)
    end = len(some.at)
    found = sigma(some, len(kept), end, WAVE_M, NOISE_M)
    expected = sigma(whole, place.size, place.size + 5, WAVE_M, NOISE_M)
    np.testing.assert_allclose(found, expected, rtol=1e-9)


@pytest.mark.parametrize("stop", [3, 300])
def test_a_stop_leaves_two_marks_however_long(stop: int) -> None:
    place = np.concatenate([[0.0, 1.0], np.full(stop, 2.0), [3.0]])
    assert len(drawn(1, place).without_standing().at) == 5
