"""Normal matrices are solved as dense ones are, and in any order of the unknowns."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array, random_array
from tests.sdk.estimators.road_slope.short_runs import braked

from floatref.estimators.road_slope.sparse.elimination import Elimination
from floatref.values.arrays import FloatArray

SEEDS = st.integers(0, 2**32 - 1)
some, few = (settings(deadline=None, max_examples=n) for n in (40, 3))


def drawn(seed: int, count: int, share: float, bordered: bool) -> csr_array:
    """Return rows with a ``share`` of values, one for each unknown, and maybe in full columns."""
    rng = np.random.default_rng(seed)
    rows = random_array((2 * count, count), density=share, rng=rng).toarray()
    rows[:count] += np.diag(rng.uniform(1.0, 2.0, count))
    rows[count:, 0] = 1.0
    if bordered:
        rows[:, rng.choice(count, min(3, count), replace=False)] += 1.0
    return csr_array(rows)


ROWS = st.builds(drawn, SEEDS, st.integers(1, 50), st.sampled_from([0.02, 0.1, 0.5]), st.booleans())


def dense(rows: csr_array) -> FloatArray:
    return np.asarray(np.linalg.inv(rows.toarray().T @ rows.toarray()))


@some
@given(rows=ROWS, seed=SEEDS)
def test_it_solves_as_the_dense_matrix_does_in_any_order(rows: csr_array, seed: int) -> None:
    rng, count = np.random.default_rng(seed), rows.shape[1]
    right, covariance = rng.normal(size=count), dense(rows)
    for order in (np.arange(count), rng.permutation(count)):
        found = Elimination.of(rows, order).factor(rows).solve(right)
        np.testing.assert_allclose(found, covariance @ right, rtol=0, atol=1e-8)


@some
@given(rows=ROWS, seed=SEEDS, number=st.integers(1, 4))
def test_covariances_of_sums_are_those_of_the_inverse(
    rows: csr_array, seed: int, number: int
) -> None:
    rng, count = np.random.default_rng(seed), rows.shape[1]
    weights = rng.normal(size=(number, count))
    factors = Elimination.of(rows, rng.permutation(count)).factor(rows)
    found = factors.covariance(weights)
    np.testing.assert_allclose(found, weights @ dense(rows) @ weights.T, rtol=0, atol=1e-8)
    np.testing.assert_array_equal(found, found.T)


@some
@given(rows=ROWS, seed=SEEDS)
def test_a_plan_is_good_for_other_values_in_the_same_places(rows: csr_array, seed: int) -> None:
    plan = Elimination.of(rows, np.arange(rows.shape[1]))
    other = rows.copy()
    other.data = rows.data * np.random.default_rng(seed).uniform(0.5, 1.5, rows.data.size)
    right = np.ones(rows.shape[1])
    expected = Elimination.of(other, plan.order).factor(other).solve(right)
    np.testing.assert_array_equal(plan.factor(other).solve(right), expected)


@few
@given(seed=SEEDS)
def test_a_stretch_is_solved_within_a_thousandth_of_a_sigma(seed: int) -> None:
    """As by its rows themselves; its normal matrix alone leaves a hundredth."""
    stretch = braked()
    y = stretch.start()
    held = stretch.weights(y, np.full(stretch.layout.points - 1, 1e-5))
    derivative = stretch.rows(y, held).derivative
    misfit = np.random.default_rng(seed).normal(size=derivative.shape[0])
    size = np.linalg.norm(derivative.toarray(), axis=0)
    inverse = np.linalg.pinv(derivative.toarray() / size)
    sigma, expected = np.linalg.norm(inverse, axis=1) / size, inverse @ misfit / size
    found = stretch.elimination.factor(derivative).solve(derivative.T @ misfit)
    np.testing.assert_allclose(found / sigma, expected / sigma, rtol=0, atol=1e-3)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_values_that_are_not_finite_have_no_factors(value: float) -> None:
    rows = drawn(0, 20, 0.1, True)
    plan = Elimination.of(rows, np.arange(20))
    rows.data[7] = value
    with pytest.raises(np.linalg.LinAlgError, match="positive"):
        plan.factor(rows)


def test_an_unknown_that_no_row_has_leaves_no_factors() -> None:
    rows = csr_array(np.array([[1.0, 0.0, 2.0], [0.0, 0.0, 1.0]]))
    with pytest.raises(np.linalg.LinAlgError):
        Elimination.of(rows, np.arange(3)).factor(rows)
