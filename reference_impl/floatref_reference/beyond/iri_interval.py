"""How far an IRI may be off, from the 1-sigma of the elevation.

The errors of neighbouring points are alike over a length that no profile states. It is assumed that
they are those of white noise of an acceleration, integrated twice and high-pass filtered by two
equal poles at the longest wavelength that the car feels.
"""

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_1_iri import BASE_LENGTH, START_LENGTH, iri_trace
from floatref_reference.signals import PI, ZERO, Real, Samples, Signal, samples, signal

LONGEST_WAVE = 30.0
MEMORY = 100.0
NORMAL_95 = np.longdouble("1.959963984540054")


def correlation(distance: Real, wavelength: Real = LONGEST_WAVE) -> np.longdouble:
    """Compute how alike the errors of two points are.

    Equation:
        (1 + |d|/L) exp(-|d|/L), L = λ / 2π

    Args:
        distance: d, m.
        wavelength: λ, m.

    Returns:
        Correlation, 0 to 1.
    """
    d = abs(np.longdouble(distance)) * 2 * PI / np.longdouble(wavelength)
    return np.longdouble((1 + d) * np.exp(-d))


def impulse_response(dx: float) -> Signal:
    """Compute the output of the IRI filter when one point of a level profile is 1 m high.

    Equation:
        Steps 1 to 3 of section 2.1.1 for z = 1 m at one point behind the start length, 0 elsewhere.

    Args:
        dx: constant interval Δx, m.

    Returns:
        h, m/km per m, from the first interval that the point changes to 100 m behind it.
    """
    window = max(round(BASE_LENGTH / dx), 1)
    before = max(round(START_LENGTH / dx), 1) + window
    z = [ZERO] * (before + round(MEMORY / dx) + 1)
    z[before] = np.longdouble(1)
    return signal(iri_trace(z, dx)[before - window :])


def output_covariance(dx: float, lags: int, wavelength: Real = LONGEST_WAVE) -> Signal:
    """Compute the covariance of the output's errors where the elevation's 1-sigma is 1 m.

    Equation:
        R(m) = Σ_i Σ_l h_i h_l ρ((m + i - l) Δx), summed first over equal i - l.

    Args:
        dx: constant interval Δx, m.
        lags: number of lags m, from 0 on.
        wavelength: λ, m.

    Returns:
        R, (m/km)²/m², shape (lags,).
    """
    h = samples(impulse_response(dx))
    n = len(h)
    products = [ZERO] * n
    for m in range(n):
        for i in range(n - m):
            products[m] += h[i] * h[i + m]
    rho = [correlation(m * dx, wavelength) for m in range(lags + n)]
    found: Samples = []
    for m in range(lags):
        total = products[0] * rho[m]
        for i in range(1, n):
            total += products[i] * (rho[m + i] + rho[abs(m - i)])
        found.append(total)
    return signal(found)


def standard_error(y: npt.ArrayLike, sigma: npt.ArrayLike, R: npt.ArrayLike) -> np.longdouble:
    """Compute the 1-sigma of an IRI to first order in the errors.

    Equation:
        s² = 1/n² Σ_j Σ_k sgn(y_j) σ_j R(|j - k|) σ_k sgn(y_k), with R = 0 beyond its lags.

    Args:
        y: output of the IRI filter, m/km, shape (n,).
        sigma: 1-sigma of the elevation at the start of each interval, m, shape (n,).
        R: covariance, (m/km)²/m², one value for each lag.

    Returns:
        s, m/km.
    """
    a = [np.sign(y_k) * s_k for y_k, s_k in zip(samples(y), samples(sigma), strict=True)]
    covariance = samples(R)
    total = ZERO
    for j in range(len(a)):
        for k in range(len(a)):
            if abs(j - k) < len(covariance):
                total += a[j] * covariance[abs(j - k)] * a[k]
    return np.longdouble(np.sqrt(max(total, ZERO)) / len(a))


def iri_interval(
    y: npt.ArrayLike, sigma: npt.ArrayLike, R: npt.ArrayLike
) -> tuple[np.longdouble, np.longdouble]:
    """Compute the interval that holds the IRI with 95 %.

    Equation:
        IRI √max(0, 1 - q) - 1.96 s … IRI + 1.96 s, with q = R(0) Σσ_k² / Σy_k²: the part of the
        mean square of y that is error.

    Args:
        y: output of the IRI filter, m/km, shape (n,).
        sigma: 1-sigma of the elevation at the start of each interval, m, shape (n,).
        R: covariance, (m/km)²/m², one value for each lag.

    Returns:
        Lowest, not below zero, and highest IRI, m/km.
    """
    outputs, spreads = samples(y), samples(sigma)
    absolute = squares = errors = ZERO
    for y_k, s_k in zip(outputs, spreads, strict=True):
        absolute += abs(y_k)
        squares += y_k * y_k
        errors += samples(R)[0] * s_k * s_k
    iri = absolute / len(outputs)
    half = NORMAL_95 * standard_error(y, sigma, R)
    left = max(ZERO, 1 - errors / squares)
    return np.longdouble(max(ZERO, iri * np.sqrt(left) - half)), np.longdouble(iri + half)
