r"""How far the IRI of a profile may be off, from the 1-σ of its elevation.

The 1-σ of a point does not say over which length the errors of neighbours are alike, and the car
feels nothing of an error that all points share. So a correlation is assumed: that of white noise of
an acceleration, integrated twice and high-pass filtered with two equal poles at the wavelength λ,
with L = λ/2π. λ is 30 m, the longest wave that the car feels: errors in longer waves, of which the
1-σ mostly consists, make the interval too wide, never too narrow:

    e(x) = σ(x) u(x),   E[u(x) u(x + d)] = (1 + |d|/L) exp(−|d|/L)                          (1)

The output of the IRI filter is linear in the elevation. With its impulse response h its error η is

    E[η_j η_k] = σ_j σ_k R(j − k),   R(m) = Σ_i Σ_l h_i h_l E[u(0) u((m + i − l)Δ)]         (2)

where σ changes little over the some 20 m that the car remembers. Of n intervals with the output y
the IRI is Σ|y_k|/n. To first order its error has the 1-σ

    s² = 1/n² Σ_j Σ_k sgn(y_j) σ_j R(j − k) σ_k sgn(y_k)                                    (3)

and errors make a road rougher on average: of the mean square of y, the part
q = R(0) Σσ_k² / Σy_k² is error. The interval is

    IRI √max(0, 1 − q) − 1.96 s   to   IRI + 1.96 s                                         (4)
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.roughness.overlap_add import convolve, middle
from floatref.measures.roughness.roughness_index import STANDARD, iri_trace
from floatref.values.arrays import FloatArray
from floatref.values.scanning import CHUNK

LONGEST_WAVE_M = 30.0
"""Wavelength λ in m: the car feels waves of 0.4 to 30 m."""
CORRELATION_M = LONGEST_WAVE_M / (2.0 * np.pi)
"""Length L in m of (1)."""
MEMORY_M = 100.0
"""Length in m after which the car has forgotten an error."""
NORMAL_95 = 1.959963984540054
"""Half-width of the interval that holds 95 % of a normal distribution, in 1-σ."""


class Interval(NamedTuple):
    """Lowest and highest IRI in m/km with which a profile agrees; NaN where 1-σ is unknown."""

    low_m_per_km: float
    high_m_per_km: float


UNKNOWN = Interval(float("nan"), float("nan"))


def iri_interval(
    trace: FloatArray,
    sigma: FloatArray,
    interval_m: float,
    settings: IriSettings = STANDARD,
    correlation_m: float = CORRELATION_M,
) -> Interval:
    """Return the 95 % interval (4) of the IRI over the intervals of which ``trace`` is finite.

    ``trace`` is the signed output of `iri_trace` in m/km, NaN where an interval does not count, and
    ``sigma`` the 1-σ in m at the start of each, both of shape (n,). Unknown without an interval
    that counts, and where ``sigma`` of one of them is not finite.
    """
    covariance = output_covariance(interval_m, settings, correlation_m)
    sums = _sums_of(trace, sigma, covariance)
    count, squares = int(sums.counted), sums.squares
    if not count or not np.isfinite(sums.variance):
        return UNKNOWN
    value = sums.rectified / count
    half = NORMAL_95 * float(np.sqrt(max(sums.signed, 0.0))) / count
    error = float(covariance[0] * sums.variance)
    left = max(0.0, 1.0 - error / squares) if squares > 0.0 else float(error == 0.0)
    return Interval(max(0.0, value * float(np.sqrt(left)) - half), value + half)


@lru_cache(maxsize=8)
def output_covariance(
    interval_m: float, settings: IriSettings = STANDARD, correlation_m: float = CORRELATION_M
) -> FloatArray:
    """Return R(m) of (2) in (m/km)² per m², for lags m from 0 to 100 m, at ``interval_m``.

    ``correlation_m`` is L of (1) in m. Read-only. Raises InputError for an interval above 2 m.
    """
    response = _impulse_response(interval_m, settings)
    reach = _memory(interval_m)
    own = convolve(response, response[::-1])
    lags = np.arange(-(reach + response.size - 1), reach + response.size)
    distance = np.abs(lags) * (interval_m / correlation_m)
    whole = convolve((1.0 + distance) * np.exp(-distance), own)
    found = middle(whole, lags.size - own.size + 1)
    covariance = np.ascontiguousarray(found[found.size // 2 :])
    covariance.flags.writeable = False
    return covariance


def _impulse_response(interval_m: float, settings: IriSettings) -> FloatArray:
    """Return h of (2) in m/km per m, from the first interval whose output the point changes."""
    before = settings.start_count(interval_m) + settings.window(interval_m)
    elevation = np.zeros(before + _memory(interval_m) + 1)
    elevation[before] = 1.0
    return iri_trace(elevation, interval_m, settings)[before - settings.window(interval_m) :]


def _memory(interval_m: float) -> int:
    return round(MEMORY_M / interval_m)


class _Sums(NamedTuple):
    """Sums over the intervals that count.

    Attributes:
        counted: their number, n.
        rectified, squares: of the output, Σ|y_k| in m/km and Σy_k².
        variance: Σσ_k² in m²; NaN where a 1-σ is not finite.
        signed: the double sum of (3) in (m/km)².
    """

    counted: float
    rectified: float
    squares: float
    variance: float
    signed: float


def _sums_of(trace: FloatArray, sigma: FloatArray, covariance: FloatArray) -> _Sums:
    """Return the sums over a trace and its 1-σ, in pieces, so that a long one takes no memory."""
    totals = np.zeros(len(_Sums._fields))
    for first in range(0, trace.size, CHUNK):
        inside = slice(first, first + CHUNK)
        output, spread = _counted(trace[inside], sigma[inside])
        before = max(first - covariance.size + 1, 0)
        beside = slice(before, min(first + CHUNK + covariance.size - 1, trace.size))
        around, widths = _counted(trace[beside], sigma[beside])
        signed = _double_sum(np.sign(around) * widths, first - before, output.size, covariance)
        counted = np.count_nonzero(np.isfinite(trace[inside]))
        squares = np.square(output).sum(), np.square(spread).sum()
        totals += np.array([counted, np.abs(output).sum(), *squares, signed])
    return _Sums(*totals.tolist())


def _counted(trace: FloatArray, sigma: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return output in m/km and 1-σ in m, 0 where an interval does not count."""
    counted = np.isfinite(trace)
    spread = np.where(np.isfinite(sigma), sigma, np.nan)
    return np.where(counted, trace, 0.0), np.where(counted, spread, 0.0)


def _double_sum(signed: FloatArray, first: int, count: int, covariance: FloatArray) -> float:
    """Return the part of the double sum of (3) in which j is one of ``count`` from ``first`` on.

    ``signed`` is sgn(y_k) σ_k in m, 0 where nothing counts.
    """
    lags = min(covariance.size, signed.size)
    both = np.concatenate((covariance[lags - 1 : 0 : -1], covariance[:lags]))
    spread = middle(convolve(signed, both), signed.size)
    inside = slice(first, first + count)
    return float(signed[inside] @ spread[inside])
