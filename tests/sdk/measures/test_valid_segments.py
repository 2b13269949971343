"""The IRI of valid points by segment: the reference's, and one road with the whole's."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import IriSettings, iri_segments
from floatref.measures.valid_iri import iri_of_common_points, profile_iri
from floatref.measures.valid_segments import SegmentIri, segment_iris
from floatref.values.profile import Profile, ProfileTrack
from floatref_reference.beyond.iri_of_valid import valid_segment_iri

INTERVAL = 0.25
COUNT = 400
SEEDS = st.integers(0, 2**32 - 1)
CUTS = st.lists(st.integers(0, COUNT), max_size=8)
LENGTHS = st.floats(0.5, 120.0)


def road(seed: int) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 1e-3, COUNT))


def marks(cuts: list[int]) -> np.ndarray:
    """Return validity that changes at every cut."""
    changes = np.bincount(np.array(cuts, dtype=np.int64), minlength=COUNT)[:COUNT]
    return np.cumsum(changes) % 2 == 0


def found(track: ProfileTrack, segment_m: float) -> tuple[SegmentIri, ...]:
    return segment_iris(track, INTERVAL, IriSettings(segment_m=segment_m), start_m=50.0)


@settings(deadline=None, max_examples=12)
@given(SEEDS, CUTS, LENGTHS)
def test_they_are_those_of_the_reference(seed: int, cuts: list[int], length: float) -> None:
    valid, z = marks(cuts), road(seed)
    expected = valid_segment_iri(z, valid.tolist(), INTERVAL, length)
    result = found(ProfileTrack.of("left", z, valid), length)
    assert len(result) == len(expected)
    for mine, theirs in zip(result, expected, strict=True):
        value = np.nan if theirs.iri is None else float(theirs.iri)
        assert mine.valid_m_per_km == pytest.approx(value, rel=1e-9, nan_ok=True)
        assert mine.counted_share == pytest.approx(theirs.share, abs=1e-12)
        assert mine.invalid_m == pytest.approx(theirs.invalid, abs=1e-12)


@pytest.mark.slow
@given(SEEDS, CUTS, LENGTHS)
def test_segments_weighted_by_what_counts_are_the_whole(
    seed: int, cuts: list[int], length: float
) -> None:
    track = ProfileTrack.of("left", road(seed), marks(cuts))
    whole = profile_iri(Profile(INTERVAL, (track,)))["left"]
    result = found(track, length)
    counted = [s.counted_share * s.length_m for s in result]
    length_m = INTERVAL * (COUNT - 1)
    assert sum(counted) == pytest.approx(whole.counted_share * length_m, abs=1e-9)
    if sum(counted):
        total = sum(c * s.valid_m_per_km for c, s in zip(counted, result, strict=True) if c)
        assert total / sum(counted) == pytest.approx(whole.valid_m_per_km, rel=1e-9)
    else:
        assert np.isnan([s.valid_m_per_km for s in result]).all()


@given(SEEDS, CUTS, LENGTHS)
def test_no_more_is_invalid_than_there_is(seed: int, cuts: list[int], length: float) -> None:
    valid = marks(cuts)
    result = found(ProfileTrack.of("left", road(seed), valid), length)
    for segment in result:
        assert 0.0 <= segment.invalid_m <= segment.length_m
        assert segment.counted_share <= 1.0
        assert np.isnan(segment.valid_m_per_km) == (segment.counted_share == 0.0)
    lost = INTERVAL * np.count_nonzero(~valid)
    # The last point is one more than the intervals of the last segment.
    assert lost - INTERVAL <= sum(s.invalid_m for s in result) + 1e-9 <= lost + 2e-9
    if not valid.all():
        assert any(s.marked for s in result)


@pytest.mark.slow
@given(SEEDS, CUTS, LENGTHS)
def test_elevations_that_are_not_valid_change_nothing(
    seed: int, cuts: list[int], length: float
) -> None:
    valid, right = marks(cuts), road(seed)
    sigma = np.full(COUNT, 1e-3)
    wrong = np.where(valid, right, 50.0 + 1000.0 * road(seed + 1))
    bad_sigma = np.where(valid, sigma, 9.0)
    one = found(ProfileTrack.of("left", right, valid, sigma), length)
    other = found(ProfileTrack.of("left", wrong, valid, bad_sigma), length)
    for mine, theirs in zip(one, other, strict=True):
        np.testing.assert_equal(mine.valid_m_per_km, theirs.valid_m_per_km)
        np.testing.assert_equal(mine.interval, theirs.interval)
        assert mine.counted_share == theirs.counted_share


@given(SEEDS, LENGTHS)
def test_where_all_is_valid_both_figures_are_one(seed: int, length: float) -> None:
    track = ProfileTrack.of("left", road(seed))
    cut = IriSettings(segment_m=length)
    every = iri_segments(track.elevation, INTERVAL, cut, 50.0)
    for mine, theirs in zip(found(track, length), every, strict=True):
        assert mine.valid_m_per_km == mine.all_m_per_km == theirs.iri_m_per_km
        assert (mine.start_m, mine.length_m) == (theirs.start_m, theirs.length_m)
        assert not mine.marked


@pytest.mark.slow
@given(SEEDS, CUTS, CUTS)
def test_two_profiles_are_compared_where_both_are_valid(
    seed: int, one: list[int], other: list[int]
) -> None:
    first, second = marks(one), marks(other)
    common = iri_of_common_points(
        ProfileTrack.of("left", road(seed), first),
        ProfileTrack.of("left", 2.0 * road(seed), second),
        INTERVAL,
    )
    alone = ProfileTrack.of("left", road(seed), first & second)
    expected = profile_iri(Profile(INTERVAL, (alone,)))["left"]
    np.testing.assert_equal(common.reference_m_per_km, expected.valid_m_per_km)
    assert common.profile_m_per_km == pytest.approx(2.0 * expected.valid_m_per_km, nan_ok=True)
    assert common.counted_share == expected.counted_share
