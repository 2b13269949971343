"""Channels of different clocks on one grid of 200 Hz, without any delay."""

from collections.abc import Iterator

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray, IndexArray, release
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

RATE_HZ = 200
STEP_S = 1.0 / RATE_HZ
CELLS = 5
"""Cells per step over which samples are averaged, with the mean of their times."""
HALF = 4
"""Steps on either side whose samples the straight line of a point goes through."""
CELL_S = STEP_S / CELLS
AWAY_S = CELL_S * (np.arange(2 * HALF * CELLS) + 0.5) - HALF * STEP_S
"""Middles of the cells around a point, from it."""
TURN = np.pi / (2 * HALF * STEP_S)
"""What the distance from a point is multiplied by in cos⁴."""
BLOCK = 5 * RATE_HZ
"""Points calculated together: their samples stay in the cache."""
FILLED = 0.7
"""Least share of the expected samples that a point needs."""
THIN = 4
"""Samples per step above which those around a point alone are read."""
BEYOND = 1e100
"""What no sensor gives, in any unit, and damaged files hold: the square of it is a number still."""
LOPSIDED = 0.1
"""Largest distance of the middle of their times from the point, as a share of the steps."""


def on_grid(channel: Channel, grid_s: FloatArray) -> FloatArray:
    """Return ``channel`` at ``grid_s``, every `STEP_S`, symmetrically smoothed; NaN in gaps.

    Samples of `BEYOND` or more are missing.
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
        # More than four samples lie between two points: none of these are the same.
        near = np.add.outer(middle, [-1, 0, 1, 2]).ravel()
        near = near[(near >= 0) & (near < channel.values.size)]
        values = channel.values[near]
        if not np.isnan(values.sum()):
            release(channel.values)
            times = near.astype(np.float64) * clock.rate.denominator / clock.rate.numerator
            return clock.start_s + times, values
    return _between(channel, begin_s, end_s)


def _in_cells(
    times: FloatArray, values: FloatArray, begin_s: float, cells: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return of each cell from ``begin_s`` on the samples, their mean, and that of their times.

    The latter is from the middle of the cell.
    """
    # NaN is not less either.
    known = np.abs(values) < BEYOND
    if not known.all():
        times, values = times[known], values[known]
    # Samples come in order, so each cell is a stretch of them. One at an edge is in the cell behind
    # it, whatever rounding does.
    first = np.searchsorted(times, begin_s + CELL_S * (np.arange(cells + 1) - 1e-3))
    count = np.diff(first).astype(np.float64)
    middles = begin_s + CELL_S * (np.arange(cells) + 0.5)
    mean, time_s = (_means(x[: first[-1]], first, count) for x in (values, times))
    return count, mean, np.where(count > 0, time_s - middles, 0.0)


def _means(x: FloatArray, first: IndexArray, count: FloatArray) -> FloatArray:
    """Return the means of ``x`` between the indices ``first``; any number where nothing lies."""
    # What is behind the last sample: a stretch may begin there.
    sums = np.add.reduceat(np.append(x, 0.0), first[:-1])
    return np.asarray(sums / np.maximum(count, 1.0))


def _smooth(times: FloatArray, values: FloatArray, points: FloatArray, fewest: float) -> FloatArray:
    """Return straight lines through the samples around each of ``points``; NaN for too few."""
    cells = (points.size - 1 + 2 * HALF) * CELLS
    begin_s = points[0] - HALF * STEP_S
    # A vehicle moves by less than a millimetre in a cell: its middle is where its mean is.
    count, mean, off = _in_cells(times, values, begin_s, cells)
    turned = np.cos(TURN * off), np.sin(TURN * off)
    count, mean, off, cosine, sine = (
        np.lib.stride_tricks.sliding_window_view(x, 2 * HALF * CELLS)[::CELLS]
        for x in (count, mean, off, *turned)
    )
    away = off + AWAY_S
    # The cosine of a sum: of a cell's own samples, and of the cell's place beside the point.
    weight = count * np.square(
        np.square(cosine * np.cos(TURN * AWAY_S) - sine * np.sin(TURN * AWAY_S))
    )
    first = weight * away
    s0, s1, s2 = weight.sum(axis=1), first.sum(axis=1), np.sum(first * away, axis=1)
    level = np.sum(weight * mean, axis=1) * s2 - np.sum(first * mean, axis=1) * s1
    enough = count.sum(axis=1) >= fewest
    with np.errstate(divide="ignore", invalid="ignore"):
        even = np.abs(s1 / s0) <= LOPSIDED * HALF * STEP_S
        return np.where(enough & even, level / (s0 * s2 - s1 * s1), np.nan)
