"""Overlapping Allan deviation of a signal that ought to be constant (section 6.4.1).

The mean of ``n`` consecutive samples is a cluster average (6.49). The Allan variance for the
cluster time ``n Δt`` is half the mean square of the difference of two adjacent ones, over all
places that they can take (6.50). It is calculated from the running sum of the samples (6.51), whose
second difference over ``n`` samples is ``n`` times that difference (6.52). A constant has no
second difference, so the mean is taken off before and the sum stays small.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.scan import Scan, Summary
from floatref.values.scanning import chunks

PER_DECADE = 20
"""Cluster times in a decade, where samples allow it."""
LONGEST_SHARE = 3
"""The longest cluster is this part of the signal: beyond, hardly any two can be compared."""
FEWEST = 64
"""Fewest samples of a signal that has an Allan deviation."""
CLEARLY, CLEAR_OF_PEAK = 2.0, 5.0
"""Factor by which the deviation falls behind a peak that a band limit makes, and factor of time for
which the peak is searched."""
GREATEST = 1e100
"""Largest size of a sample; beyond it the squares overflow."""
MOST_SUMS = 1 << 26
"""Most sums in memory (0.5 GiB); of a longer signal only every second sum, every third, …"""
BLOCK = 1 << 16
"""Differences handled together: they stay in the cache."""


@dataclass(frozen=True, eq=False)
class AllanDeviation:
    """Allan deviation of ``count`` samples, ``interval_s`` apart, for clusters of some sizes.

    ``clusters`` and ``deviation`` have the shape (n,): samples in a cluster, rising, and the
    deviation for it in the signal's unit. ``standard_deviation`` is that of all samples.
    """

    interval_s: float
    count: int
    clusters: IndexArray
    deviation: FloatArray
    standard_deviation: float

    @property
    def cluster_s(self) -> FloatArray:
        """Cluster times in s, shape (n,)."""
        return np.multiply(self.clusters, self.interval_s, dtype=np.float64)

    @property
    def settled_s(self) -> float:
        """Cluster time in s from which on no band limit of the sensor shows; 0 without a limit.

        A sensor that is filtered, or slower than its channel, has correlated samples: at first its
        deviation rises. It falls again, unlike that of a bias that walks.
        """
        falls = np.flatnonzero(np.diff(self.deviation) < 0)
        peak = int(falls[0]) if falls.size else self.clusters.size
        if not 0 < peak < self.clusters.size // 2:
            return 0.0
        falls_far = self.deviation[peak:].min() < self.deviation[peak] / CLEARLY
        return CLEAR_OF_PEAK * float(self.cluster_s[peak]) if falls_far else 0.0

    def between(self, shortest_s: float, longest_s: float) -> "AllanDeviation":
        """Return the part for cluster times from ``shortest_s`` to ``longest_s``, in s."""
        inside = (self.cluster_s >= shortest_s) & (self.cluster_s <= longest_s)
        return replace(self, clusters=self.clusters[inside], deviation=self.deviation[inside])


def allan_deviation(
    values: FloatArray, interval_s: float, progress: Callable[[float], None] | None = None
) -> AllanDeviation:
    """Return the overlapping Allan deviation (6.49) to (6.52) of ``values``, shape (N,).

    They are ``interval_s`` apart, in any unit. Cluster times are spread evenly on a logarithmic
    scale up to a third of the signal. ``progress`` is called with the share that is done, from 0 to
    1. Raises InputError for an interval that is not above zero, fewer than 64 samples, NaN,
    infinities and magnitudes beyond 1e100, and samples that are all the same.
    """
    summary = _summary(values, interval_s)
    stride = -(-values.size // MOST_SUMS)
    sums, deviation = _running_sums(values, summary.mean, stride)
    sizes = cluster_sizes(sums.size - 1)
    variances = np.empty(sizes.size)
    for k, size in enumerate(sizes.tolist()):
        variances[k] = _mean_square(sums, size) / (2.0 * (size * stride) ** 2)
        if progress is not None:
            progress((k + 1) / sizes.size)
    return AllanDeviation(interval_s, values.size, sizes * stride, np.sqrt(variances), deviation)


def cluster_sizes(count: int) -> IndexArray:
    """Return the sizes of clusters for ``count`` samples: 1 to a third of them, rising."""
    largest = max(count // LONGEST_SHARE, 1)
    points = int(PER_DECADE * np.log10(largest)) + 1
    return np.unique(np.rint(np.geomspace(1, largest, points)).astype(np.int64))


def _summary(values: FloatArray, interval_s: float) -> Summary:
    """Return the summary of ``values``; InputError unless they have an Allan deviation."""
    if not (np.isfinite(interval_s) and interval_s > 0):
        raise InputError(f"interval is {interval_s} s; it must be above zero")
    if values.ndim != 1 or values.size < FEWEST:
        raise InputError(
            f"{values.size} samples of shape {values.shape}; give one row of {FEWEST} or more"
        )
    summary = Scan.of(values).summary
    if summary.missing:
        raise InputError(f"{summary.missing} of {values.size} samples are missing; cut them away")
    greatest = max(summary.greatest, -summary.least)
    if greatest > GREATEST:
        raise InputError(f"a sample is {greatest:.4g} in size, which nothing measures; cut it away")
    if summary.least == summary.greatest:
        raise InputError(
            f"every sample is {summary.least:.6g}; a sensor that works has noise, so connect it"
        )
    return summary


def _running_sums(values: FloatArray, mean: float, stride: int) -> tuple[FloatArray, float]:
    """Return every ``stride``-th sum of ``values − mean``, from 0 on, and their deviation."""
    sums = np.zeros(values.size // stride + 1)
    reached, squares = 0.0, 0.0
    for first, chunk in chunks(values):
        centred = chunk - mean
        squares += float(np.sum(np.square(centred)))
        running = np.cumsum(centred)
        running += reached
        reached = float(running[-1])
        kept = running[stride - 1 - first % stride :: stride]
        begin = first // stride + 1
        sums[begin : begin + kept.size] = kept
    return sums, float(np.sqrt(squares / values.size))


def _mean_square(sums: FloatArray, size: int) -> float:
    """Return the mean square of the second differences of ``sums`` over ``size`` of them."""
    places = sums.size - 2 * size
    total, ahead, behind = 0.0, np.empty(BLOCK), np.empty(BLOCK)
    for first in range(0, places, BLOCK):
        count = min(BLOCK, places - first)
        begin, middle, end = (sums[first + k * size :][:count] for k in range(3))
        # Each difference is small beside the sums, so that the rounding error is small.
        np.subtract(end, middle, out=ahead[:count])
        np.subtract(middle, begin, out=behind[:count])
        ahead[:count] -= behind[:count]
        total += float(np.sum(np.square(ahead[:count], out=behind[:count])))
    return total / places


SCATTER_PER_DECADE = 200
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
        points = int(SCATTER_PER_DECADE * np.log10(highest / lowest))
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
