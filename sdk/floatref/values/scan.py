"""What one pass over a channel finds: whoever asks later does not read its samples again."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from floatref.values import scanning
from floatref.values.arrays import BoolArray, FloatArray, IndexArray, release

REACH = 2
"""Samples of the next part in which steps of a part are sought, as those that look closer do."""


@dataclass(frozen=True)
class Summary:
    """Statistics of the valid samples of a channel; NaN if no sample is valid."""

    count: int
    missing: int
    mean: float
    least: float
    greatest: float


@dataclass(frozen=True, eq=False)
class Scan:
    """What is found in each of the k parts that a channel is read in.

    Attributes:
        edges: index of the first sample of each part, and the number of all, shape (k + 1,).
        missing: how many samples are missing, shape (k,), as all that follows.
        total: sum of the others.
        least: the smallest of them, infinite without any.
        greatest: the largest, likewise.
        fall: the steepest step down between neighbours, in the part and the `REACH` samples behind
            it, 0 or less.
        rise: the steepest step up there, 0 or more.
    """

    edges: IndexArray
    missing: IndexArray
    total: FloatArray
    least: FloatArray
    greatest: FloatArray
    fall: FloatArray
    rise: FloatArray

    @classmethod
    def of(cls, values: FloatArray) -> "Scan":
        """Read ``values``, shape (N,), once; NaN is a missing sample."""
        edges, found, room = [], [], np.empty(0)
        for first, wide in scanning.chunks(values, overlap=REACH):
            edges.append(first)
            # Memory for the steps of a part is taken once, and not anew for each.
            room = room if room.size >= wide.size else np.empty(wide.size)
            found.append((*_levels(wide[: scanning.CHUNK]), *_steps(wide, room)))
        missing, *others = np.array(found, np.float64).reshape(-1, 6).T
        return cls(np.array([*edges, values.size]), missing.astype(np.int64), *others)

    @property
    def summary(self) -> Summary:
        """The statistics of all samples."""
        count, missing = int(self.edges[-1]), int(self.missing.sum())
        if missing == count:
            return Summary(count, missing, np.nan, np.nan, np.nan)
        with np.errstate(over="ignore", invalid="ignore"):
            # One part after the other, as they come.
            mean = float(np.cumsum(self.total)[-1]) / (count - missing)
        return Summary(count, missing, mean, *self.extremes)

    @property
    def extremes(self) -> tuple[float, float]:
        """The smallest and the largest of the samples that are not missing; infinite without."""
        # 0 for -0, which messages would show.
        least, greatest = self.least.min(initial=np.inf), self.greatest.max(initial=-np.inf)
        return float(least) + 0.0, float(greatest) + 0.0

    @property
    def largest(self) -> float:
        """The largest absolute value of a sample; -inf if all are missing."""
        least, greatest = self.extremes
        return max(-least, greatest)

    @property
    def leap(self) -> FloatArray:
        """The largest step of each part in either direction, shape (k,)."""
        return np.maximum(-self.fall, self.rise)

    def parts(
        self, values: FloatArray, chosen: BoolArray, overlap: int = 0
    ) -> Iterator[tuple[int, FloatArray]]:
        """Yield the ``chosen`` parts of ``values``, with the index of their first sample.

        Each continues for ``overlap`` samples. Samples of a file are released before the next.
        """
        for k in np.flatnonzero(chosen):
            first, end = self.edges[k : k + 2].tolist()
            yield first, values[first : end + overlap]
            release(values)


def _levels(part: FloatArray) -> tuple[int, float, float, float]:
    """Return how many samples are missing, the sum of the others, the smallest and the largest."""
    with np.errstate(over="ignore", invalid="ignore"):
        total, missing = float(np.sum(part)), 0
        if np.isnan(total):
            # A sum is NaN if a sample is; then alone they have to be chosen.
            known = part[~np.isnan(part)]
            total, missing = float(np.sum(known)), part.size - known.size
    least, greatest = np.fmin.reduce(part), np.fmax.reduce(part)
    if missing == part.size:
        least, greatest = np.inf, -np.inf
    return missing, total, float(least), float(greatest)


def _steps(part: FloatArray, room: FloatArray) -> tuple[float, float]:
    """Return the steepest steps down and up, 0 without any."""
    with np.errstate(over="ignore", invalid="ignore"):
        steps = np.subtract(part[1:], part[:-1], out=room[: part.size - 1])
    return (
        float(np.fmin.reduce(steps, initial=0.0)),
        float(np.fmax.reduce(steps, initial=0.0)),
    )
