"""Agreement of two signals: cross correlation over a range of offsets (2.1.5.1).

Mean and standard deviation are those of the overlap at each offset, so a shifted copy of a
signal scores 1 for any values beyond the overlap.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.measures.roughness.lagged_sums import LaggedSums, OneSignal, SignalPiece
from floatref.values.arrays import FloatArray


@dataclass(frozen=True)
class Agreement:
    """Agreement score, its two factors, and the offset in m at which they were found.

    ``cross_correlation`` is ``correlation`` · ``amplitude_factor`` (2.16); ``offset_m`` is above
    zero where the second signal lies farther along.
    """

    cross_correlation: float
    correlation: float
    amplitude_factor: float
    offset_m: float


SAME_CORRELATION = 1e-12
"""Correlations that differ by less are equal: they do by rounding."""


class _Overlap(NamedTuple):
    """Correlation (2.14) and amplitude factor (2.15) at every lag from −L to L."""

    correlation: FloatArray
    amplitude_factor: FloatArray


def cross_correlation(
    p: FloatArray, q: FloatArray, interval_m: float, max_offset_m: float = 1.0
) -> Agreement:
    """Return the agreement of ``q`` with ``p``, filtered signals on the same points.

    The offset is the one of highest correlation within ±``max_offset_m``, the nearest to zero
    of equals. A signal that is constant has no shape: its correlation is 0. Raises InputError
    for signals of unequal length, with NaN, or shorter than four times the largest offset.
    Source: (2.12) to (2.16), (2.14) with the factor 1/N that it needs.
    """
    p, q = np.asarray(p, dtype=np.float64), np.asarray(q, dtype=np.float64)
    if p.ndim != 1 or p.shape != q.shape:
        raise InputError(f"signals of shape {p.shape} and {q.shape}; cut them to the same points")
    whole = (SignalPiece(0, p, 0, q),)
    return correlate_pieces(lambda largest: whole, p.size, interval_m, max_offset_m)


def correlate_pieces(
    pieces: Callable[[int], Iterable[SignalPiece]],
    size: int,
    interval_m: float,
    max_offset_m: float = 1.0,
) -> Agreement:
    """Return the `cross_correlation` of two signals of ``size`` values that come in pieces.

    ``pieces`` gives them for a largest lag, as `LaggedSums` takes them. Raises InputError as
    `cross_correlation`.
    """
    if not 0.0 <= max_offset_m < math.inf:
        raise InputError(f"the largest offset is {max_offset_m} m; give 0 m or more")
    # A grid of 5.08 mm must reach 1.016 m as its 200th lag, whatever the rounding.
    largest = math.floor(min(max_offset_m, size * interval_m) / interval_m + 1e-9)
    if size < max(4 * largest, 2):
        raise InputError(
            f"{size * interval_m:g} m of signal are too short for offsets of up to "
            f"{max_offset_m:g} m; it takes four times as much"
        )
    overlap = _correlate(LaggedSums(pieces(largest), largest), largest)
    lags = np.arange(-largest, largest + 1)
    tied = np.flatnonzero(overlap.correlation >= overlap.correlation.max() - SAME_CORRELATION)
    best = tied[np.argmin(np.abs(lags[tied]))]
    rho, gamma = float(overlap.correlation[best]), float(overlap.amplitude_factor[best])
    return Agreement(rho * gamma, rho, gamma, float(lags[best]) * interval_m)


def _correlate(sums: LaggedSums, largest: int) -> _Overlap:
    """Return correlation and amplitude factor at lags −``largest`` to ``largest``."""
    counts = sums.p.count - np.abs(np.arange(-largest, largest + 1))
    p_sums, p_squares = (sums.p.over_overlaps(power) for power in (1, 2))
    # Seen from q the same overlaps come in the opposite order of lags.
    q_sums, q_squares = (sums.q.over_overlaps(power)[::-1] for power in (1, 2))
    p_sigma = _sigma(p_sums, p_squares, counts, sums.p)
    q_sigma = _sigma(q_sums, q_squares, counts, sums.q)
    covariance = (sums.products - p_sums * q_sums / counts) / counts
    shaped = (p_sigma > 0) & (q_sigma > 0)
    rho = np.divide(covariance, p_sigma * q_sigma, out=np.zeros(counts.size), where=shaped)
    low, high = np.minimum(p_sigma, q_sigma), np.maximum(p_sigma, q_sigma)
    gamma = np.divide(low, high, out=np.ones(counts.size), where=high > 0)
    return _Overlap(np.clip(rho, -1.0, 1.0), gamma)


def _sigma(
    sums: FloatArray, squares: FloatArray, counts: np.ndarray, signal: OneSignal
) -> FloatArray:
    """Return the standard deviation on each overlap, 0 where it is rounding of ``signal``."""
    variance = squares / counts - np.square(sums / counts)
    rounding = np.square(1e-13 * signal.peak)
    return np.asarray(np.sqrt(np.where(variance > rounding, variance, 0.0)))
