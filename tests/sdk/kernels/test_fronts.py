"""Factors by fronts are those of a dense Cholesky factor, in whatever order unknowns come."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels.fronts import (
    PIVOTS,
    SLOTS,
    factor_fronts,
    give_slots,
    multiply_inverse,
    solve_fronts,
)
from floatref.values.arrays import FloatArray, IndexArray

SEEDS = st.integers(0, 2**32 - 1)
Factors = tuple[FloatArray, FloatArray, IndexArray]
some = settings(deadline=None, max_examples=40)


def chain(seed: int, count: int, reach: int, shared: int) -> FloatArray:
    """Return rows of ``count`` unknowns of which few that are next to each other are together.

    The last ``shared`` of them are in rows with all others: an arrow.
    """
    rng = np.random.default_rng(seed)
    rows = np.zeros((2 * count, count))
    for row, begin in zip(rows, np.repeat(np.arange(count), 2), strict=True):
        row[begin : begin + reach] = rng.normal(size=row[begin : begin + reach].size)
    rows[:, count - shared :] += rng.normal(size=(2 * count, shared))
    return rows


def factored(rows: FloatArray) -> Factors:
    """Return panel, diagonal and pivots of the rows, every place taken for a value."""
    count = rows.shape[1]
    groups = -(-count // PIVOTS)
    begins = np.argmax(rows != 0.0, axis=1) // PIVOTS
    enters = np.array([begins[rows[:, k] != 0.0].min() for k in range(count)])
    entering, slots = np.argsort(enters, kind="stable"), np.empty(count, np.int64)
    bounds = np.searchsorted(enters[entering], np.arange(groups + 1))
    width = give_slots(entering, bounds, slots)
    pivots = np.full((groups, PIVOTS), -1)
    pivots.flat[:count] = slots
    ordered = rows[np.argsort(begins, kind="stable")]
    values, places, starts = [], [], [0]
    for row in ordered:
        filled = sorted((slots[k], row[k]) for k in np.flatnonzero(row))
        places += [slot for slot, _ in filled]
        values += [value for _, value in filled]
        starts.append(len(values))
    first = np.searchsorted(np.sort(begins), np.arange(groups + 1))
    panel, diagonal = np.empty((groups, PIVOTS, width)), np.empty((groups, PIVOTS))
    read = np.array(values), np.array(places), np.array(starts)
    if not factor_fronts(*read, first, pivots, panel, diagonal):
        raise np.linalg.LinAlgError
    return panel, diagonal, pivots


CHAINS = st.builds(
    chain, SEEDS, st.integers(1, 70), st.integers(1, 9), st.integers(0, 1)
) | st.builds(chain, SEEDS, st.integers(20, 70), st.integers(1, 20), st.integers(0, 9))


@some
@given(rows=CHAINS)
def test_the_diagonal_is_that_of_a_cholesky_factor_squared(rows: FloatArray) -> None:
    _, diagonal, _ = factored(rows)
    expected = np.square(np.diag(np.linalg.cholesky(rows.T @ rows)))
    np.testing.assert_allclose(diagonal.ravel()[: expected.size], expected, rtol=1e-6)
    assert (diagonal.ravel()[expected.size :] == 1.0).all()


@some
@given(rows=CHAINS, seed=SEEDS)
def test_it_solves_as_the_dense_matrix_does(rows: FloatArray, seed: int) -> None:
    factors, count = factored(rows), rows.shape[1]
    normal, expected = rows.T @ rows, np.random.default_rng(seed).normal(size=count)
    found = np.zeros(factors[1].size)
    found[:count] = normal @ expected
    solve_fronts(*factors, found)
    np.testing.assert_allclose(found[:count], expected, atol=1e-12 * np.linalg.cond(normal))


@some
@given(rows=CHAINS, seed=SEEDS, number=st.integers(1, 5))
def test_it_multiplies_by_the_inverse_from_both_sides(
    rows: FloatArray, seed: int, number: int
) -> None:
    factors, count = factored(rows), rows.shape[1]
    normal, wanted = rows.T @ rows, np.random.default_rng(seed).normal(size=(count, number))
    columns, product = np.zeros((factors[1].size, number)), np.zeros((number, number))
    columns[:count] = wanted
    multiply_inverse(*factors, columns, product)
    expected = np.tril(wanted.T @ np.linalg.solve(normal, wanted))
    size = np.abs(expected).max()
    np.testing.assert_allclose(
        -product / size, expected / size, atol=1e-12 * np.linalg.cond(normal)
    )


@some
@given(seed=SEEDS, count=st.integers(1, 60))
def test_two_that_are_in_the_front_at_once_have_two_slots(seed: int, count: int) -> None:
    """There are no more slots than the most that are there at once."""
    rng = np.random.default_rng(seed)
    last = np.arange(count) // PIVOTS
    enters = rng.integers(0, last + 1)
    entering, slots = np.argsort(enters, kind="stable"), np.empty(count, np.int64)
    bounds = np.searchsorted(enters[entering], np.arange(last[-1] + 2))
    width = give_slots(entering, bounds, slots)
    there = [slots[(enters <= g) & (g <= last)] for g in range(last[-1] + 1)]
    assert all(np.unique(each).size == each.size for each in there)
    assert max(each.size for each in there) == slots.max() + 1
    assert width == SLOTS * np.ceil((slots.max() + 1) / SLOTS)


@pytest.mark.parametrize("value", [0.0, np.nan, np.inf])
@pytest.mark.parametrize("where", [0, 17, 29])
def test_a_matrix_that_is_not_positive_has_no_factors(value: float, where: int) -> None:
    rows = chain(0, 30, 3, 0)
    rows[rows[:, where] != 0.0, where] = value or 1e-170
    with pytest.raises(np.linalg.LinAlgError):
        factored(rows)
