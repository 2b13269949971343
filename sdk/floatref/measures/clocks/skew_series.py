"""Channels of different clocks on one grid of 200 Hz, without any delay."""

from collections.abc import Iterator

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray, release
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

RATE_HZ = 200
STEP_S = 1.0 / RATE_HZ
CELLS = 5
"""Cells per step over which samples are averaged, with the mean of their times."""
HALF = 4
"""Steps on either side whose samples the straight line of a point goes through."""
BLOCK = 30 * RATE_HZ
"""Points calculated together."""
FILLED = 0.7
"""Least share of the expected samples that a point needs."""
THIN = 4
"""Samples per step above which those around a point alone are read."""
LOPSIDED = 0.1
"""Largest distance of the middle of their times from the point, as a share of the steps."""


def on_grid(channel: Channel, grid_s: FloatArray) -> FloatArray:
    """Return ``channel`` at ``grid_s``, every `STEP_S`, symmetrically smoothed; NaN in gaps.

    Samples count by cos⁴ of their distance in time, which is 6 dB down at 45 Hz, so that clocks of
    any rate, gaps and jitter leave no delay. Memory does not grow with the channel's rate.
    """
    found = np.full(grid_s.size, np.nan)
    fewest = max(4.0, FILLED * 2 * HALF * STEP_S * channel.mean_rate_hz)
    for first in range(0, grid_s.size, BLOCK):
        points = grid_s[first : first + BLOCK]
        times, values = _between(channel, points[0] - HALF * STEP_S, points[-1] + HALF * STEP_S)
        found[first : first + BLOCK] = _smooth(times, values, points, fewest)
    return found


def find_standing(distance: Channel, grid_s: FloatArray, most_m: float, over_s: float) -> BoolArray:
    """Return at which points of ``grid_s`` the vehicle moves by less than ``most_m``.

    The travel is over ``over_s`` behind or before the point. Where ``distance`` is missing the
    vehicle is taken to move.
    """
    places = np.full(grid_s.size, np.nan)
    for first in range(0, grid_s.size, BLOCK):
        points = grid_s[first : first + BLOCK]
        times, values = _around(distance, points)
        known = ~np.isnan(values)
        if known.any():
            there = np.interp(points, times[known], values[known], np.nan, np.nan)
            places[first : first + BLOCK] = there
    ahead = round(over_s * RATE_HZ)
    stays = np.abs(places[ahead:] - places[:-ahead]) < most_m
    # Every point from which on it is stationary, and all points until the end of that time.
    edges = np.zeros(grid_s.size + 1, np.int64)
    edges[: stays.size] += stays
    edges[ahead + 1 : ahead + 1 + stays.size] -= stays
    return np.asarray(np.cumsum(edges[:-1]) > 0)


def stretches(where: BoolArray) -> Iterator[tuple[int, int]]:
    """Yield first index and end of every stretch of ``where`` that is true."""
    edges = np.flatnonzero(np.diff(where.astype(np.int8), prepend=0, append=0))
    yield from ((int(a), int(b)) for a, b in edges.reshape(-1, 2))


def _between(channel: Channel, begin_s: float, end_s: float) -> tuple[FloatArray, FloatArray]:
    """Return times and values of the samples from ``begin_s`` to ``end_s``."""
    clock, size = channel.clock, channel.values.size
    if isinstance(clock, UniformClock):
        rate = float(clock.rate)
        ends = [np.ceil((t - clock.start_s) * rate) for t in (begin_s, end_s)]
        first, end = (int(np.clip(x, 0, size)) for x in ends)
    else:
        first, end = np.searchsorted(clock.times_s, [begin_s, end_s]).tolist()
    times, values = clock.times(end - first, first).copy(), channel.values[first:end].copy()
    release(channel.values)
    if isinstance(clock, StampedClock):
        release(clock.times_s)
    return times, values


def _around(channel: Channel, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return times and values that lines between samples at ``points`` depend on.

    Of a channel with a rate these are the samples around each point, unless some are missing.
    """
    clock, begin_s, end_s = channel.clock, points[0] - 1.0, points[-1] + 1.0
    if isinstance(clock, UniformClock) and float(clock.rate) > THIN * RATE_HZ:
        middle = np.floor((points - clock.start_s) * float(clock.rate)).astype(np.int64)
        near = np.unique(np.add.outer(middle, [-1, 0, 1, 2]).clip(0, channel.values.size - 1))
        values = channel.values[near]
        if not np.isnan(values.sum()):
            release(channel.values)
            times = near.astype(np.float64) * clock.rate.denominator / clock.rate.numerator
            return clock.start_s + times, values
    return _between(channel, begin_s, end_s)


def _smooth(times: FloatArray, values: FloatArray, points: FloatArray, fewest: float) -> FloatArray:
    """Return straight lines through the samples around each of ``points``; NaN for too few."""
    known = ~np.isnan(values)
    width = (points.size - 1 + 2 * HALF) * CELLS + 1
    begin = points[0] - HALF * STEP_S
    # A vehicle moves by less than a millimetre in a cell: its middle is where its mean is.
    cell = np.floor((times[known] - begin) / STEP_S * CELLS).astype(np.int64).clip(0, width - 1)
    count = np.bincount(cell, minlength=width).astype(np.float64)
    filled = np.maximum(count, 1.0)
    middle = np.bincount(cell, times[known] - begin, width) / filled
    mean = np.bincount(cell, values[known], width) / filled
    count, middle, mean = (
        np.lib.stride_tricks.sliding_window_view(x, 2 * HALF * CELLS)[::CELLS][: points.size]
        for x in (count, middle, mean)
    )
    away = middle - (HALF * STEP_S + STEP_S * np.arange(points.size))[:, None]
    weight = count * np.cos(np.pi / (2 * HALF * STEP_S) * away) ** 4
    s0, s1, s2 = (np.sum(weight * away**n, axis=1) for n in (0, 1, 2))
    level = np.sum(weight * mean, axis=1) * s2 - np.sum(weight * mean * away, axis=1) * s1
    enough = count.sum(axis=1) >= fewest
    with np.errstate(divide="ignore", invalid="ignore"):
        even = np.abs(s1 / s0) <= LOPSIDED * HALF * STEP_S
        return np.where(enough & even, level / (s0 * s2 - s1 * s1), np.nan)
