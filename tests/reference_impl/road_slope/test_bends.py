"""One intensity for each 10 m, between that of a plain road and 4000 times it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_reference.road_slope.bends import first_intensity, intensity_by_slopes, segment_of
from floatref_reference.road_slope.constants import Constants

SPACING = st.sampled_from([0.25, 0.5, 1.0, 2.5])


@given(spacing=SPACING, N=st.integers(2, 120), seed=st.integers(0, 999), size=st.floats(-6, 1))
def test_bounds(spacing: float, N: int, seed: int, size: float) -> None:
    c = Constants(spacing_m=spacing)
    slope = 10**size * np.random.default_rng(seed).normal(size=N)
    g = intensity_by_slopes(slope, c)
    assert g.shape == first_intensity(N, c).shape == (N - 1,)
    assert g.min() >= 2e-7
    assert g.max() <= 4000 * 2e-7


def test_a_road_without_bends_is_plain() -> None:
    assert np.all(intensity_by_slopes(np.full(30, 0.02), Constants(spacing_m=1.0)) == 2e-7)


@given(spacing=SPACING, at=st.integers(0, 98), bend=st.floats(1e-3, 1e-2))
def test_a_bend_raises_its_own_ten_metres_alone(spacing: float, at: int, bend: float) -> None:
    """By half of what it is over a metre, and half of the plain road's."""
    c = Constants(spacing_m=spacing)
    slope = np.where(np.arange(100) > at, bend, 0.0)
    g, place = intensity_by_slopes(slope, c), spacing * np.arange(99)
    here = place // 10 == at * spacing // 10
    expected = np.clip((2e-7 + bend**2 / spacing) / 2, 2e-7, 8e-4)
    assert g == pytest.approx(np.where(here, expected, 2e-7), rel=1e-9)


def test_the_prior_weighs_as_many_degrees_of_freedom_as_it_says() -> None:
    c = Constants(spacing_m=1.0, bend_weight=3.0)
    slope = np.array([0.0, 0.01, 0.03])
    expected = (3 * 2e-7 + 0.01**2 + 0.02**2) / 4
    assert intensity_by_slopes(slope, c) == pytest.approx(np.full(2, expected))


def test_segments_have_whole_points() -> None:
    assert [segment_of(j, Constants(spacing_m=0.25)) for j in (0, 39, 40, 80)] == [0, 0, 1, 2]
    assert [segment_of(j, Constants(spacing_m=3.0)) for j in (0, 2, 3, 6)] == [0, 0, 1, 2]


def test_it_starts_as_thirty_plain_roads() -> None:
    assert np.all(first_intensity(5, Constants()) == 30 * 2e-7)
