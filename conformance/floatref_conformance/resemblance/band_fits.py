"""Fits of waves of some lengths: which share of a signal follows another, and its lag."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from floatref.values.arrays import FloatArray
from floatref_conformance.resemblance.compared_path import STEP_M

Waves = npt.NDArray[np.complex128]
TINY_M = 1e-9
"""Below this, in m, a signal is zero."""


def waves_of(signal: FloatArray, band_m: tuple[float, float], lag_m: float = 0.0) -> Waves:
    """Return the waves of ``signal`` within ``band_m``, in m, after a Hann window; shape (k,).

    They are those of the signal moved forward by ``lag_m``, which takes such a lag away.
    """
    window = np.hanning(signal.size)
    waves = np.fft.rfft((signal - signal.mean()) * window)
    number = np.fft.rfftfreq(signal.size, STEP_M)
    inside = (number > 1.0 / band_m[1]) & (number <= 1.0 / band_m[0])
    # So that the sum of their squares is the mean square of the signal.
    waves = waves * np.exp(2j * np.pi * number * lag_m)
    return np.asarray(waves[inside] * np.sqrt(2.0 / (signal.size * float(np.sum(window**2)))))


def root_mean_square(waves: Waves) -> float:
    """Return the root mean square of the signal that ``waves`` make up, in its unit."""
    return float(np.sqrt(np.sum(np.abs(waves) ** 2)))


def fit_real(of: Waves, to: Sequence[Waves]) -> tuple[FloatArray, float]:
    """Return the factors of ``to`` that fit ``of`` best, and the rms of what is left.

    A signal that is zero has the factor 0, and the factors follow by least squares.
    """
    used = [root_mean_square(each) > TINY_M for each in to]
    factors = np.zeros(len(to))
    rows = [np.concatenate((w.real, w.imag)) for w, use in zip(to, used, strict=True) if use]
    left = np.concatenate((of.real, of.imag))
    if rows and left.size > len(rows):
        found = np.linalg.lstsq(np.stack(rows, axis=1), left, rcond=None)[0]
        factors[np.flatnonzero(used)] = found
        left = left - np.stack(rows, axis=1) @ found
    return factors, float(np.sqrt(np.sum(left**2)))


def fit_complex(of: Waves, to: Waves) -> tuple[complex, float]:
    """Return the complex factor of ``to`` that fits ``of`` best, and the share of ``of`` left."""
    power = float(np.sum(np.abs(to) ** 2))
    own = float(np.sum(np.abs(of) ** 2))
    if power < TINY_M**2:
        return 0j, 0.0
    factor = complex(np.sum(of * np.conj(to)) / power)
    left = own - abs(factor) ** 2 * power
    return factor, float(np.sqrt(max(left, 0.0) / max(own, TINY_M**2)))


def slope_of(signal: FloatArray) -> FloatArray:
    """Return the derivative of ``signal`` over distance, per m, shape (n,)."""
    return np.asarray(np.gradient(signal, STEP_M))


def find_lag(found: FloatArray, truth: FloatArray, most_m: float) -> float:
    """Return by how much ``found`` lies behind ``truth``, in m, within ``most_m``.

    The slopes are correlated, and the largest correlation of either sign, since a profile may be
    upside down, is interpolated by a parabola. 0 for signals without a slope.
    """
    one, other = (slope_of(z - z.mean()) for z in (found, truth))
    size = 2 * max(one.size, 2)
    cross = np.fft.irfft(np.fft.rfft(one, size) * np.conj(np.fft.rfft(other, size)), size)
    count = round(most_m / STEP_M)
    around = np.abs(np.concatenate((cross[-count:], cross[: count + 1])))
    if float(around.max()) < TINY_M**2 * one.size:
        return 0.0
    best = int(np.argmax(around))
    if not 0 < best < around.size - 1:
        return (best - count) * STEP_M
    before, here, after = around[best - 1 : best + 2]
    bend = before - 2 * here + after
    part = 0.5 * (before - after) / bend if bend < 0 else 0.0
    return float((best - count + part) * STEP_M)
