"""The IRI of valid points: that of the valid stretches, untouched by what is not valid."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import iri
from floatref.measures.valid_iri import profile_iri, valid_stretches
from floatref.values.display.iri_table import TrackIri
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.scanning import CHUNK

INTERVAL = 0.25
COUNT = 400
NEEDED = 44
"""Intervals in 11 m."""
SEEDS = st.integers(0, 2**32 - 1)
CUTS = st.lists(st.integers(0, COUNT), max_size=8)


def road(seed: int) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 1e-3, COUNT))


def marks(cuts: list[int]) -> np.ndarray:
    """Return validity that changes at every cut."""
    changes = np.bincount(np.array(cuts, dtype=np.int64), minlength=COUNT)[:COUNT]
    return np.cumsum(changes) % 2 == 0


def found(elevation: np.ndarray, valid: np.ndarray | None = None) -> TrackIri:
    track = ProfileTrack.of("left", elevation, valid)
    return profile_iri(Profile(INTERVAL, (track,)))["left"]


@given(SEEDS)
def test_where_all_is_valid_both_figures_are_the_iri(seed: int) -> None:
    result = found(road(seed))
    assert result.valid_m_per_km == result.all_m_per_km == iri(road(seed), INTERVAL)
    assert result.counted_share == 1.0


@pytest.mark.slow
@given(SEEDS, CUTS)
def test_elevations_that_are_not_valid_change_nothing(seed: int, cuts: list[int]) -> None:
    valid = marks(cuts)
    right = road(seed)
    wrong = np.where(valid, right, 1000.0 * road(seed + 1))
    missing = np.where(valid, right, np.nan)
    expected = found(right, valid)
    for changed in (wrong, missing):
        result = found(changed, valid)
        np.testing.assert_equal(result.valid_m_per_km, expected.valid_m_per_km)
        assert result.counted_share == expected.counted_share


@given(SEEDS, CUTS)
def test_it_is_the_mean_over_all_intervals_of_the_stretches(seed: int, cuts: list[int]) -> None:
    valid, z = marks(cuts), road(seed)
    lengths, sums = [0], [0.0]
    for stretch in valid_stretches(valid, INTERVAL):
        assert valid[stretch].all()
        lengths.append(stretch.stop - stretch.start - 1)
        sums.append(iri(z[stretch], INTERVAL) * lengths[-1])
    result = found(z, valid)
    assert result.counted_share == sum(lengths) / (COUNT - 1)
    if sum(lengths):
        assert result.valid_m_per_km == pytest.approx(sum(sums) / sum(lengths), rel=1e-12)
    else:
        assert np.isnan(result.valid_m_per_km)
    assert result.all_m_per_km == iri(z, INTERVAL)


@given(CUTS)
def test_every_stretch_that_is_long_enough_counts_whole(cuts: list[int]) -> None:
    valid = marks(cuts)
    counted = np.zeros(COUNT, dtype=bool)
    for stretch in valid_stretches(valid, INTERVAL):
        assert stretch.stop - stretch.start > NEEDED
        counted[stretch] = True
    rest = valid & ~counted
    runs = "".join("x" if mark else " " for mark in rest).split()
    assert all(len(run) <= NEEDED for run in runs)


@pytest.mark.parametrize("count", [1, 2, NEEDED])
def test_too_few_points_have_no_iri(count: int) -> None:
    for elevation in (np.zeros(count), np.full(count, np.nan)):
        result = found(elevation)
        assert np.isnan([result.valid_m_per_km, result.all_m_per_km]).all()
        assert result.counted_share == 0.0
    assert found(np.zeros(NEEDED + 1)).counted_share == 1.0


@pytest.mark.parametrize(
    ("interval_m", "height", "text"),
    [
        (2.5, 0.0, "track left: interval is 2.5 m; the IRI needs 2 m or less"),
        (0.25, 2e6, r"track left: elevation of point 0 is 2e\+06 m"),
    ],
)
def test_what_has_no_iri_at_all_is_refused(interval_m: float, height: float, text: str) -> None:
    track = ProfileTrack.of("left", np.full(COUNT, height))
    with pytest.raises(InputError, match=text):
        Profile(interval_m, (track,)).iri()


def test_a_long_profile_takes_no_memory_that_grows_with_it():
    valid = np.ones(6_000_000, np.bool_)
    valid[1000:2000] = False
    profile = Profile(0.005, (ProfileTrack.of("left", np.zeros(valid.size), valid),))
    profile_iri(profile)
    tracemalloc.start()
    profile_iri(profile)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # Two pieces of 2 MiB; one flag for each point would be 6 MB.
    assert peak < 2 * 8 * CHUNK
