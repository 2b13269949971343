"""Rows that are filled again and again are those that are put together anew."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array, random_array
from tests.sdk.estimators.road_slope.short_runs import RUNS, Run, draw, held

from floatref.estimators.road_slope.layout import Layout
from floatref.estimators.road_slope.sparse.pattern import Pattern, in_common

SEEDS = st.integers(0, 2**32 - 1)


@given(seed=SEEDS, points=st.integers(2, 6), nodes=st.integers(1, 6))
def test_filled_rows_are_the_sum_of_their_parts(seed: int, points: int, nodes: int) -> None:
    rng, layout = np.random.default_rng(seed), Layout(points, nodes)
    body, road = (random_array((4, n), density=0.5, rng=rng, format="csr") for n in (nodes, points))
    pattern = Pattern(layout, (layout.pitch, body), "centre", (layout.slope, road), "gain")
    for _ in range(2):
        body.data, road.data = rng.normal(size=body.nnz), rng.normal(size=road.nnz)
        centre, gain = rng.normal(size=(2, 4))
        found = pattern.fill(body.data, centre, road.data, gain)
        expected = layout.rows(
            (layout.pitch, body), (layout.slope, road), ("centre", centre), ("gain", gain)
        )
        np.testing.assert_array_equal(found.toarray(), expected.toarray())


def test_a_part_that_is_zero_keeps_its_places() -> None:
    layout = Layout(3, 2)
    pattern = Pattern(layout, (layout.pitch, csr_array(np.ones((2, 2)))), "gain")
    empty = pattern.fill(np.zeros(4), np.zeros(2))
    full = pattern.fill(np.ones(4), np.ones(2))
    assert empty.nnz == full.nnz == 6
    np.testing.assert_array_equal(empty.indices, full.indices)


@given(seed=SEEDS, number=st.integers(1, 4), density=st.sampled_from([0.0, 0.3, 1.0]))
def test_sums_of_matrices_are_sums_of_their_values_in_common_places(
    seed: int, number: int, density: float
) -> None:
    rng = np.random.default_rng(seed)
    parts = [random_array((3, 5), density=density, rng=rng, format="csr") for _ in range(number)]
    where, values = in_common(*parts)
    shares = rng.normal(size=number)
    where.data = shares @ values
    expected = sum(share * part.toarray() for share, part in zip(shares, parts, strict=True))
    np.testing.assert_allclose(where.toarray(), expected, atol=1e-14)
    assert where.nnz == np.count_nonzero(sum(part.toarray() != 0 for part in parts))


@settings(deadline=None, max_examples=8)
@given(run=RUNS, seed=SEEDS)
def test_rows_have_their_values_in_the_same_places_at_all_unknowns(run: Run, seed: int) -> None:
    case = draw(run)
    drawn = case.truth + np.random.default_rng(seed).normal(size=case.truth.size)
    first = case.ours.rows(case.ours.start(), held(case)).derivative
    other = case.ours.rows(drawn, held(case)).derivative
    np.testing.assert_array_equal(first.indices, other.indices)
    np.testing.assert_array_equal(first.indptr, other.indptr)
    assert other.has_canonical_format


@pytest.mark.parametrize("count", [1, 3])
def test_a_constant_of_the_vehicle_has_a_value_in_each_row(count: int) -> None:
    layout = Layout(2, 4)
    body = csr_array(np.ones((count, 4)))
    found = Pattern(layout, (layout.bias, body), "lean").fill(body.data, np.arange(1.0, count + 1))
    np.testing.assert_array_equal(
        found.toarray()[:, layout.place("lean")], np.arange(1.0, count + 1)
    )
