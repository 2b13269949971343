"""What an estimator of the road does not know of its error: drift, and wrong parameters."""

from math import pi, sqrt

import numpy as np
from numpy.typing import ArrayLike

from floatref.values.arrays import FloatArray

LOCAL_S = 0.5
"""The mean square of the tyre's deflection is that of so long before: some periods of the wheel."""


def drift_sigma(density: float, cutoff_hz: ArrayLike) -> FloatArray:
    """Return the 1-σ in m of a height integrated twice from an accelerometer, any shape.

    White noise of the two-sided ``density`` N in m/s²/√Hz, integrated twice, has the spectrum
    N²/(2πf)⁴. HPF_B3 at the cut-off c passes f⁶/(f⁶ + c⁶) of it forward and as much backward, so
    that σ² = 2N²/(2π)⁴ · ∫ f⁸/(f⁶ + c⁶)² df = 2N²/((2π)⁴c³) · π/12 from 0 to ∞.
    """
    c = np.asarray(cutoff_hz, dtype=np.float64)
    return np.asarray(density * sqrt(pi / 6.0) / (2.0 * pi) ** 2 / c**1.5, dtype=np.float64)


class LocalSquare:
    """The mean square of a signal over about `LOCAL_S` before each sample, at least its own square.

    An exponential mean: what comes next does not change it, so that a bump counts as it begins.
    """

    def __init__(self, step_s: float) -> None:
        """Take samples ``step_s`` apart."""
        self._keep = float(np.exp(-step_s / LOCAL_S))

    def begin(self) -> FloatArray:
        """Return the memory of a run."""
        return np.zeros(1)

    def advance(self, memory: FloatArray, signal: FloatArray) -> FloatArray:
        """Return it for the next samples, shape (N,), and change ``memory``; NaN counts as 0."""
        from scipy.signal import lfilter

        squares = np.nan_to_num(signal) ** 2
        if squares.size == 0:
            return squares
        mean, memory[:] = lfilter([1.0 - self._keep], [1.0, -self._keep], squares, zi=memory)
        return np.maximum(mean, squares)
