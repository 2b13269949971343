"""Samples of a sensor that are present but measure nothing, and runs of identical samples.

Runs of identical samples are compared with the usual runs of the same channel, so that a coarse or
slow sensor, which always repeats samples, is not suspected.
"""

from dataclasses import dataclass, field

import numpy as np

from floatref.values.arrays import (
    BoolArray,
    FloatArray,
    IndexArray,
    new_record,
    new_records,
    read_only,
    release,
)
from floatref.values.recording import Channel
from floatref.values.scanning import CHUNK, chunks

NONE = np.empty((0, 2), dtype=np.int64)
EVERY = (np.inf, -np.inf)


@dataclass(frozen=True, eq=False)
class Damage:
    """Stretches of a channel to exclude; shape (k, 2): first index and the one behind.

    Attributes:
        gone: not measured, to be bridged.
        lasting: of these or others, stretches that disturb the samples after them, at any length.
        void: not measured, and a line between the neighbours is not a valid bridge.
        warnings: one line for each kind.
    """

    gone: IndexArray = field(default_factory=lambda: NONE)
    lasting: IndexArray = field(default_factory=lambda: NONE)
    void: IndexArray = field(default_factory=lambda: NONE)
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Runs:
    """Runs of identical samples of a channel: first index, length and value, shape (k,)."""

    first: IndexArray
    length: IndexArray
    value: FloatArray

    @classmethod
    def of(cls, values: FloatArray, shortest: int, outside: tuple[float, float] = EVERY) -> "Runs":
        """Return the runs of ``shortest``, 2 or more, samples in ``values``, shape (N,).

        They are at most ``outside[0]`` or at least ``outside[1]``.
        """
        from floatref.kernels import holds

        memory, ends, found, low = new_record(holds.RUN), np.array(outside), [], 0
        runs = new_records(max(CHUNK, 2 * shortest) // shortest + 2, holds.RUN)
        while True:
            chunk = values[low : low + max(CHUNK, 2 * shortest)]
            count, done = holds.find_runs(chunk, low, shortest, ends, memory, runs)
            found.append(runs[:count].copy())
            release(values)
            if low + chunk.size == values.size:
                break
            low += done
        if memory.length > 0:
            found.append(np.array([memory], holds.RUN))
        joined = np.concatenate(found)
        return cls(*(joined[name].copy() for name in holds.RUN.names or ()))

    @property
    def spans(self) -> IndexArray:
        """First index of each and the one behind, shape (k, 2)."""
        return np.stack([self.first, self.first + self.length], axis=1)


@dataclass(frozen=True, eq=False)
class Usual:
    """The lengths of a channel's runs of identical samples, and its smallest step.

    Attributes:
        held: number of runs of each length, shape (n,); longer ones count as the longest.
        in_long: samples in these.
        quantum: smallest step between different samples.
    """

    held: IndexArray
    in_long: int
    quantum: float

    @classmethod
    def of(cls, values: FloatArray, over: float = 0.0) -> "Usual":
        """Count the runs of ``values``, shape (N,), that end with a step of more than ``over``."""
        from floatref.kernels import holds

        memory, held = holds.new_count(), np.zeros(holds.LONGEST, np.int64)
        for _, chunk in chunks(values):
            holds.count_runs(chunk, over, memory, held)
        holds.count_runs(read_only(np.array([np.nan])), over, memory, held)
        return cls(held, int(memory.in_long), float(memory.quantum))

    @property
    def samples(self) -> int:
        """Number of samples."""
        return int(self._count_lying().sum())

    @property
    def hold(self) -> float:
        """Median length of the runs: the usual hold of the sensor, with or without damage."""
        return self._middle(self.held)

    def beside(self, length: int) -> float:
        """Return the length of run within which half of all other samples lie.

        One run of ``length`` is excluded, because a damaged run must not count as usual.
        """
        samples = self._count_lying()
        samples[min(length, samples.size - 1)] -= length
        return self._middle(samples)

    def _count_lying(self) -> IndexArray:
        """Number of samples in runs of each length."""
        return np.append(self.held[:-1] * np.arange(self.held.size - 1), self.in_long)

    @staticmethod
    def _middle(counts: IndexArray) -> float:
        middle = int(np.searchsorted(np.cumsum(counts), max(counts.sum(), 1) / 2))
        return float(middle) if middle < counts.size - 1 else np.inf


def describe_damage(channel: Channel, spans: IndexArray, what: str) -> str:
    """Return one line on the damage ``what`` in ``spans`` of ``channel``."""
    lengths = spans[:, 1] - spans[:, 0]
    begin = float(channel.clock.times(1, int(spans[np.argmax(lengths), 0]))[0])
    return (
        f"channel {channel.id}: {what} for {lengths.sum()} samples in {len(spans)} places, most "
        f"in a row {lengths.max()} from {begin:.6g} s; flagged"
    )


def within(spans: IndexArray, low: int, high: int) -> BoolArray | None:
    """Return which of samples ``low`` to ``high - 1`` lie in ``spans``; None if no sample does.

    ``spans`` are in order and do not overlap.
    """
    if not spans.size:
        return None
    begin, end = np.searchsorted(spans[:, 1], low, "right"), np.searchsorted(spans[:, 0], high)
    if begin >= end:
        return None
    edges = np.zeros(high - low + 1, np.int64)
    first, behind = np.clip(spans[begin:end].T - low, 0, high - low)
    np.add.at(edges, first, 1)
    np.subtract.at(edges, behind, 1)
    return np.cumsum(edges[:-1]) > 0


def merge(spans: IndexArray) -> IndexArray:
    """Return ``spans``, shape (k, 2), in order; those that touch or overlap are joined."""
    found: list[list[int]] = []
    for begin, end in sorted(spans.tolist()):
        if found and begin <= found[-1][1]:
            found[-1][1] = max(found[-1][1], end)
        else:
            found.append([begin, end])
    return np.array(found, dtype=np.int64).reshape(-1, 2)
