"""Where the vehicle brakes, stands and sets off: the stretches whose pitch is looked for."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from floatref.estimators.road_slope.readings import STANDING_MPS, Drive
from floatref.values.arrays import BoolArray, FloatArray, IndexArray

BRAKING_MPS2 = 0.5
"""Acceleration along the road from which a tilt of half a degree, 9 mrad, is 4 mm/s²."""
SMOOTHED_S = 0.5
"""Time over which speed and acceleration are means, for that."""
BEFORE_M, BEHIND_M = 60.0, 90.0
"""Travel before and behind, in which bias and lean are known from a road at speed."""
LONGEST_SIDE_S = 30.0
"""No longer in motion, for a vehicle that creeps."""
AFTER_STOP_S, BEFORE_START_S = 5.0, 3.0
"""Of a standstill, until the body has swung out, and from before it moves again."""
SHORTEST_S = 2.0
SHORTEST_PIECE_S = 0.5
"""A piece needs a node with a neighbour on both sides; a window may cut off less."""
LONGEST_S, SHARED_S = 120.0, 20.0
"""A queue is fitted in windows, each of which shares its end with the next."""


def find_stretches(drive: Drive) -> list[list[slice]]:
    """Return the pieces of every stretch, in bins of the ``drive``."""
    found: list[list[slice]] = []
    for begin, end in _merge(list(_sides(drive, find_active(drive)))):
        used = np.arange(begin, end)[~_cut(drive, begin, end)]
        found += [_pieces(window, drive.step) for window in _windows(used, drive.step)]
    return [pieces for pieces in found if pieces]


def find_active(drive: Drive) -> BoolArray:
    """Return where the vehicle accelerates along the road, shape (n,)."""
    width = max(1, round(SMOOTHED_S / drive.step))
    speed = np.convolve(np.pad(drive.speed, width, "edge"), np.full(width, 1 / width), "same")
    half = max(1, width // 2)
    change = (speed[2 * half :] - speed[: -2 * half]) / (2 * half * drive.step)
    along: FloatArray = change[width - half : width - half + drive.speed.size]
    return np.abs(along) > BRAKING_MPS2


def near_brakes(drive: Drive) -> BoolArray:
    """Return which bins are within `SMOOTHED_S` of where it accelerates, shape (n,)."""
    near = round(SMOOTHED_S / drive.step)
    wide = np.pad(find_active(drive), near)
    return np.asarray(np.convolve(wide, np.ones(2 * near + 1), "valid") > 0.5)


def _sides(drive: Drive, active: BoolArray) -> Iterator[tuple[int, int]]:
    """Give every active stretch with the travel before and behind it."""
    x, longest = drive.distance, round(LONGEST_SIDE_S / drive.step)
    moved = np.cumsum(drive.speed >= STANDING_MPS)
    edges = np.flatnonzero(np.diff(active, prepend=False, append=False)).reshape(-1, 2)
    for begin, end in edges.tolist():
        low = np.searchsorted(x, x[begin] - BEFORE_M)
        high = np.searchsorted(x, x[end - 1] + BEHIND_M, "right")
        least = np.searchsorted(moved, moved[begin] - longest)
        most = np.searchsorted(moved, moved[end - 1] + longest, "right")
        yield int(max(low, least)), int(min(high, most))


def _merge(sides: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return the stretches with those joined that touch; a stop has two active ones."""
    found: list[tuple[int, int]] = []
    for begin, end in sides:
        if found and begin <= found[-1][1]:
            begin, end = found[-1][0], max(found.pop()[1], end)
        found.append((begin, end))
    return found


def _cut(drive: Drive, begin: int, end: int) -> BoolArray:
    """Return which bins from ``begin`` to ``end`` lie in the middle of a standstill."""
    found = np.zeros(end - begin, np.bool_)
    standing = drive.speed[begin:end] < STANDING_MPS
    edges = np.flatnonzero(np.diff(standing, prepend=False, append=False)).reshape(-1, 2)
    after, before = round(AFTER_STOP_S / drive.step), round(BEFORE_START_S / drive.step)
    for low, high in edges.tolist():
        found[low + after : max(high - before, low + after)] = True
    return found


def _windows(used: IndexArray, step: float) -> Iterator[IndexArray]:
    """Give all of ``used``, or windows of it that share their ends."""
    longest, shared = round(LONGEST_S / step), round(SHARED_S / step)
    if used.size < SHORTEST_S / step:
        return
    count = max(1, -(-(used.size - shared) // (longest - shared)))
    bounds = np.linspace(0, used.size - shared, count + 1).astype(np.int64)
    for low, high in pairwise(bounds.tolist()):
        yield used[low : high + shared]


def _pieces(used: IndexArray, step: float) -> list[slice]:
    """Return the contiguous pieces of the bins ``used`` that are long enough."""
    gaps = np.flatnonzero(np.diff(used) > 1)
    begins, ends = used[np.append(0, gaps + 1)], used[np.append(gaps, used.size - 1)]
    least = SHORTEST_PIECE_S / step
    both = zip(begins.tolist(), ends.tolist(), strict=True)
    return [slice(a, b + 1) for a, b in both if b + 1 - a >= least]
