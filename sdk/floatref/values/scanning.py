"""Reading long channels in pieces, so that memory stays bounded."""

from collections.abc import Callable, Iterator
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from floatref.values.arrays import BoolArray, FloatArray, IndexArray, release

CHUNK = 1 << 18
"""Samples in one piece (2 MiB)."""

TAKEN = 1 << 10
"""Samples taken at a time: each may bring 64 KiB of its file into memory."""

S = TypeVar("S", bound=np.generic)


def chunks(values: NDArray[S], overlap: int = 0) -> Iterator[tuple[int, NDArray[S]]]:
    """Yield stretches of ``values``, shape (N,), with the index of their first sample.

    Each stretch continues for ``overlap`` samples into the next one. Samples of a file are released
    before the next stretch.
    """
    for first in range(0, values.size, CHUNK):
        yield first, values[first : first + CHUNK + overlap]
        release(values)


def take(values: FloatArray, index: IndexArray) -> FloatArray:
    """Return a copy of ``values[index]``; a file is released as it is read."""
    found = [values[:0]]
    for first in range(0, index.size, TAKEN):
        found.append(values[index[first : first + TAKEN]])
        release(values)
    return np.concatenate(found)


def every(stride: int, values: FloatArray) -> FloatArray:
    """Return a copy of ``values[::stride]``."""
    return np.concatenate(
        [chunk[-first % stride :: stride].copy() for first, chunk in chunks(values)]
    )


def flags_where(condition: Callable[[FloatArray], BoolArray], values: FloatArray) -> BoolArray:
    """Return which samples meet ``condition``, shape (N,)."""
    met = np.empty(values.size, dtype=np.bool_)
    for first, chunk in chunks(values):
        met[first : first + chunk.size] = condition(chunk)
    return met


def stretch_edges(flags: BoolArray) -> IndexArray:
    """Return where stretches of ``flags`` that are set begin and end, in turns, shape (2 n,)."""
    edges, before = [np.zeros(0, np.int64)], False
    for first, part in chunks(flags):
        edges.append(first + np.flatnonzero(np.diff(part, prepend=before)))
        before = bool(part[-1])
    return np.concatenate([*edges, [flags.size] * before]).astype(np.int64)


def first_where(condition: Callable[[FloatArray], BoolArray], values: FloatArray) -> int | None:
    """Return the index of the first sample that meets ``condition``, or None."""
    for first, chunk in chunks(values):
        met = condition(chunk)
        if met.any():
            return first + int(np.argmax(met))
    return None


def first_step_where(
    condition: Callable[[FloatArray], BoolArray], values: FloatArray
) -> int | None:
    """Return the index of the first sample whose step from the one before meets ``condition``."""
    for first, chunk in chunks(values, overlap=1):
        with np.errstate(over="ignore"):
            met = condition(np.diff(chunk))
        if met.any():
            return first + int(np.argmax(met)) + 1
    return None


def longest_gap(values: FloatArray) -> tuple[int, int]:
    """Return first index and length of the longest stretch of missing (NaN) samples."""
    best, open_at = (0, 0), -1
    for first, chunk in chunks(values):
        edges = first + np.flatnonzero(np.diff(np.isnan(chunk), prepend=open_at >= 0))
        if open_at >= 0:
            edges = np.insert(edges, 0, open_at)
        open_at = int(edges[-1]) if edges.size % 2 else -1
        starts, stops = edges[: edges.size // 2 * 2].reshape(-1, 2).T
        if starts.size:
            at = int(np.argmax(stops - starts))
            best = max(best, (int(starts[at]), int(stops[at] - starts[at])), key=lambda gap: gap[1])
    last = (open_at, values.size - open_at) if open_at >= 0 else (0, 0)
    return max(best, last, key=lambda gap: gap[1])


def longest_step(values: FloatArray) -> tuple[int, float]:
    """Return where the longest step of ``values``, shape (N,), N > 1, starts, and the step."""
    longest, most = 0, -np.inf
    for first, chunk in chunks(values, overlap=1):
        steps = np.diff(chunk)
        if steps.size and steps.max() > most:
            longest, most = first + int(steps.argmax()), float(steps.max())
    return longest, most


def median_step(values: FloatArray) -> float:
    """Return the median step of ``values``, shape (N,), which increase throughout; NaN for N < 2.

    The steps of a long channel are never in memory together: they are counted by their leading
    bits, then those around the median by the next bits.
    """
    count = values.size - 1
    if count <= CHUNK:
        return float(np.median(np.diff(values))) if count > 0 else np.nan
    return (_ranked_step((count - 1) // 2, values) + _ranked_step(count // 2, values)) / 2


def _ranked_step(rank: int, values: FloatArray) -> float:
    """Return the step at ``rank`` in ascending order; positive floats sort as integers."""
    found = 0
    for shift in (48, 32, 16, 0):
        counts = np.zeros(1 << 16, np.int64)
        for _, chunk in chunks(values, overlap=1):
            digits = np.diff(chunk).view(np.int64) >> shift
            digits = digits[digits >> 16 == found] - (found << 16)
            counts += np.bincount(digits, minlength=counts.size)
        below = np.cumsum(counts)
        digit = int(np.searchsorted(below, rank, "right"))
        rank -= int(below[digit] - counts[digit])
        found = (found << 16) + digit
    return float(np.int64(found).view(np.float64))
