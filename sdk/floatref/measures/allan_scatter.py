"""How far estimates of Allan variance scatter, and how they do so together.

A noise of spectral density S gives the estimates for two cluster times the covariance
∫ S² |H₁|² |H₂|² df / T: both see the same noise, through the transfer functions H of their
clusters, for the time T that the first cluster can be moved. S is that of the coefficients of
(6.53), so that white noise, flicker and walks all have the degrees of freedom that they should
have: 2 σ⁴ / variance. A ramp is no noise; its difference of clusters is off by what noise adds.
"""

import numpy as np

from floatref.measures.allan import AllanDeviation
from floatref.values.arrays import FloatArray

PER_DECADE = 200
"""Frequencies in a decade."""
LOWEST = 0.05
"""The lowest one in cycles per signal; a constant drops out of every difference."""


class AllanScatter:
    """Covariance of the Allan variances of one signal, for any coefficients of its noise.

    The spectral density is that of (6.56), two-sided as it has to be with (6.53), and those of
    flicker, B_A²/(2πf), and quantization beside it.
    """

    def __init__(self, allan: AllanDeviation) -> None:
        """Calculate the transfer functions of all cluster times."""
        interval, clusters = allan.interval_s, allan.clusters[:, None]
        lowest, highest = LOWEST / (allan.count * interval), 0.5 / interval
        points = int(PER_DECADE * np.log10(highest / lowest))
        frequency = np.geomspace(lowest, highest, points)
        omega, half = 2.0 * np.pi * frequency, np.sin(np.pi * frequency * interval)
        flat = np.ones(points)
        # Both sides together; the ramp, which is no noise, is apart.
        self._density = 2.0 * np.stack(
            [0.0 * flat, omega**-2, 1.0 / omega, flat, (2.0 * half) ** 2 / interval], axis=1
        )
        turns = np.sin(np.pi * frequency * interval * clusters)
        moved_s = (allan.count - 2.0 * clusters + 1.0) * interval
        gain = np.sqrt(2.0) * turns**2 / (clusters * half)
        width = np.sqrt(np.gradient(frequency))
        self._noise = gain**2 * width / np.sqrt(moved_s)
        averaged = np.sinc(frequency * moved_s)
        self._ramp = np.sqrt(2.0) * allan.cluster_s[:, None] * gain * averaged * width
        self._noise_power, self._ramp_power = self._noise**2, self._ramp**2

    def root(self, squares: FloatArray) -> FloatArray:
        """Return L, shape (n, m), of the covariance L·Lᵀ of n Allan variances.

        ``squares``, shape (5,), are the squared coefficients in the order of (6.53).
        """
        density = self._density @ squares
        return np.concatenate(
            [self._noise * density, self._ramp * np.sqrt(squares[0] * density)], axis=1
        )

    def variance(self, squares: FloatArray) -> FloatArray:
        """Return the variance of each Allan variance, shape (n,)."""
        density = self._density @ squares
        ramp = squares[0] * (self._ramp_power @ density)
        variance: FloatArray = self._noise_power @ density**2 + ramp
        return variance
