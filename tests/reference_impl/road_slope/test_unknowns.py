"""The vector by names and back, its start, and its ranges."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.priors import prior_rows
from floatref_reference.road_slope.symbols import Stretch
from floatref_reference.road_slope.unknowns import (
    as_vector,
    by_name,
    how_many,
    kept_in_range,
    start,
)
from floatref_reference.road_slope.wheels import road_points

C = Constants(interval_s=0.1, spacing_m=1.0)
FIXED = (
    *("gain", "lean", "centre", "log_front", "log_rear"),
    *("log_front_damping", "log_rear_damping", "log_gyration"),
)


@given(points=st.integers(2, 9), nodes=st.integers(1, 9))
def test_names_are_in_the_order_of_the_page(points: int, nodes: int) -> None:
    vector = np.arange(2.0 * points + 7 * nodes + 8)
    assert how_many(points, nodes) == len(vector)
    parts = by_name(vector, points, nodes)
    assert [np.size(part) for part in parts] == [points] * 2 + [nodes] * 7 + [1] * 8
    assert parts._fields[:5] == ("elevation", "slope", "height", "pitch", "bias")
    assert parts._fields[5:9] == ("heave", "nod", "offset", "moment")
    assert parts._fields[9:] == FIXED
    assert np.array_equal(as_vector(parts), vector)


def test_it_starts_flat_and_at_rest_with_the_constants_as_known(
    stopping: Callable[..., Stretch],
) -> None:
    stretch = stopping(C)
    x = by_name(start(stretch), road_points(stretch).number, 30)
    assert not any(part.any() for part in x[:9])
    assert prior_rows(x, C) == pytest.approx(np.zeros(9), abs=1e-15)
    assert (x.gain, x.lean, x.centre) == (0.005, 0, 0.5)
    assert x.log_gyration == pytest.approx(np.log(0.9))


@given(st.lists(st.floats(-9, 9), min_size=8, max_size=8))
def test_seven_constants_are_kept_in_their_ranges_and_nothing_else_is_changed(
    constants: list[float],
) -> None:
    vector = np.array([*np.full(11, 50.0), *constants])
    old, new = by_name(vector, 2, 1), kept_in_range(by_name(vector, 2, 1))
    assert 0.0005 <= new.gain <= 0.02
    assert -0.1 <= new.centre <= 1.1
    for stiffness in np.exp([new.log_front, new.log_rear]):
        assert 6 * (1 - 1e-12) <= stiffness <= 200 * (1 + 1e-12)
    for damping in np.exp([new.log_front_damping, new.log_rear_damping]):
        assert 0.1 * (1 - 1e-12) <= damping <= 20 * (1 + 1e-12)
    assert 0.4 - 1e-12 <= np.exp(new.log_gyration) <= 1.6 + 1e-12
    assert np.array_equal(as_vector(kept_in_range(new)), as_vector(new))
    changed = {n for n in old._fields if not np.array_equal(getattr(old, n), getattr(new, n))}
    assert changed <= {*FIXED} - {"lean"}


def test_constants_inside_their_ranges_stay() -> None:
    inside = [0.01, 0.5, 0.9, *np.log([7.0, 190.0, 0.2, 19.0, 1.5])]
    vector = np.array([*np.zeros(11), *inside])
    assert np.array_equal(as_vector(kept_in_range(by_name(vector, 2, 1))), vector)
