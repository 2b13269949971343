"""Segments: they cover the road once, are the reference's, and none is a tenth of the others."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.measures.roughness.roughness_index import segment_edges
from floatref_reference.chapter_2.section_2_1_2_iri_scale import segment_ends

COUNTS = st.integers(1, 5000)
INTERVALS = st.sampled_from([0.00508, 0.02, 0.05, 0.0762, 0.1, 0.25, 1.0])
PARTS = st.floats(1.0, 700.0)
"""Length of a segment in intervals."""


@given(COUNTS, INTERVALS, PARTS)
def test_segments_cover_every_interval_once(count: int, interval: float, part: float) -> None:
    edges = segment_edges(count, interval, part * interval)
    assert (edges[0], edges[-1]) == (0, count)
    assert (np.diff(edges) > 0).all()
    ends = segment_ends(count, interval, part * interval)
    assert [first for first, _ in ends] == edges[:-1].tolist()


@given(COUNTS, INTERVALS, PARTS)
def test_none_is_shorter_than_a_tenth_or_longer_than_eleven(
    count: int, interval: float, part: float
) -> None:
    sizes = np.diff(segment_edges(count, interval, part * interval))
    if sizes.size > 1:
        assert sizes.min() >= 0.1 * part * (1.0 - 1e-8)
        assert sizes.max() <= 1.1 * part + 1.0
        assert np.abs(sizes[:-1] - part).max(initial=0.0) <= 1.0


@pytest.mark.parametrize(("length_m", "count"), [(309.999, 3), (310.0, 4), (300.0, 3), (109.0, 1)])
def test_exactly_a_tenth_is_a_segment(length_m: float, count: int) -> None:
    interval = 0.001
    assert segment_edges(round(length_m / interval), interval, 100.0).size - 1 == count
