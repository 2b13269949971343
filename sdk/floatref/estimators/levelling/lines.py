"""Means over bins of samples, and smooth local lines through them."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from floatref.values.arrays import FloatArray, Records, frozen, new_records

BIN = np.dtype([("total", np.float64), ("count", np.float64)], align=True)
"""The sum and the number of the samples so far of a bin."""
REACH = 4.0
"""Standard deviations to either side beyond which the Gaussian is nothing."""


@dataclass(eq=False)
class Means:
    """Means of several rows over bins of ``every`` samples, as soon as a bin is complete.

    A missing sample is NaN, and so is the mean of a bin of which less than half is there.
    """

    every: int
    rows: int
    memory: Records = field(init=False)
    filled: int = 0

    def __post_init__(self) -> None:
        """Begin the first bin."""
        self.memory = new_records(self.rows, BIN)

    def take(self, rows: Sequence[FloatArray] | FloatArray) -> FloatArray:
        """Return the means that the samples of ``rows`` complete, shape (rows, n)."""
        from floatref.estimators.levelling import kernel

        found, filled = np.empty((self.rows, (self.filled + rows[0].size) // self.every)), 0
        for k, row in enumerate(rows):
            # Row by row: those of a block lie apart, and a stack of them would be a copy.
            own, at = frozen(row)[np.newaxis], slice(k, k + 1)
            filled = kernel.average(own, self.every, self.memory[at], self.filled, found[at])
        self.filled = filled
        return found

    def rest(self) -> FloatArray:
        """Return the mean of what there is of a last bin that is cut short, if it is."""
        if not self.filled:
            return np.empty((self.rows, 0))
        total, count = self.memory["total"], self.memory["count"]
        return np.where(count > 0.0, total / np.maximum(count, 1.0), np.nan)[:, np.newaxis]


@dataclass(eq=False)
class Held:
    """Columns stored until they are no longer needed; ``first`` is the number of the first.

    Attributes:
        values: shape (rows, n).
        first: number of the first of the columns.
    """

    values: FloatArray
    first: int = 0

    @classmethod
    def of(cls, rows: int) -> "Held":
        """Return one without columns."""
        return cls(np.empty((rows, 0)))

    @property
    def end(self) -> int:
        """The number of the next column."""
        return self.first + int(self.values.shape[1])

    def add(self, *rows: FloatArray) -> None:
        """Add columns; their rows come in one or more arrays."""
        self.values = np.concatenate((self.values, np.vstack(rows)), axis=1)

    def take(self, count: int) -> FloatArray:
        """Return the first ``count`` columns and let go of them."""
        found, self.values = self.values[:, :count], self.values[:, count:].copy()
        self.first += int(found.shape[1])
        return found

    def drop_before(self, number: int) -> None:
        """Let go of the columns before ``number``."""
        self.take(max(0, number - self.first))


@dataclass(eq=False)
class LocalLines:
    """Values of lines that fit best nearby, by least squares with Gaussian weights.

    The line of a place is that of ``weights.size - 1`` places to either side, as far as they are
    known. No line reaches across ``patience`` unknown places in a row. Two rows go together.
    """

    weights: FloatArray
    patience: int
    held: Held = field(init=False)

    def __post_init__(self) -> None:
        """Know nothing before the first place."""
        self.held = Held.of(3)
        self.held.add(self._unknown())

    @classmethod
    def of(cls, spread: float, patience: int) -> "LocalLines":
        """Return those whose Gaussian has a standard deviation of ``spread`` places."""
        place = np.arange(max(1, round(REACH * spread)) + 1) / spread
        return cls(np.exp(-0.5 * place**2), patience)

    def take(self, rows: FloatArray, silent: FloatArray) -> FloatArray:
        """Add places, shapes (2, n) and (n,), and return the lines now known, shape (2, m)."""
        from floatref.estimators.levelling import kernel

        self.held.add(rows, silent)
        reach = self.weights.size - 1
        count = max(0, self.held.values.shape[1] - 2 * reach)
        found = np.empty((2, count))
        y, none = self.held.values[:2].copy(), self.held.values[2].copy()
        kernel.fit(y, none, self.weights, self.patience, found)
        self.held.take(count)
        return found

    def rest(self) -> FloatArray:
        """Return the lines of all remaining places."""
        more = self._unknown()
        return self.take(more[:2], more[2])

    def _unknown(self) -> FloatArray:
        reach = self.weights.size - 1
        return np.vstack((np.full((2, reach), np.nan), np.zeros(reach)))
