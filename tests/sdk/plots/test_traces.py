"""Thinning keeps what a drawing can show; units stay readable; nothing invalid goes unseen."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure

from floatref.plots.figure import in_readable_unit, shade, thin

FEW = settings(deadline=None, max_examples=25)


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 4000), bins=st.integers(2, 300))
@FEW
def test_thinned_line_keeps_every_extreme_where_it_is(seed: int, count: int, bins: int) -> None:
    y = np.random.default_rng(seed).normal(size=count)
    x = np.arange(count, dtype=float)
    places, values = thin(x, y, bins)
    assert values.size <= max(count, 2 * bins)
    assert (values.min(), values.max()) == (y.min(), y.max())
    assert np.all(np.diff(places) >= 0)
    width = count / bins + 1
    for extreme in (y.argmin(), y.argmax()):
        assert np.min(np.abs(places[values == y[extreme]] - x[extreme])) <= width


def test_short_line_is_not_touched() -> None:
    x, y = np.arange(10.0), np.arange(10.0) ** 2
    np.testing.assert_array_equal(thin(x, y), (x, y))


def test_stretch_without_values_stays_a_gap() -> None:
    y = np.ones(10_000)
    y[4000:6000] = np.nan
    _, values = thin(np.arange(10_000.0), y, 100)
    assert np.isnan(values[82:118]).all()
    assert np.isfinite(values[:78]).all()


@pytest.mark.parametrize("count", [50, 50_000])
def test_one_invalid_point_is_shaded_and_a_valid_profile_is_not(count: int) -> None:
    ax = Figure().subplots()
    invalid = np.zeros(count, dtype=bool)
    shade(ax, np.arange(count, dtype=float), invalid)
    assert not ax.collections
    invalid[count // 2] = True
    shade(ax, np.arange(count, dtype=float), invalid)
    corners = np.concatenate([path.vertices[:, 0] for path in ax.collections[0].get_paths()])
    assert np.abs(corners - count // 2).max() <= count / 1000 + 1


def test_small_elevations_are_drawn_in_mm() -> None:
    assert in_readable_unit(np.array([0.01, -0.02, np.nan])) == (1000.0, "mm")
    assert in_readable_unit(np.array([0.0, 0.01]), np.array([580.0, 583.0])) == (1.0, "m")
    assert in_readable_unit(np.full(3, np.nan)) == (1000.0, "mm")
