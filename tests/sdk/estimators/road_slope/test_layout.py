"""Each unknown has its place, and matrices of lines between points hold lines."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array

from floatref.estimators.road_slope.layout import (
    GLOBALS,
    IN_TIME,
    SHARES,
    Layout,
    between_points,
    triples,
)

SEEDS = st.integers(0, 2**32 - 1)
METRES = st.floats(-5.0, 5.0)
SPACINGS = st.floats(0.1, 2.0)


@given(points=st.integers(2, 9), nodes=st.integers(1, 9))
def test_each_unknown_has_a_place_of_its_own_in_the_order_of_the_page(
    points: int, nodes: int
) -> None:
    """z, s, r, θ, b, u, n, o, μ, κ, λ, H, ln K_f, ln K_r, ln C_f, ln C_r, ln γ."""
    layout = Layout(points, nodes)
    vector = np.arange(2 * points + 7 * nodes + 8)
    parts = [vector[layout.elevation], vector[layout.slope]]
    in_time = ("height", "pitch", "bias", "heave", "nod", "offset", "moment")
    parts += [vector[layout.in_time(name)] for name in in_time]
    springs = ("log_front", "log_rear", "log_front_damping", "log_rear_damping")
    scalars = ("gain", "lean", "centre", *springs, "log_gyration")
    parts += [vector[[layout.place(name)]] for name in scalars]
    assert [part.size for part in parts] == [points] * 2 + [nodes] * 7 + [1] * 8
    np.testing.assert_array_equal(np.concatenate(parts), vector)
    assert layout.size == vector.size
    assert (in_time, scalars) == (IN_TIME, GLOBALS)
    for name in ("height", "pitch", "bias"):
        assert getattr(layout, name) == layout.in_time(name)


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


@given(seed=SEEDS, bent=st.floats(-3.0, 3.0))
def test_shares_are_those_of_a_parabola_under_two_boxes(seed: int, bent: float) -> None:
    """Its mean there is its value in the middle and a twelfth of its second difference."""
    level, rise = np.random.default_rng(seed).normal(size=2)
    nodes = np.arange(-1.0, 2.0)
    means = level + rise * nodes + bent * (nodes**2 + 1 / 12)  # Over one box.
    (found,) = triples(np.array([1]), 3, SHARES) @ (level + rise * nodes + bent * nodes**2)
    np.testing.assert_allclose(found, means[1] + bent / 12, atol=1e-12)


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
