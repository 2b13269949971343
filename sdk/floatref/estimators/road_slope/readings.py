"""What was read through a stretch, at time nodes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray, IndexArray

STANDING_MPS = 0.02
"""Speed below which a vehicle stands."""


class Drive(NamedTuple):
    """Bins of a whole run, each of shape (n,), for all wheel paths together.

    Attributes:
        force: vertical specific force less 1 g, in m/s², no value missing.
        missing: share of it that was, and is bridged.
        height: of the sensors, in m, NaN where a reading is missing.
        distance: of the encoder, in m.
        speed: in m/s.
        along: acceleration along the road, in m/s².
        lost: whether the encoder gave no distance, and it is bridged.
        step: in s from bin to bin.
    """

    force: FloatArray
    missing: FloatArray | BoolArray
    height: FloatArray
    distance: FloatArray
    speed: FloatArray
    along: FloatArray
    lost: BoolArray
    step: float


@dataclass(frozen=True, eq=False)
class Readings:
    """The knowns of docs/road-prior-slope.md at K time nodes, each of shape (K,).

    Attributes:
        bins: place of each node among the bins of the drive, halves between two.
        height: h, in m, NaN for no reading.
        force: F, in m/s².
        place: x of the laser, in m.
        speed: V, in m/s.
        along: a, in m/s².
        missing: share of the force that is missing.
        pause_s: time since the node before.
        interval_s: Δ.
    """

    bins: FloatArray
    height: FloatArray
    force: FloatArray
    place: FloatArray
    speed: FloatArray
    along: FloatArray
    missing: FloatArray
    pause_s: FloatArray
    interval_s: float

    @classmethod
    def of(cls, drive: Drive, pieces: Sequence[slice], interval_s: float) -> "Readings":
        """Return the nodes of ``pieces`` of the drive, about ``interval_s`` apart in each."""
        every = max(1, round(interval_s / drive.step))
        parts = [_reduce(drive, piece, every) for piece in pieces]
        joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
        pause_s = np.diff(joined["bins"], prepend=joined["bins"][0] - every) * drive.step
        return cls(**joined, pause_s=pause_s, interval_s=every * drive.step)

    def rested(self, least_s: float) -> BoolArray:
        """Return which steps from node to node end a standstill of ``least_s`` or more so far."""
        found, stood_s = np.zeros(self.speed.size - 1, np.bool_), 0.0
        for k in range(1, self.speed.size):
            still = max(self.speed[k - 1], self.speed[k]) < STANDING_MPS
            stood_s = stood_s + self.pause_s[k] if still else 0.0
            found[k - 1] = stood_s >= least_s - 1e-9
        return found

    @property
    def middles(self) -> IndexArray:
        """The nodes with a neighbour at Δ on both sides."""
        near = self.pause_s[1:] < 1.5 * self.interval_s
        return np.flatnonzero(near[:-1] & near[1:]) + 1


def _reduce(drive: Drive, piece: slice, every: int) -> dict[str, FloatArray]:
    """Return the means of ``every`` bins of ``piece``, by the names of `Readings`."""
    count = (piece.stop - piece.start) // every
    inside = slice(piece.start, piece.start + count * every)
    parts = {
        name: _mean(getattr(drive, of)[inside].reshape(count, every))
        for name, of in (
            ("height", "height"),
            ("place", "distance"),
            ("speed", "speed"),
            ("along", "along"),
            ("missing", "missing"),
        )
    }
    force = average_thrice(drive.force[inside], every)
    bins = piece.start + every * np.arange(count) + 0.5 * (every - 1)
    return {"bins": bins, "force": force, **parts}


def average_thrice(x: FloatArray, every: int) -> FloatArray:
    """Return ``x`` under three boxes of ``every`` bins, about the middle of each ``every`` bins.

    The window is 3 ``every`` - 2 wide; beyond the ends of ``x`` there is nothing.
    """
    box = np.full(every, 1.0 / every)
    window = np.convolve(np.convolve(box, box), box)
    found: FloatArray = np.convolve(x, window)[2 * every - 2 :: every]
    return found[: x.size // every]


def _mean(rows: FloatArray) -> FloatArray:
    """Return the mean of what is known in each row, NaN where nothing is."""
    known = ~np.isnan(rows)
    count = known.sum(axis=1)
    total = np.where(known, rows, 0.0).sum(axis=1)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)
