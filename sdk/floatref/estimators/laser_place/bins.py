"""Readings and findings of a whole run in bins: what is behind a run is let go."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from floatref.estimators.levelling.lines import Means
from floatref.values.arrays import FloatArray, frozen

PART = 1 << 16
"""Bins at a time, ten minutes, of which a run is calculated: no more of it is in memory twice."""


def in_parts(begin: int, end: int) -> Iterator[slice]:
    """Yield the bins from ``begin`` to ``end`` in parts of `PART`."""
    for low in range(begin, end, PART):
        yield slice(low, min(low + PART, end))


@dataclass(eq=False)
class Bins:
    """Rows of a whole run as ``means`` over bins; ``parts`` are those that are complete."""

    means: Means
    parts: list[FloatArray] = field(default_factory=list)

    def add(self, *rows: FloatArray) -> None:
        """Add the samples of ``rows``, each of shape (n,)."""
        self.parts.append(self.means.take(rows))

    def take(self) -> FloatArray:
        """Return all bins, shape (rows, bins), without a last one that is cut short.

        The mean of a few samples lies before the middle of their bin, which is a brake to whoever
        differentiates the distance. A run shorter than a bin has that one.
        """
        bins = np.concatenate(self.parts, axis=1)
        self.parts = []
        return bins if bins.shape[1] else self.means.rest()


@dataclass(eq=False)
class BinsAhead:
    """What was found of a run, by name, each of shape (n,), for samples from ``begin`` on.

    A bin has ``every`` samples. Samples are asked for from the first to the last, and bins behind
    them are let go: so what is kept of a long run shrinks while its profile grows.
    """

    found: dict[str, FloatArray]
    begin: int
    every: int

    def at(self, name: str, first: int, count: int) -> FloatArray:
        """Return the lines through what has this ``name`` at ``count`` samples, shape (count,).

        They are `nothing` where all of it is zero. No sample before ``first`` is asked for again.
        """
        from floatref.estimators.levelling import kernel

        self._let_go(first)
        bins, first = self.found[name], first - self.begin
        low = max(0, first // self.every - 1)
        # Most of a run is far from any stop, where nothing is to be added.
        if not bins[low : (first + count) // self.every + 2].any():
            return nothing(count)
        values = np.empty(count)
        kernel.between_bins(bins, first, self.every, values)
        return values

    def _let_go(self, first: int) -> None:
        """Keep the bins that samples from ``first`` on need, once half of all lie behind."""
        # The line through a sample may begin at the middle of the bin before.
        behind = (first - self.begin) // self.every - 1
        if any(behind > bins.size // 2 for bins in self.found.values()):
            # One by one, so that no more than one of them is there twice.
            for name in self.found:
                self.found[name] = self.found[name][behind:].copy()
            self.begin += behind * self.every


@lru_cache(maxsize=4)
def nothing(count: int) -> FloatArray:
    """Return ``count`` zeros, the same for all: blocks that wait hold them once."""
    return frozen(np.zeros(count))
