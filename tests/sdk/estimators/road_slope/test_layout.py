"""Each unknown has its place, and matrices of lines between points hold lines."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array

from floatref.estimators.road_slope.layout import GLOBALS, Layout, between_points, triples
from floatref_reference.road_slope.unknowns import by_name

SEEDS = st.integers(0, 2**32 - 1)
METRES = st.floats(-5.0, 5.0)
SPACINGS = st.floats(0.1, 2.0)


@given(points=st.integers(2, 9), nodes=st.integers(1, 9))
def test_the_unknowns_are_where_the_reference_has_them(points: int, nodes: int) -> None:
    layout = Layout(points, nodes)
    vector = np.arange(float(2 * points + 3 * nodes + 6))
    assert layout.size == vector.size
    expected = by_name(vector, points, nodes)
    for name in expected._fields[:5]:
        assert np.array_equal(vector[getattr(layout, name)], getattr(expected, name))
    assert expected._fields[5:] == GLOBALS
    for name in GLOBALS:
        assert vector[layout.place(name)] == getattr(expected, name)


@given(seed=SEEDS, points=st.integers(2, 6), nodes=st.integers(1, 6))
def test_rows_are_the_sum_of_their_parts(seed: int, points: int, nodes: int) -> None:
    """Two parts have the same unknowns, and a column is that of one constant."""
    rng, layout = np.random.default_rng(seed), Layout(points, nodes)
    first, second = rng.normal(size=(2, 4, nodes))
    road, column = rng.normal(size=(4, points)), rng.normal(size=4)
    found = layout.rows(
        (layout.pitch, csr_array(first)),
        (layout.slope, csr_array(road)),
        ("centre", column),
        (layout.pitch, csr_array(second)),
    )
    y = rng.normal(size=layout.size)
    expected = (first + second) @ y[layout.pitch] + road @ y[layout.slope]
    expected += column * y[layout.place("centre")]
    assert found.shape == (4, layout.size)
    np.testing.assert_allclose(found @ y, expected, atol=1e-12)


@given(seed=SEEDS, nodes=st.integers(3, 12))
def test_triples_take_the_nodes_before_at_and_behind(seed: int, nodes: int) -> None:
    rng = np.random.default_rng(seed)
    values, (a, b, c) = rng.normal(size=nodes), rng.normal(size=3).tolist()
    middles = np.flatnonzero(rng.uniform(size=nodes - 2) < 0.7) + 1
    found = triples(middles, nodes, (a, b, c)) @ values
    expected = [a * values[k - 1] + b * values[k] + c * values[k + 1] for k in middles]
    np.testing.assert_allclose(found, np.array(expected).reshape(-1), atol=1e-12)


@given(seed=SEEDS, first=METRES, spacing=SPACINGS, level=METRES, slope=METRES)
def test_a_straight_line_is_reproduced_also_beyond_its_ends(
    seed: int, first: float, spacing: float, level: float, slope: float
) -> None:
    places = first + spacing * np.random.default_rng(seed).uniform(-3, 12, 30)
    line = level + slope * (first + spacing * np.arange(10))
    found = between_points(places, first, spacing, 10) @ line
    np.testing.assert_allclose(found, level + slope * places, atol=1e-9)


@given(seed=SEEDS, first=METRES, spacing=SPACINGS)
def test_between_points_any_road_is_joined_by_lines(
    seed: int, first: float, spacing: float
) -> None:
    rng = np.random.default_rng(seed)
    points, road = first + spacing * np.arange(10.0), rng.normal(size=10)
    places = rng.uniform(points[0], points[-1], 30)
    found = between_points(places, first, spacing, 10)
    np.testing.assert_allclose(found @ road, np.interp(places, points, road), atol=1e-9)
    assert found.count_nonzero() <= 2 * places.size
    at_points = between_points(points, first, spacing, 10) @ road
    np.testing.assert_allclose(at_points, road, atol=1e-9)
