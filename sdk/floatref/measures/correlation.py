"""Agreement of two signals: cross correlation over a range of offsets (2.1.5.1).

Mean and standard deviation are those of the overlap at each offset, so a shifted copy of a
signal scores 1 whatever lies beyond the overlap.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
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
    p, q = _checked(p, q)
    if not 0.0 <= max_offset_m < math.inf:
        raise InputError(f"the largest offset is {max_offset_m} m; give 0 m or more")
    # A grid of 5.08 mm must reach 1.016 m as its 200th lag, whatever the rounding.
    largest = math.floor(min(max_offset_m, p.size * interval_m) / interval_m + 1e-9)
    if p.size < max(4 * largest, 2):
        raise InputError(
            f"{p.size * interval_m:g} m of signal are too short for offsets of up to "
            f"{max_offset_m:g} m; it takes four times as much"
        )
    overlap = _correlate(p, q, largest)
    lags = np.arange(-largest, largest + 1)
    tied = np.flatnonzero(overlap.correlation == overlap.correlation.max())
    best = tied[np.argmin(np.abs(lags[tied]))]
    rho, gamma = float(overlap.correlation[best]), float(overlap.amplitude_factor[best])
    return Agreement(rho * gamma, rho, gamma, float(lags[best]) * interval_m)


def _checked(p: FloatArray, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return both signals as float64; InputError unless finite and of equal length."""
    p, q = np.asarray(p, dtype=np.float64), np.asarray(q, dtype=np.float64)
    if p.ndim != 1 or p.shape != q.shape:
        raise InputError(f"signals of shape {p.shape} and {q.shape}; cut them to the same points")
    if not (np.isfinite(p).all() and np.isfinite(q).all()):
        raise InputError("a signal holds NaN; bridge it or cut it away before correlating")
    return p, q


def _correlate(p: FloatArray, q: FloatArray, largest: int) -> _Overlap:
    """Return correlation and amplitude factor at lags −``largest`` to ``largest``."""
    p_centred, q_centred = p - p.mean(), q - q.mean()
    products = _lagged_products(p_centred, q_centred, largest)
    counts = p.size - np.abs(np.arange(-largest, largest + 1))
    p_sums, p_squares = (_overlap_sums(v, largest) for v in (p_centred, np.square(p_centred)))
    # Seen from q the same overlaps come in the opposite order of lags.
    q_sums, q_squares = (_overlap_sums(v, largest)[::-1] for v in (q_centred, np.square(q_centred)))
    p_sigma = _sigma(p_sums, p_squares, counts, p)
    q_sigma = _sigma(q_sums, q_squares, counts, q)
    covariance = (products - p_sums * q_sums / counts) / counts
    shaped = (p_sigma > 0) & (q_sigma > 0)
    rho = np.divide(covariance, p_sigma * q_sigma, out=np.zeros(counts.size), where=shaped)
    low, high = np.minimum(p_sigma, q_sigma), np.maximum(p_sigma, q_sigma)
    gamma = np.divide(low, high, out=np.ones(counts.size), where=high > 0)
    return _Overlap(np.clip(rho, -1.0, 1.0), gamma)


def _lagged_products(p: FloatArray, q: FloatArray, largest: int) -> FloatArray:
    """Return Σ p(k)·q(k + i) over the overlap for lags i from −``largest`` to ``largest``.

    The transform is only ``largest`` points longer than the signals: what wraps around lands
    on lags that are not asked for.
    """
    from scipy.fft import irfft, next_fast_len, rfft

    size = next_fast_len(p.size + largest, real=True)
    spectrum = np.conj(rfft(p, size))
    spectrum *= rfft(q, size)
    circular = irfft(spectrum, size)
    return np.concatenate((circular[circular.size - largest :], circular[: largest + 1]))


def _overlap_sums(values: FloatArray, largest: int) -> FloatArray:
    """Return, per lag i from −L to L, the sum of those k for which k + i is a point as well."""
    total = values.sum()
    head = np.cumsum(values[:largest])
    tail = np.cumsum(values[::-1][:largest])
    return np.concatenate((total - head[::-1], [total], total - tail))


def _sigma(
    sums: FloatArray, squares: FloatArray, counts: np.ndarray, signal: FloatArray
) -> FloatArray:
    """Return the standard deviation on each overlap, 0 where it is rounding of ``signal``."""
    variance = squares / counts - np.square(sums / counts)
    rounding = np.square(1e-13 * np.abs(signal).max())
    return np.asarray(np.sqrt(np.where(variance > rounding, variance, 0.0)))
