"""Covariances of the smoother between marks, against products of matrices."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.models.kalman_values import STATES
from floatref.estimators.smoothing import covariance

laws = settings(deadline=None, max_examples=20)
SEEDS = st.integers(0, 2**32 - 1)
COUNTS = st.integers(1, 6)


def drawn(seed, count):
    """Return P, Psi from the mark before, and what the observations in between gather."""
    rng = np.random.default_rng(seed)
    roots = rng.normal(size=(2, count, STATES, STATES)) / 3
    p, gathered = roots @ roots.transpose(0, 1, 3, 2)
    return p, rng.normal(size=(count, STATES, STATES)) / 3, gathered


def settled(p, passed, gathered):
    """Return (I - Lambda P) e_r at every mark, nothing known behind the last."""
    found, information = [], np.zeros((STATES, STATES))
    for spread, psi, sums in zip(p[::-1], passed[::-1], gathered[::-1], strict=True):
        found.append(np.eye(STATES)[0] - information @ spread[:, 0])
        information = psi.T @ information @ psi + sums
    return np.array(found[::-1])


@pytest.mark.cites("(6.22)")
@given(seed=SEEDS, count=COUNTS)
@laws
def test_what_the_readings_behind_a_mark_leave_of_its_error(seed, count):
    p, passed, gathered = drawn(seed, count)
    left = np.full((count, STATES), np.nan)
    covariance.settle(p[:, :, 0].copy(), passed, gathered, left)
    np.testing.assert_allclose(left, settled(p, passed, gathered), atol=1e-10)


@given(seed=SEEDS, count=COUNTS, width=st.sampled_from([2.5, np.inf]))
@laws
def test_how_two_marks_are_related(seed, count, width):
    """E[e_i e_j'] = P_i Psi_ji' (I - Lambda_j P_j), i not behind j, and no further than a width."""
    p, passed, gathered = drawn(seed, count)
    left, found = settled(p, passed, gathered), np.zeros((count, count))
    place = np.arange(float(count))
    covariance.relate(p[:, :, 0].copy(), left, passed, place, width, found)
    for i in range(count):
        moved = p[i]
        for j in range(i, count):
            moved = moved if j == i else moved @ passed[j].T
            expected = moved[0] @ left[j] if j - i <= width else 0.0
            assert found[i, j] == found[j, i] == pytest.approx(expected, abs=1e-10)


@given(seed=SEEDS, count=COUNTS)
@laws
def test_variance_of_weighted_sums(seed, count):
    """It is w C w', of the marks that have a weight."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(count, count))
    related, weights = root @ root.T, np.zeros((3, count))
    low, high = np.sort(rng.integers(0, count + 1, (2, 3)), axis=0)
    for row, begin, end in zip(weights, low, high, strict=True):
        row[begin:end] = rng.normal(size=end - begin)
    found = np.empty(3)
    covariance.spread(related, weights, low, high, found)
    expected = np.einsum("ki,ij,kj->k", weights, related, weights)
    np.testing.assert_allclose(found, expected, atol=1e-9)


@pytest.mark.slow
@given(seed=SEEDS, count=COUNTS)
@laws
def test_what_of_a_height_reaches_the_last_mark(seed, count):
    p, passed, _ = drawn(seed, count)
    found = np.full((count, STATES), np.nan)
    covariance.reach(p[:, :, 0].copy(), passed, found)
    psi = np.eye(STATES)
    for i in range(count - 1, -1, -1):
        np.testing.assert_allclose(found[i], psi @ p[i][:, 0], atol=1e-10)
        psi = psi @ passed[i]
