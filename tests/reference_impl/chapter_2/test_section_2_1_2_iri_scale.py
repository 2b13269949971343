"""Segments share one pass of the car; units and ratings."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2.section_2_1_1_iri import iri
from floatref_reference.chapter_2.section_2_1_2_iri_scale import (
    inches_per_mile,
    pre_tpm_rating,
    segment_iri,
    tpm_rating,
)


@settings(deadline=None, max_examples=15)
@given(length=st.floats(0.05, 40.0), seed=st.integers(0, 99))
def test_segments_average_to_the_whole(length: float, seed: int) -> None:
    z = np.random.default_rng(seed).normal(size=300).cumsum() * 1e-3
    segments = segment_iri(z, 0.1, length)
    covered = sum(part for _, part, _ in segments)
    assert covered == pytest.approx(29.9)
    assert sum(part * value for _, part, value in segments) / covered == pytest.approx(
        float(iri(z, 0.1)), rel=1e-12
    )
    starts = [start for start, _, _ in segments]
    assert starts == pytest.approx(list(np.cumsum([0.0, *_lengths(segments)])[:-1]))


def _lengths(segments: list[tuple[float, float, np.longdouble]]) -> list[float]:
    return [length for _, length, _ in segments]


def test_one_metre_per_kilometre_is_63_36_inches_per_mile() -> None:
    assert inches_per_mile(1.0) == pytest.approx(63.36)
    assert inches_per_mile(2.68) == pytest.approx(170, abs=0.5)


@pytest.mark.parametrize(
    ("value", "rating"), [(0.9, "good"), (1.5, "fair"), (2.68, "fair"), (2.7, "poor")]
)
def test_table_2_1_rates_a_section(value: float, rating: str) -> None:
    assert tpm_rating(value) == rating


@pytest.mark.cites("Table 2.1")
@pytest.mark.parametrize(
    ("value", "interstate", "other"),
    [
        (0.94, "very good", "very good"),
        (0.95, "good", "good"),
        (1.49, "good", "good"),
        (1.5, "fair", "fair"),
        (1.9, "mediocre", "fair"),
        (2.68, "mediocre", "mediocre"),
        (2.7, "poor", "mediocre"),
        (3.47, "poor", "mediocre"),
        (3.48, "poor", "poor"),
    ],
)
def test_table_2_1_rated_a_section_before(value: float, interstate: str, other: str) -> None:
    assert pre_tpm_rating(value, interstate=True) == interstate
    assert pre_tpm_rating(value, interstate=False) == other


@pytest.mark.cites("Table 2.1")
@given(value=st.floats(0.0, 10.0))
def test_poor_is_poor_on_an_interstate_highway_in_both_eras(value: float) -> None:
    assert (tpm_rating(value) == "poor") == (pre_tpm_rating(value, interstate=True) == "poor")
