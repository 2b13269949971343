"""Channels of one run on one grid of 5 ms, without any delay, and bands of their frequencies.

The body of a vehicle moves as one piece below some 10 Hz, and a wheel follows the road up to some 5
Hz: means over 5 ms lose nothing of either.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from floatref.screening.slow_series import NOTHING, first_samples, mean_between, samples
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.recording import Channel

STEP_S = 0.005
RATE_HZ = 1.0 / STEP_S
FEWEST_SAMPLES = 2.0
"""A channel with fewer samples in a step is interpolated between them."""
SLOPE = 4
"""Order of both ends of a band."""


@dataclass(frozen=True)
class FastGrid:
    """``count`` steps of `STEP_S` from ``begin_s`` on."""

    begin_s: float
    count: int

    @property
    def times(self) -> FloatArray:
        """The middle of every step, shape (count,), in s."""
        return np.asarray(self.begin_s + STEP_S * (0.5 + np.arange(self.count)))

    def pieces(self, length_s: float) -> "list[FastGrid]":
        """Return grids of about ``length_s`` that follow one another."""
        many = max(1, round(self.count * STEP_S / length_s))
        edges = np.linspace(0, self.count, many + 1).astype(int).tolist()
        begins = [(a, b - a) for a, b in pairwise(edges)]
        return [FastGrid(self.begin_s + STEP_S * a, size) for a, size in begins]


def shared_grid(channels: list[Channel]) -> FastGrid:
    """Return the grid of the time that all ``channels`` share; its count is 0 without any."""
    begin = max(channel.span_s[0] for channel in channels)
    end = min(channel.span_s[1] for channel in channels)
    return FastGrid(begin, max(0, int((end - begin) / STEP_S)))


def series_of(channel: Channel, grid: FastGrid, gone: IndexArray = NOTHING) -> FloatArray:
    """Return ``channel`` on ``grid``, shape (count,); NaN where it has no sample.

    Samples with the numbers ``gone``, in order, count as missing.
    """
    if channel.mean_rate_hz * STEP_S < FEWEST_SAMPLES:
        times, values = _around(channel, grid, gone)
        known = ~np.isnan(values)
        if not known.any():
            return np.full(grid.count, np.nan)
        return np.interp(grid.times, times[known], values[known])
    edges: FloatArray = grid.begin_s + STEP_S * np.arange(grid.count + 1.0)
    return mean_between(channel, edges, gone)


def _around(channel: Channel, grid: FastGrid, gone: IndexArray) -> tuple[FloatArray, FloatArray]:
    """Return times and values of the samples of ``grid``, and of one on either side."""
    ends = np.array([grid.begin_s, grid.begin_s + STEP_S * grid.count])
    first, behind = first_samples(channel, ends).tolist()
    first, behind = max(first - 1, 0), min(behind + 1, channel.values.size)
    return channel.clock.times(behind - first, first), samples(channel, first, behind, gone)


def band(series: FloatArray, low_hz: float, high_hz: float, integrals: int = 0) -> FloatArray:
    """Return ``series``, shape (n,), between two frequencies, integrated in time if asked for.

    Without any delay. Missing values count as the mean, so that a gap makes nothing up.
    """
    known = np.isfinite(series)
    level = float(series[known].mean()) if known.any() else 0.0
    size = 1 << int(np.ceil(np.log2(max(2 * series.size, 2))))
    spectrum = np.fft.rfft(np.where(known, series - level, 0.0), size)
    hertz = np.fft.rfftfreq(size, STEP_S)
    gain = 1.0 / (1.0 + (hertz / high_hz) ** SLOPE)
    gain[1:] /= 1.0 + (low_hz / hertz[1:]) ** SLOPE
    gain[0] = 0.0
    turn = np.zeros(hertz.size, np.complex128)
    turn[1:] = (2j * np.pi * hertz[1:]) ** -float(integrals)
    return np.asarray(np.fft.irfft(spectrum * gain * turn, size)[: series.size])


def dilate(where: BoolArray, seconds: float) -> BoolArray:
    """Return which points lie within ``seconds`` of one of ``where``."""
    reach = max(1, round(seconds / STEP_S))
    counts = np.concatenate([[0], np.cumsum(where)])
    index = np.arange(where.size)
    low, high = np.maximum(index - reach, 0), np.minimum(index + reach + 1, where.size)
    return np.asarray(counts[high] > counts[low])


def stretches_of(where: BoolArray, grid: FastGrid) -> list[tuple[float, float]]:
    """Return begin and end in s of every stretch of ``where``."""
    edges = np.flatnonzero(np.diff(where.astype(np.int8), prepend=0, append=0))
    times = grid.begin_s + STEP_S * edges
    return [(float(a), float(b)) for a, b in times.reshape(-1, 2)]
