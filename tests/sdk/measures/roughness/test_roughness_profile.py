"""Where the roughness lies: averages of the rectified trace, and the stretches above a limit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import (
    in_per_mi,
    iri,
    iri_trace,
    localized_roughness,
    m_per_km,
    mean_roughness_index,
    short_interval_roughness,
)

FEW = settings(deadline=None, max_examples=15)
intervals = st.sampled_from([0.02, 0.05, 0.1, 0.25, 0.3, 1.0])
seeds = st.integers(0, 2**32 - 1)


def rough_road(seed: int, interval: float, length: float = 60.0) -> np.ndarray:
    count = int(length / interval) + 2
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 2e-3, count)) * np.sqrt(interval)


def bumpy_road(*places: float, interval: float = 0.05, length: float = 200.0) -> np.ndarray:
    """A smooth road with a 10-mm bump of 1 m behind each of ``places`` in m."""
    x = interval * np.arange(int(length / interval) + 1)
    z = 1e-4 * np.sin(x)
    for place in places:
        inside = (x > place) & (x < place + 1.0)
        z[inside] += 0.005 * (1 - np.cos(2 * np.pi * (x[inside] - place)))
    return z


@given(seed=seeds, interval=intervals, base=st.floats(0.5, 20.0))
@FEW
def test_each_value_is_the_mean_of_the_trace_around_it(
    seed: int, interval: float, base: float
) -> None:
    z = rough_road(seed, interval)
    rectified = np.abs(iri_trace(z, interval))
    window = max(round(base / interval), 1)
    found = short_interval_roughness(z, interval, base)
    assert found.shape == rectified.shape
    for k in (0, 1, rectified.size // 2, rectified.size - 1):
        first = k - window // 2
        expected = rectified[max(first, 0) : first + window].mean()
        assert found[k] == pytest.approx(expected, rel=1e-9)


@given(seed=seeds, interval=intervals)
@FEW
def test_base_beyond_the_profile_is_the_iri_everywhere(seed: int, interval: float) -> None:
    z = rough_road(seed, interval)
    found = short_interval_roughness(z, interval, 1000.0)
    np.testing.assert_allclose(found, iri(z, interval), rtol=1e-9)


def test_constant_roughness_gives_itself() -> None:
    # Ten wavelengths to the base, after the start has died away: a steady sinusoid.
    interval, wavelength = 0.00762, 0.762
    z = 1e-3 * np.sin(2 * np.pi * interval * np.arange(30_000) / wavelength)
    steady = short_interval_roughness(z, interval)[20_000:-600]
    assert np.ptp(steady) < 1e-3 * steady.mean()


def test_unmeasured_ends_have_no_roughness() -> None:
    z = rough_road(1, 0.1)
    padded = np.concatenate((np.full(30, np.nan), z))
    found = short_interval_roughness(padded, 0.1)
    assert np.isnan(found[:30]).all()
    np.testing.assert_allclose(found[30:], short_interval_roughness(z, 0.1), rtol=1e-9)


def test_bumps_are_listed_where_they_are() -> None:
    z = bumpy_road(60.0, 140.0)
    found = localized_roughness(z, 0.05, threshold_m_per_km=2.5, start_m=1000.0)
    assert len(found) == 2
    for place, stretch in zip((1060.0, 1140.0), found, strict=True):
        assert place - 4.0 < stretch.start_m < place + 1.0
        assert stretch.start_m < stretch.peak_at_m < stretch.end_m < place + 15.0
        assert stretch.peak_m_per_km > 2.5


@given(seed=seeds, threshold=st.floats(0.5, 4.0))
@FEW
def test_list_covers_what_exceeds_the_threshold_and_nothing_else(
    seed: int, threshold: float
) -> None:
    interval = 0.1
    z = rough_road(seed, interval)
    roughness = short_interval_roughness(z, interval)
    covered = np.zeros(roughness.size, dtype=bool)
    for stretch in localized_roughness(z, interval, threshold):
        inside = slice(round(stretch.start_m / interval), round(stretch.end_m / interval))
        covered[inside] = True
        assert stretch.peak_m_per_km == roughness[inside].max()
        at = int(stretch.peak_at_m / interval)
        assert roughness[at] == stretch.peak_m_per_km
    np.testing.assert_array_equal(covered, roughness > threshold)


def test_nothing_is_listed_above_the_peak() -> None:
    z = bumpy_road(60.0)
    peak = short_interval_roughness(z, 0.05).max()
    assert localized_roughness(z, 0.05, peak) == ()


@given(value=st.floats(0.0, 1e4))
def test_units_convert_back(value: float) -> None:
    assert m_per_km(in_per_mi(value)) == pytest.approx(value)


def test_a_mile_holds_63360_inches() -> None:
    assert in_per_mi(1000.0) == pytest.approx(63_360.0)


@given(left=st.floats(0.0, 50.0), right=st.floats(0.0, 50.0))
def test_mean_roughness_index_lies_midway(left: float, right: float) -> None:
    mean = mean_roughness_index(left, right)
    assert mean - left == pytest.approx(right - mean, abs=1e-9)


@pytest.mark.parametrize("base", [0.0, -7.62, float("nan")])
def test_impossible_base_is_refused(base: float) -> None:
    with pytest.raises(InputError, match="base length"):
        short_interval_roughness(np.zeros(1000), 0.05, base)


def test_a_base_longer_than_all_profiles_averages_all_of_it() -> None:
    z = np.cumsum(np.random.default_rng(3).normal(0.0, 4e-4, 1000))
    endless = short_interval_roughness(z, 0.05, 1e308)
    np.testing.assert_array_equal(endless, short_interval_roughness(z, 0.05, 1e6))
