"""The roughness that rests on valid points, and that pieces of a long profile change nothing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import short_interval_roughness
from floatref.measures.roughness import iri_interval as intervals
from floatref.measures.roughness import roughness_profile
from floatref.measures.valid_roughness import roughness_of
from floatref.values.profile import ProfileTrack

INTERVAL = 0.25
COUNT = 400


def road(seed: int = 0) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 5e-4, COUNT))


@given(st.integers(0, COUNT - 1), st.integers(0, COUNT))
@settings(max_examples=20)
def test_valid_stretches_are_measured_as_profiles_of_their_own(first: int, end: int) -> None:
    valid = (np.arange(COUNT) < first) | (np.arange(COUNT) >= end)
    z = road() + 5.0 * ~valid
    trace, counted = roughness_of(ProfileTrack.of("left", z, valid), INTERVAL)
    assert not counted[~(valid[1:] & valid[:-1])].any()
    for stretch in (slice(0, first), slice(max(first, end), COUNT)):
        if stretch.stop - stretch.start > 44 and valid[stretch].all() and end > first:
            inside = slice(stretch.start, stretch.stop - 1)
            expected = short_interval_roughness(z[stretch], INTERVAL)
            np.testing.assert_array_equal(trace[inside], expected)
            assert counted[inside].all()


@pytest.mark.parametrize("count", [1, 2, 20])
def test_a_profile_too_short_for_the_car_has_no_roughness(count: int) -> None:
    trace, counted = roughness_of(ProfileTrack.of("left", np.zeros(count)), INTERVAL)
    assert trace.shape == counted.shape == (count - 1,)
    assert np.isnan(trace).all()
    assert not counted.any()


@pytest.mark.parametrize("piece", [61, 399])
def test_pieces_change_nothing(monkeypatch: pytest.MonkeyPatch, piece: int) -> None:
    z = road()
    z[:30] = z[390:] = np.nan
    sigma = np.linspace(1e-3, 3e-3, COUNT - 1)
    trace = np.where(np.arange(COUNT - 1) % 50 < 45, road(1)[1:] * 100.0, np.nan)
    expected = short_interval_roughness(z, INTERVAL), intervals.iri_interval(trace, sigma, INTERVAL)
    monkeypatch.setattr(roughness_profile, "CHUNK", piece)
    monkeypatch.setattr(intervals, "CHUNK", piece)
    found = short_interval_roughness(z, INTERVAL), intervals.iri_interval(trace, sigma, INTERVAL)
    np.testing.assert_allclose(found[0], expected[0], rtol=1e-12)
    np.testing.assert_allclose(found[1], expected[1], rtol=1e-9)
