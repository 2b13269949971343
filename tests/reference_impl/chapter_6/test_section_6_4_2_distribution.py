"""Autocorrelation and tests for normality on signals whose figures are known in closed form."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_4_2_distribution import (
    autocorrelation,
    excess_kurtosis,
    kolmogorov_smirnov,
    normal_probability,
    significance,
    skew,
)

QUANTILES = (np.arange(2000) + 0.5) / 2000


def normal(n: int) -> np.ndarray:
    """Return ``n`` equally likely values of a normal distribution, found by bisection."""
    wanted = (np.arange(n) + 0.5) / n
    low, high = np.full(n, -6.0), np.full(n, 6.0)
    for _ in range(50):
        middle = (low + high) / 2
        below = np.array([normal_probability(u) for u in middle]) < wanted
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return low


@settings(max_examples=10)
@given(a=st.floats(-0.9, 0.9), seed=st.integers(0, 99))
def test_a_first_order_process_decays_by_its_constant(a: float, seed: int) -> None:
    """As one noise source of figure 6.5 would, with a time constant of its own."""
    e, x = np.random.default_rng(seed).normal(size=8000), np.zeros(8000)
    for k in range(1, 8000):
        x[k] = a * x[k - 1] + e[k]
    r = autocorrelation(x, 4).astype(float)
    assert r[0] == pytest.approx(1.0)
    assert r[1:] == pytest.approx(a ** np.arange(1, 5), abs=0.1)


def test_a_sine_has_a_cosine_that_ends_with_the_samples() -> None:
    """Over whole periods: cos(ω l), less the share of the samples that the lag leaves out."""
    x = np.sin(2 * np.pi * np.arange(4000) / 40)
    r = autocorrelation(x, 400).astype(float)[::40]
    assert r == pytest.approx(1 - np.arange(0, 401, 40) / 4000, abs=1e-9)


def test_known_distributions_have_their_skew_and_kurtosis() -> None:
    exponential = -np.log(1 - (np.arange(40000) + 0.5) / 40000)
    assert float(skew(exponential)) == pytest.approx(2, abs=0.02)
    assert float(excess_kurtosis(exponential)) == pytest.approx(6, abs=0.3)
    assert float(skew(QUANTILES)) == pytest.approx(0, abs=1e-12)
    assert float(excess_kurtosis(QUANTILES)) == pytest.approx(-1.2, abs=1e-5)


def test_a_uniform_distribution_is_5_7_per_cent_from_normal() -> None:
    """Where both densities cross first: 1/(2√3) = φ(u), at u = -0.8067."""
    u = -math.sqrt(-2 * math.log(math.sqrt(2 * math.pi) / (2 * math.sqrt(3))))
    expected = abs(normal_probability(u) - (0.5 + u / (2 * math.sqrt(3))))
    assert kolmogorov_smirnov(QUANTILES) == pytest.approx(expected, abs=5e-4)


def test_a_distribution_and_its_mirror_image_have_one_score() -> None:
    exponential = -np.log(1 - QUANTILES)
    score = kolmogorov_smirnov(exponential)
    assert score == pytest.approx(normal_probability(-1.0), abs=0.005)
    assert kolmogorov_smirnov(-exponential) == pytest.approx(score, abs=1e-9)


@pytest.mark.parametrize("step", [0.05, 0.2, 0.5])
def test_normal_noise_in_steps_is_half_a_step_of_probability_from_normal(step: float) -> None:
    """Print's 0.00504 would be steps of 1/40 of a standard deviation, 0.00019 deg/s."""
    score = kolmogorov_smirnov(np.round(normal(4000) / step) * step)
    assert score == pytest.approx(step / 2 / math.sqrt(2 * math.pi), rel=0.08)


def test_the_scores_of_print_are_not_normal_with_confidence() -> None:
    """0.00504 of more than 6,400,000 samples; of 20,000 it would be any normal noise."""
    assert significance(0.00504, 6_400_000) < 1e-100
    assert significance(0.00504, 20_000) > 0.6


def test_significance_is_that_of_the_table_of_kolmogorov() -> None:
    """1.358 and 1.628 over √N are its 5 % and 1 %."""
    for level, c in [(0.05, 1.3581), (0.01, 1.6276), (0.5, 0.8276)]:
        assert significance(c / 100, 10_000) == pytest.approx(level, rel=1e-3)
    assert significance(0.0, 100) == 1.0


def test_a_signal_without_variation_or_length_is_refused() -> None:
    with pytest.raises(ValueError, match="constant signal"):
        skew(np.ones(5))
    with pytest.raises(ValueError, match="do not fit"):
        autocorrelation([1.0, 2.0], 2)
