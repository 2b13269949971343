"""The reference's IRI of valid points against what can be counted by hand."""

import numpy as np
import pytest

from floatref_reference.beyond.iri_of_valid import stretches, valid_segment_iri
from floatref_reference.chapter_2.section_2_1_1_iri import iri

ROAD = np.cumsum(np.random.default_rng(3).normal(0.0, 2e-3, 60))


def test_a_stretch_needs_more_points_than_eleven_metres() -> None:
    valid = [True] * 12 + [False] + [True] * 11 + [False, True]
    assert stretches(valid, 1.0) == [(0, 12)]
    assert stretches([False] * 5, 1.0) == []
    assert stretches([True] * 30, 1.0) == [(0, 30)]


def test_two_stretches_are_two_profiles() -> None:
    valid = [True] * 20 + [False] * 10 + [True] * 30
    (whole,) = valid_segment_iri(ROAD, valid, 1.0, 1000.0)
    parts = 19 * iri(ROAD[:20], 1.0) + 29 * iri(ROAD[30:], 1.0)
    assert whole.iri is not None
    assert float(whole.iri) == pytest.approx(float(parts / 48))
    assert whole.share == pytest.approx(48 / 59)
    assert whole.invalid == 10.0


def test_a_segment_without_a_stretch_has_no_iri() -> None:
    valid = [False] * 30 + [True] * 30
    first, second = valid_segment_iri(ROAD, valid, 1.0, 30.0)
    assert first == (None, 0.0, 30.0)
    assert second.iri is not None
    nothing = valid_segment_iri(ROAD, [False] * 60, 1.0, 30.0)
    assert [part.invalid for part in nothing] == [30.0, 29.0]
