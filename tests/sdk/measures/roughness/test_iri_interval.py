"""The interval of an IRI: the reference's, a closed form of its size, and the truth within it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import GOLDEN_CAR, iri, iri_trace
from floatref.measures.roughness.iri_interval import (
    CORRELATION_M,
    LONGEST_WAVE_M,
    UNKNOWN,
    iri_interval,
    output_covariance,
)
from floatref_reference.beyond import iri_interval as reference

SEEDS = st.integers(0, 2**32 - 1)
KMH_80 = 80.0 / 3.6


def road(seed: int, count: int, interval_m: float) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return np.cumsum(rng.normal(0.0, 2e-3 * np.sqrt(interval_m), count))


def drawn_errors(rng: np.random.Generator, count: int, interval_m: float) -> np.ndarray:
    """Return errors of 1-σ 1 m and the correlation that is assumed, by their spectrum."""
    size = 4 * count
    waves = np.fft.rfftfreq(size, interval_m) * 2.0 * np.pi * CORRELATION_M
    white = np.fft.rfft(rng.normal(size=size))
    smooth = np.fft.irfft(white / (1.0 + np.square(waves)), size)
    return (smooth / np.sqrt(np.mean(1.0 / (1.0 + np.square(waves)) ** 2)))[:count]


@pytest.mark.parametrize("interval_m", [0.5, 1.0, 2.0])
def test_covariance_is_the_references(interval_m: float) -> None:
    expected = reference.output_covariance(interval_m, 12).astype(float)
    found = output_covariance(interval_m)[:12]
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * expected[0])


@settings(deadline=None, max_examples=6)
@given(seed=SEEDS, size=st.floats(1e-4, 0.05))
def test_interval_is_the_references(seed: int, size: float) -> None:
    z = road(seed, 30, 1.0)
    sigma = size * (1.0 + np.random.default_rng(seed + 1).random(z.size - 1))
    y = iri_trace(z, 1.0)
    expected = reference.iri_interval(y, sigma, reference.output_covariance(1.0, y.size))
    found = iri_interval(y, sigma, 1.0)
    np.testing.assert_allclose(found, np.array(expected, dtype=float), rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize("correlation_m", [CORRELATION_M, 14.6])
def test_size_of_the_error_is_the_integral_over_its_spectrum(correlation_m: float) -> None:
    # One-sided spectrum of (1 + d/L) exp(−d/L) over n in cycles/m: 8 L / (1 + (2πnL)²)².
    n = np.linspace(1e-4, 12.0, 400_000)
    spectrum = 8.0 * correlation_m / np.square(1.0 + np.square(2.0 * np.pi * n * correlation_m))
    stroke = np.abs(GOLDEN_CAR.stroke_response(2.0 * np.pi * n * KMH_80)) * np.sinc(0.25 * n)
    slope = np.square(2.0 * np.pi * n) * spectrum
    expected = 1000.0 * np.sqrt(np.trapezoid(slope * np.square(stroke), n))
    found = np.sqrt(output_covariance(0.025, correlation_m=correlation_m)[0])
    assert found == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("sigma_m", [1e-3, 5e-3, 10e-3])
def test_the_truth_lies_within_it_if_errors_are_as_assumed(sigma_m: float) -> None:
    interval_m, count, within = 0.25, 801, 0
    rng = np.random.default_rng(7)
    for seed in range(200):
        z = road(seed, count, interval_m)
        measured = z + sigma_m * drawn_errors(rng, count, interval_m)
        spread = np.full(count - 1, sigma_m)
        low, high = iri_interval(iri_trace(measured, interval_m), spread, interval_m)
        within += low <= iri(z, interval_m) <= high
    assert within >= 184


def test_longer_waves_of_error_are_felt_less() -> None:
    sizes = [output_covariance(0.25, correlation_m=length)[0] for length in (2.0, 5.0, 15.0, 50.0)]
    assert sizes == sorted(sizes, reverse=True)
    assert pytest.approx(30.0) == LONGEST_WAVE_M == 2.0 * np.pi * CORRELATION_M


@given(seed=SEEDS, size=st.floats(1e-5, 1.0))
def test_it_holds_the_value_and_grows_with_sigma(seed: int, size: float) -> None:
    y = iri_trace(road(seed, 400, 0.25), 0.25)
    value = float(np.abs(y).mean())
    sigma = np.full(y.size, size)
    low, high = iri_interval(y, sigma, 0.25)
    wide_low, wide_high = iri_interval(y, 2.0 * sigma, 0.25)
    assert 0.0 <= wide_low <= low <= value <= high <= wide_high
    exact = iri_interval(y, 0.0 * sigma, 0.25)
    assert tuple(exact) == pytest.approx((value, value))


@given(seed=SEEDS, first=st.integers(0, 399), end=st.integers(0, 399))
def test_only_what_counts_matters(seed: int, first: int, end: int) -> None:
    y = iri_trace(road(seed, 400, 0.25), 0.25)
    y[first:end] = np.nan
    sigma = np.where(np.isfinite(y), 2e-3, np.nan)
    low, high = iri_interval(y, sigma, 0.25)
    assert np.isfinite([low, high]).all() == np.isfinite(y).any()
    if np.isfinite(y).any():
        sigma[np.flatnonzero(np.isfinite(y))[0]] = np.nan
        np.testing.assert_equal(iri_interval(y, sigma, 0.25), UNKNOWN)


def test_a_level_road_has_no_interval_below_zero() -> None:
    level = np.zeros(100)
    assert tuple(iri_interval(level, np.full(100, 1e-3), 0.25)) == (0.0, 0.0)
