"""Sections of 0.1 mile: limits of the regulation, shares, and marks of what is not valid."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import (
    IriSettings,
    hpms_sections,
    iri_segments,
    m_per_km,
    rate_iri,
    rated_shares,
)

INTERVAL = 0.25


def rough_road(seed: int, count: int = 1600) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 1.5e-3, count))


@pytest.mark.parametrize(
    ("in_per_mi", "rating"),
    [(0.0, "good"), (94.9, "good"), (95.1, "fair"), (169.9, "fair"), (170.1, "poor")],
)
def test_ratings_of_23_cfr_490_313(in_per_mi: float, rating: str) -> None:
    assert rate_iri(m_per_km(in_per_mi)) == rating


def test_nothing_measured_has_no_rating() -> None:
    assert rate_iri(float("nan")) is None


@given(seed=st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=10)
def test_a_section_is_the_mean_of_two_segments(seed: int) -> None:
    paths = [rough_road(seed), rough_road(seed + 1)]
    sections = hpms_sections(paths, INTERVAL, start_m=500.0)
    cut = IriSettings(segment_m=160.9344)
    left, right = (iri_segments(path, INTERVAL, cut, 500.0) for path in paths)
    for section, one, other in zip(sections, left, right, strict=True):
        assert (section.start_m, section.length_m) == (one.start_m, one.length_m)
        assert section.iri_m_per_km == (one.iri_m_per_km, other.iri_m_per_km)
        assert section.mean_m_per_km == (one.iri_m_per_km + other.iri_m_per_km) / 2.0
    assert sum(section.length_m for section in sections) == 1599 * INTERVAL


def test_one_path_is_its_own_mean() -> None:
    (first, *_) = hpms_sections([rough_road(1)], INTERVAL)
    assert first.iri_m_per_km == (first.mean_m_per_km,)


def test_shares_are_of_the_length() -> None:
    quiet = np.zeros(1600)
    quiet[1400:] += 0.02 * np.sin(2 * np.pi * INTERVAL * np.arange(200) / 5.0)
    sections = hpms_sections([quiet], INTERVAL)
    assert [section.rating for section in sections] == ["good", "good", "poor"]
    shares = rated_shares(sections)
    assert shares["poor"] == pytest.approx(sections[-1].length_m / (1599 * INTERVAL))
    assert sum(shares.values()) == pytest.approx(1.0)


def test_a_section_without_elevation_is_not_rated() -> None:
    z = rough_road(1)
    z[:700] = np.nan
    first, second, third = hpms_sections([z, rough_road(2)], INTERVAL)
    assert (first.rating, first.valid_share) == (None, 0.0)
    assert second.rating in ("good", "fair", "poor")
    assert second.valid_share == pytest.approx((1288 - 700) / 644, abs=2e-3)
    assert third.valid_share == 1.0
    assert np.isnan(list(rated_shares([first]).values())).all()


def test_an_invalid_point_of_either_path_is_marked() -> None:
    valid = [np.ones(1600, dtype=bool) for _ in range(2)]
    valid[0][10], valid[1][20] = False, False
    first, *rest = hpms_sections([rough_road(1), rough_road(2)], INTERVAL, valid)
    assert first.valid_share == pytest.approx(1.0 - 4 / 644)
    assert all(section.valid_share == 1.0 for section in rest)


@pytest.mark.parametrize("count", [0, 3])
def test_a_lane_has_one_or_two_paths(count: int) -> None:
    with pytest.raises(InputError, match=f"{count} wheel paths"):
        hpms_sections([rough_road(k) for k in range(count)], INTERVAL)


def test_paths_of_different_lengths_are_refused() -> None:
    with pytest.raises(InputError, match="differ in length"):
        hpms_sections([rough_road(1), rough_road(2, 1500)], INTERVAL)
