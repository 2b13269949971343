"""The vector by names and back, its start, and its ranges."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_reference.road_slope.rows import prior_rows
from floatref_reference.road_slope.symbols import Constants, Stretch
from floatref_reference.road_slope.unknowns import as_vector, by_name, kept_in_range, start
from floatref_reference.road_slope.wheels import road_points

C = Constants(interval=0.1, spacing=1.0)


@given(points=st.integers(2, 9), nodes=st.integers(1, 9))
def test_names_are_in_the_order_of_the_page(points: int, nodes: int) -> None:
    vector = np.arange(2.0 * points + 3 * nodes + 6)
    parts = by_name(vector, points, nodes)
    assert [np.size(part) for part in parts] == [points] * 2 + [nodes] * 3 + [1] * 6
    assert parts._fields[:5] == ("elevation", "slope", "height", "pitch", "bias")
    assert parts._fields[5:] == ("gain", "lean", "centre", "offset", "log_hz", "log_damping")
    assert np.array_equal(as_vector(parts), vector)


def test_it_starts_flat_and_at_rest_with_the_constants_as_known(
    stopping: Callable[..., Stretch],
) -> None:
    stretch = stopping(C)
    x = by_name(start(stretch), road_points(stretch).number, 40)
    assert not any(part.any() for part in x[:5])
    assert prior_rows(x, C) == pytest.approx(np.zeros(7), abs=1e-15)
    assert np.exp([x.log_hz, x.log_damping]) == pytest.approx([1.6, 0.3])


@given(st.lists(st.floats(-9, 9), min_size=6, max_size=6))
def test_four_constants_are_kept_in_their_ranges_and_nothing_else_is_changed(
    constants: list[float],
) -> None:
    vector = np.array([*np.full(7, 50.0), *constants])
    old, new = by_name(vector, 2, 1), kept_in_range(by_name(vector, 2, 1))
    assert 0.0005 <= new.gain <= 0.02
    assert -0.1 <= new.centre <= 1.1
    assert 0.7 - 1e-12 <= np.exp(new.log_hz) <= 3 + 1e-12
    assert 0.05 - 1e-12 <= np.exp(new.log_damping) <= 0.8 + 1e-12
    assert np.array_equal(as_vector(kept_in_range(new)), as_vector(new))
    changed = {n for n in old._fields if not np.array_equal(getattr(old, n), getattr(new, n))}
    assert changed <= {"gain", "centre", "log_hz", "log_damping"}


def test_constants_inside_their_ranges_stay() -> None:
    vector = np.array([*np.zeros(7), 0.01, 0.5, 0.9, 3.0, np.log(2.0), np.log(0.4)])
    assert np.array_equal(as_vector(kept_in_range(by_name(vector, 2, 1))), vector)
