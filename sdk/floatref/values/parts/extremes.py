"""A long line as a picture needs it: its lowest and highest values, from fine to coarse."""

from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray, release
from floatref.values.scanning import CHUNK, chunks

COARSER = 16
"""Bins of one level that make one bin of the next."""
FEWEST_BINS = 128
"""Largest number of bins of the last level: more would have a coarser one."""


@dataclass(frozen=True, eq=False)
class Extremes:
    """The extremes of every ``samples`` successive samples; the last bin may have fewer.

    Attributes:
        samples: samples in one bin.
        low, high: lowest and highest value of every bin, shape (n,); NaN if no sample has a value.
        missing: whether any sample of the bin has no value, shape (n,).
    """

    samples: int
    low: FloatArray
    high: FloatArray
    missing: BoolArray

    @classmethod
    def of(
        cls,
        values: FloatArray,
        samples: int = 1,
        used: BoolArray | None = None,
        spread: FloatArray | None = None,
    ) -> "Extremes":
        """Return the extremes of ``values``, shape (N,); NaN and what is not ``used`` has no value.

        With ``spread``, shape (N,), the lowest are of values − spread, the highest of values +
        spread. Samples of a mapped file are read in pieces and released. Raises InputError unless
        ``samples`` is a power of two up to `CHUNK`.
        """
        if not 1 <= samples <= CHUNK or CHUNK % samples:
            raise InputError(f"{samples} samples in a bin; give a power of two up to {CHUNK}")
        parts = [(values[:0], values[:0], np.zeros(0, np.bool_))]
        for first, chunk in chunks(values):
            inside = slice(first, first + chunk.size)
            if used is not None:
                chunk = np.where(used[inside], chunk, np.nan)
            off = 0.0 if spread is None else spread[inside]
            parts.append(_reduce(chunk - off, chunk + off, samples))
            if spread is not None:
                release(spread)
        low, high, missing = (np.concatenate(part) for part in zip(*parts, strict=True))
        return cls(samples, low, high, missing)

    def coarser(self, bins: int = COARSER) -> "Extremes":
        """Return the extremes of every ``bins`` successive bins."""
        starts = np.arange(0, self.low.size, bins)
        return Extremes(
            self.samples * bins,
            np.fmin.reduceat(self.low, starts),
            np.fmax.reduceat(self.high, starts),
            np.logical_or.reduceat(self.missing, starts),
        )

    def levels(self) -> tuple["Extremes", ...]:
        """Return these extremes and coarser ones, until at most `FEWEST_BINS` are left."""
        found = [self]
        while found[-1].low.size > FEWEST_BINS:
            found.append(found[-1].coarser())
        return tuple(found)


def samples_per_bin(count: int, most_bins: int) -> int:
    """Return the least power of two by which ``count`` samples make at most ``most_bins`` bins."""
    samples = 1
    while samples < CHUNK and -(-count // samples) > most_bins:
        samples *= 2
    return samples


def _reduce(
    low: FloatArray, high: FloatArray, samples: int
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Return the lowest, the highest, and whether any is missing, of every ``samples``."""
    missing = np.isnan(low)
    if samples == 1:
        return low, high, missing
    starts = np.arange(0, low.size, samples)
    return (
        np.fmin.reduceat(low, starts),
        np.fmax.reduceat(high, starts),
        np.logical_or.reduceat(missing, starts),
    )
