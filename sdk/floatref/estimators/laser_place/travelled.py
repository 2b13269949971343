"""Travel where the encoder does not measure it: a short loss of counts or a leap is no brake."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray, IndexArray

SHORT_LOSS_S = 1.0
"""Longest loss of counts that can hide no brake worth a tilt: the speed beside it is as before."""
MOMENT_S = 0.12
"""A loss so short that a line across it is as good as the encoder, in the hardest brake too: at
8 m/s² the speed on it is off by no more than 0.12 m/s."""
BESIDE_S = 0.25
"""Time on either side whose mean is the speed there: several counts of a coarse encoder."""
UNSURE_BINS = 4
"""A way from bin to bin is unsure with these bins about it: both, of which one may be known in
part, with a mean away from its middle, and their neighbours."""
ROLLED_S, ROLLED_M = 0.1, 0.03
"""A vehicle is at a standstill that goes no farther by its encoder in the first than the second: at
0.3 m/s, a brake of 1.5 m/s² ends within 0.03 m."""


class Travelled(NamedTuple):
    """Travel in bins of a whole run, each of shape (n,).

    Attributes:
        distance: that the vehicle has travelled, in m, a line where it is not known.
        lost: whether the encoder gives no travel there, and what the vehicle did is not known.
        guessed: whether the vehicle is taken to have gone on, for long or across a leap.
        rolled: whether it gives no travel, but the vehicle is at a standstill.
    """

    distance: FloatArray
    lost: BoolArray
    guessed: BoolArray
    rolled: BoolArray

    @classmethod
    def of(cls, counted: FloatArray, miscounted: BoolArray, step: float) -> "Travelled":
        """Return the travel by the distance ``counted`` in m, shape (n,), NaN where missing.

        Where the encoder has ``miscounted`` it leaps or counts too much.
        """
        known, bins = np.flatnonzero(~np.isnan(counted)), np.arange(counted.size)
        nothing = np.zeros(bins.size, np.bool_)
        if not known.size:
            return cls(counted, ~nothing, nothing, nothing)
        distance = np.maximum.accumulate(np.interp(bins, known, counted[known]))
        lost = np.isnan(counted) | miscounted
        rolled = rolled_back(lost, distance, step)
        lost &= ~rolled
        distance, bridged = bridge_short_losses(distance, lost, step)
        return cls(distance, lost & ~bridged, _guesses(bridged, miscounted, step), rolled)


def bridge_short_losses(
    distance: FloatArray, lost: BoolArray, step: float
) -> tuple[FloatArray, BoolArray]:
    """Return the ``distance`` in m of a vehicle that drives on, and which ``lost`` bins it bridges.

    All have shape (n,). The speed is linear between those on both sides. So all behind is moved by
    what the encoder did not count, or has not travelled. A longer loss, and one at an end of the
    run, may hide a stop: it is left as it is.
    """
    bridged = np.zeros(lost.size, np.bool_)
    if not lost.any() or distance.size < 2:
        return distance, bridged
    ways = np.diff(distance)
    unsure = np.convolve(np.pad(lost, 1), np.ones(UNSURE_BINS, np.bool_), "valid")
    known, longest = np.flatnonzero(~unsure), SHORT_LOSS_S / step + UNSURE_BINS
    for low, high in _spans(unsure):
        before, behind = _beside(known, low, max(1, round(BESIDE_S / step)))
        if before.size and behind.size and high - low <= longest:
            sides = [before.mean(), behind.mean()], [ways[before].mean(), ways[behind].mean()]
            ways[low:high] = np.interp(np.arange(low, high), *sides)
            bridged[low : high + 1] = lost[low : high + 1]
    return np.asarray(distance[0] + np.append(0.0, np.cumsum(ways))), bridged


def rolled_back(lost: BoolArray, distance: FloatArray, step: float) -> BoolArray:
    """Return which ``lost`` bins lie within a standstill, shape (n,).

    A vehicle that rolls back and returns is where it was: no travel is lost. A wheel that locks
    stands only from then on.
    """
    found, near = np.zeros(lost.size, np.bool_), max(1, round(ROLLED_S / step))
    for low, high in _spans(lost):
        if near < low and high + near < lost.size:
            beside = distance[[low - 1 - near, low - 1, high, high + near]]
            found[low:high] = np.diff(beside).max() <= ROLLED_M
    return found


def _guesses(bridged: BoolArray, miscounted: BoolArray, step: float) -> BoolArray:
    """Return which ``bridged`` bins are of a loss that is no moment, or of a leap, shape (n,)."""
    found = np.zeros(bridged.size, np.bool_)
    for low, high in _spans(bridged):
        long = high - low > MOMENT_S / step
        found[low:high] = long or miscounted[low:high].any()
    return found


def _beside(known: IndexArray, place: int, most: int) -> tuple[IndexArray, IndexArray]:
    """Return the last ``most`` of ``known`` before a ``place`` and the first behind it."""
    at = int(np.searchsorted(known, place))
    return known[max(at - most, 0) : at], known[at : at + most]


def _spans(marked: BoolArray) -> Iterator[tuple[int, int]]:
    """Give the first of each run of ``marked`` and the one behind it."""
    edges = np.flatnonzero(np.diff(marked, prepend=False, append=False))
    yield from zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)
