"""What the Kalman filter observes when: GNSS, constants in its place, the height at a stop."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from floatref.kernels.kalman_layout import (
    CAPTURE,
    KINDS,
    OBSERVATION,
    REFLECTED,
    RELATIVE,
    RENEW,
    TRUSTED,
)
from floatref.stages.kalman.noise import Noise
from floatref.values.arrays import BoolArray, FloatArray, IndexArray

PATIENCE_S = 0.5
"""Without a usable GNSS reading for so long, constants take its place."""
READING_S = 0.045
"""GNSS readings at shorter intervals count for less: their errors are those of the one before."""
DATUM_M = 100.0
"""1-σ of a new datum of the GNSS height, after an outage."""
NEVER = -(1 << 40)


@dataclass(frozen=True)
class Plan:
    """Which references a variant of chapter 6 uses.

    Attributes:
        gnss: height and velocity from GNSS, else constants (6.65).
        attitude: pitch and roll from GNSS, else constants (6.62).
        reflects: the height sensor below ``reflection_speed_mps`` in place of GNSS (6.58-6.61).
    """

    gnss: bool = True
    attitude: bool = True
    reflects: bool = True
    reflection_speed_mps: float = 0.16 / 3.6


@dataclass(frozen=True, eq=False)
class Stretch:
    """Samples ``first`` on: which of them stand still, the height, and where it is there.

    ``readings``, shape (m, 5), are usable GNSS readings: height, velocity, pitch, roll, and the
    interval from the reading before in s; ``taken`` their samples.
    """

    first: int
    standing: BoolArray
    height: FloatArray
    there: BoolArray
    taken: IndexArray
    readings: FloatArray

    def part(self, begin: int, end: int) -> "Stretch":
        """Return the samples from number ``begin`` of this stretch up to ``end``."""
        low, high = self.first + begin, self.first + end
        taken = slice(*np.searchsorted(self.taken, (low, high)))
        return Stretch(
            low,
            self.standing[begin:end],
            self.height[begin:end],
            self.there[begin:end],
            self.taken[taken],
            self.readings[taken],
        )


Chunk = tuple[IndexArray, IndexArray, FloatArray]
"""Samples (m,), marks (m,), and values with variances (m, 9) of observations in order."""


@dataclass
class References:
    """The observations of one wheel path, in the order of time.

    What it remembers depends on samples that came before, never on how they were split.
    ``start_m`` is the filter's first height, ``arm_m`` how far the antenna is above the
    reference point.
    """

    plan: Plan
    noise: Noise
    sub_block: int
    step: float
    start_m: float
    arm_m: float
    datum: float = np.nan
    latest: int = 0
    height: float = np.nan
    origin: float = np.nan
    constant: bool = False
    still: bool = False
    stood: int = 0

    def schedule(self, stretch: Stretch) -> Chunk:
        """Return the observations of ``stretch``, which follows the one before."""
        chunks = [c for run in _runs(stretch, self.plan.reflects) for c in self._of_run(*run)]
        return _joined(chunks)

    def _of_run(self, stretch: Stretch, standing: bool) -> Iterator[Chunk]:
        if standing:
            yield from self._standing(stretch)
        else:
            yield from self._moving(stretch)
        self.still = standing

    def _moving(self, stretch: Stretch) -> Iterator[Chunk]:
        yield from self._satellites(stretch)
        there = np.flatnonzero(stretch.there)
        if there.size:
            self.height = float(stretch.height[there[-1]])

    def _standing(self, stretch: Stretch) -> Iterator[Chunk]:
        """Yield the height sensor's readings in place of heights, the rest as ever."""
        stood = self.stood
        beside = _joined(list(self._satellites(stretch)))
        beside[2][:, [0, -1]] = np.nan, 0.0
        self.stood = stood + stretch.height.size
        yield _merged(beside, self._reflections(stretch))

    def _satellites(self, stretch: Stretch) -> Iterator[Chunk]:
        """Yield GNSS readings, and constants where they are missing."""
        if self.plan.gnss:
            for at, reading in zip(stretch.taken.tolist(), stretch.readings, strict=True):
                yield from self._constants(stretch.first, at)
                yield self._reading(at, reading)
        yield from self._constants(stretch.first, stretch.first + stretch.height.size)

    def _reading(self, at: int, reading: FloatArray) -> Chunk:
        """Return a GNSS reading, its height from the datum of this wheel path, (6.48)."""
        if np.isnan(self.datum):
            self.datum = float(reading[0]) - self.arm_m - self.start_m
        moved = self._datum_variance()
        self.latest, self.constant, self.stood = at, False, 0
        y, interval_s = reading[:KINDS].copy(), float(reading[KINDS])
        y[0] -= self.datum
        variance = self.noise.readings()
        if interval_s < READING_S:
            variance *= 0.05 / interval_s
        if not self.plan.attitude:
            y[2:] = 0.0
            variance[2:] = self.noise.constants(max(interval_s, READING_S))[2:]
        return _chunk(np.array([at]), 0, y, variance, moved)

    def _datum_variance(self) -> float:
        """Return by how much the datum of the GNSS height may have moved since the last reading.

        A stop hides its drift; after an outage, another satellite or base may carry it.
        """
        if self.constant:
            return DATUM_M**2
        return self.noise.gnss_height_walk**2 * self.stood * self.step

    def _constants(self, first: int, end: int) -> Iterator[Chunk]:
        """Yield what stands in for GNSS before sample ``end``, once per sub-block, (6.65)."""
        begin = first
        if self.plan.gnss:
            begin = max(first, self.latest + round(PATIENCE_S / self.step))
        at = self._ends(begin, end)
        if at.size == 0:
            return
        variance = self.noise.constants(self.sub_block * self.step)
        chunk = _chunk(at, RELATIVE | TRUSTED, np.zeros(KINDS), variance)
        if not self.constant:
            chunk[1][0] |= CAPTURE
        self.constant = True
        yield chunk

    def _ends(self, begin: int, end: int) -> IndexArray:
        """Return the samples from ``begin`` up to ``end`` that end a sub-block."""
        return np.arange(-(-begin // self.sub_block) * self.sub_block, end, self.sub_block)

    def _reflections(self, stretch: Stretch) -> Chunk:
        """Return the readings of the height sensor as its own motion, (6.58)-(6.60)."""
        at = self._ends(stretch.first, stretch.first + stretch.height.size)
        at = at[stretch.there[at - stretch.first]]
        if at.size == 0:
            return _joined([])
        height = stretch.height[at - stretch.first]
        begins = not self.still or np.isnan(self.origin)
        if begins:
            self.origin = float(height[0]) if np.isnan(self.height) else self.height
        y = np.full((at.size, KINDS), np.nan)
        y[:, 0] = height - self.origin
        chunk = _chunk(at, TRUSTED | REFLECTED, y, self.noise.readings())
        chunk[2][:, KINDS] = self.noise.reflection**2 / (self.sub_block * self.step)
        if begins:
            chunk[1][0] |= RENEW
        return chunk


def _runs(stretch: Stretch, reflects: bool) -> Iterator[tuple[Stretch, bool]]:
    """Yield the parts of ``stretch`` that stand still, or do not, in turn."""
    if not reflects or not stretch.standing.any():
        yield stretch, False
        return
    edges = np.flatnonzero(np.diff(stretch.standing)) + 1
    for begin, end in pairwise([0, *edges.tolist(), stretch.standing.size]):
        yield stretch.part(begin, end), bool(stretch.standing[begin])


def _chunk(
    at: IndexArray, mark: int, y: FloatArray, variance: FloatArray, moved: float = 0.0
) -> Chunk:
    rows = np.empty((at.size, OBSERVATION))
    rows[:, :KINDS], rows[:, KINDS:-1], rows[:, -1] = y, variance, moved
    return at, np.full(at.size, mark), rows


def _merged(one: Chunk, other: Chunk) -> Chunk:
    """Return both in the order of time; what comes at one sample becomes one observation."""
    at = np.union1d(one[0], other[0])
    marks, rows = np.zeros(at.size, np.int64), np.full((at.size, OBSERVATION), np.nan)
    rows[:, -1] = 0.0
    for times, mark, row in (one, other):
        place = np.searchsorted(at, times)
        marks[place] |= mark
        rows[place] = np.where(np.isnan(row), rows[place], row)
    return at, marks, rows


def _joined(chunks: list[Chunk]) -> Chunk:
    if not chunks:
        return np.empty(0, np.int64), np.empty(0, np.int64), np.empty((0, OBSERVATION))
    at, marks, rows = zip(*chunks, strict=True)
    return np.concatenate(at), np.concatenate(marks), np.concatenate(rows)
