"""Observations of the Kalman filter in the order of time, as its kernel takes them."""

from collections.abc import Sequence

import numpy as np

from floatref.estimators.kalman.layout import KINDS, OBSERVATION
from floatref.values.arrays import FloatArray, IndexArray

UNSEEN = np.full(KINDS, np.nan)
Chunk = tuple[IndexArray, IndexArray, FloatArray]
"""Samples (m,), marks (m,), and values with variances (m, 9) of observations in order."""


def chunk_of(
    at: IndexArray,
    mark: int,
    y: FloatArray,
    variance: FloatArray,
    moved: FloatArray | float = 0.0,
) -> Chunk:
    """Return observations ``y`` at the samples ``at``, all with the same ``mark``."""
    rows = np.empty((at.size, OBSERVATION))
    rows[:, :KINDS], rows[:, KINDS:-1], rows[:, -1] = y, variance, moved
    return at, np.full(at.size, mark), rows


def merged(one: Chunk, other: Chunk) -> Chunk:
    """Return both in the order of time; what comes at one sample becomes one observation."""
    at = np.union1d(one[0], other[0])
    marks, rows = np.zeros(at.size, np.int64), np.full((at.size, OBSERVATION), np.nan)
    rows[:, -1] = 0.0
    for times, mark, row in (one, other):
        place = np.searchsorted(at, times)
        marks[place] |= mark
        rows[place] = np.where(np.isnan(row), rows[place], row)
    return at, marks, rows


def marked(chunk: Chunk, sample: int, mark: int) -> Chunk:
    """Return ``chunk`` with ``mark`` at ``sample``, which need not have an observation."""
    at, marks, rows = chunk
    place = int(np.searchsorted(at, sample))
    if place < at.size and at[place] == sample:
        marks[place] |= mark
        return chunk
    alone = chunk_of(np.array([sample]), mark, UNSEEN, UNSEEN)
    head, tail = ((at[w], marks[w], rows[w]) for w in (slice(place), slice(place, None)))
    return joined([head, alone, tail])


def joined(chunks: Sequence[Chunk]) -> Chunk:
    """Return ``chunks``, each behind the one before, as one."""
    if not chunks:
        return np.empty(0, np.int64), np.empty(0, np.int64), np.empty((0, OBSERVATION))
    at, marks, rows = zip(*chunks, strict=True)
    return np.concatenate(at), np.concatenate(marks), np.concatenate(rows)
