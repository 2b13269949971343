"""Cross correlation: shifted copies, amplitudes, bounds, and the literal sums."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import cross_correlation

FEW = settings(deadline=None, max_examples=25)
seeds = st.integers(0, 2**32 - 1)


def noise(seed: int, count: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(0.3, 1.0, count)


@pytest.mark.cites("(2.13) to (2.15)")
@given(seed=seeds, other=seeds, count=st.integers(50, 400), lags=st.integers(0, 12))
@FEW
def test_is_the_best_of_the_correlations_of_the_overlaps(
    seed: int, other: int, count: int, lags: int
) -> None:
    p, q = noise(seed, count), noise(other, count)
    rho = {}
    for i in range(-lags, lags + 1):
        first, second = p[max(-i, 0) : count - max(i, 0)], q[max(i, 0) : count + min(i, 0)]
        rho[i] = float(np.corrcoef(first, second)[0, 1])
    best = max(rho, key=rho.__getitem__)
    first, second = p[max(-best, 0) : count - max(best, 0)], q[max(best, 0) : count + min(best, 0)]
    found = cross_correlation(p, q, 0.5, 0.5 * lags)
    assert found.correlation == pytest.approx(rho[best], abs=1e-10)
    assert found.offset_m == pytest.approx(0.5 * best)
    sigmas = sorted((first.std(), second.std()))
    assert found.amplitude_factor == pytest.approx(sigmas[0] / sigmas[1], rel=1e-9)
    assert found.cross_correlation == found.correlation * found.amplitude_factor


@pytest.mark.parametrize("level", [0.0, 0.1, -583.0])
def test_constant_signal_agrees_with_nothing(level: float) -> None:
    flat, rough = np.full(300, level), noise(1, 300)
    for pair in ((flat, rough), (rough, flat), (flat, flat)):
        found = cross_correlation(*pair, 0.1)
        assert found.cross_correlation == 0.0
        assert found.offset_m == 0.0


def test_largest_offset_is_within_reach_despite_rounding() -> None:
    longer = noise(9, 1600)
    found = cross_correlation(longer[200:1400], longer[:1200], 0.00508, max_offset_m=1.016)
    assert found.offset_m == pytest.approx(1.016)
    assert found.cross_correlation == pytest.approx(1.0)


def test_periodic_signal_takes_the_offset_nearest_to_zero() -> None:
    p = np.tile([0.0, 1.0, 0.0, -1.0], 50)
    assert cross_correlation(p, p, 0.1).offset_m == 0.0


@pytest.mark.parametrize(
    ("p", "q", "max_offset", "text"),
    [
        (np.zeros(100), np.zeros(99), 1.0, "same points"),
        (np.zeros((10, 10)), np.zeros((10, 10)), 1.0, "same points"),
        (np.full(100, np.nan), np.zeros(100), 1.0, "NaN"),
        (np.zeros(100), np.zeros(100), 2.6, "too short for offsets of up to 2.6 m"),
        (np.zeros(1), np.zeros(1), 0.0, "too short"),
        (np.zeros(100), np.zeros(100), -1.0, "give 0 m or more"),
        (np.zeros(100), np.zeros(100), float("nan"), "give 0 m or more"),
        (np.zeros(100), np.zeros(100), float("inf"), "give 0 m or more"),
    ],
)
def test_unusable_signals_are_refused(
    p: np.ndarray, q: np.ndarray, max_offset: float, text: str
) -> None:
    with pytest.raises(InputError, match=text):
        cross_correlation(p, q, 0.1, max_offset)


def test_an_offset_beyond_all_signals_is_refused() -> None:
    with pytest.raises(InputError, match=r"too short for offsets of up to 1e\+308 m"):
        cross_correlation(noise(1, 100), noise(2, 100), 0.05, 1e308)
