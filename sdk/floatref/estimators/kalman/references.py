"""What the Kalman filter observes when: GNSS, constants in its place, the height at a stop."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from floatref.estimators.kalman.noise import Noise
from floatref.estimators.kalman.observations import (
    join_observations,
    mark_sample,
    merge,
    observations_of,
)
from floatref.estimators.models.kalman_values import (
    CAPTURE,
    FORGET,
    HEIGHT,
    KINDS,
    PITCH,
    REFLECTED,
    RELATIVE,
    RENEW,
    TRUSTED,
    Observations,
)
from floatref.values.arrays import BoolArray, FloatArray, IndexArray

PATIENCE_S = 0.5
"""Without a usable GNSS reading for so long, constants take its place."""
READING_S = 0.045
"""GNSS readings at shorter intervals count for less: their errors are those of the one before."""
USUAL_S = 0.05
"""Interval behind the errors of a reading in Table 6.1."""
DATUM_M = 100.0
"""1-σ of a new datum of the GNSS height, after an outage."""


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
    """Samples ``first`` on: which of them are stationary, the height, and where it is there.

    ``readings``, shape (m, 5), are usable GNSS readings: height, velocity, pitch, roll, and the
    interval from the reading before in s; ``taken`` their samples; at samples ``quiet`` the
    vehicle has been travelling at a constant speed.
    """

    first: int
    standing: BoolArray
    height: FloatArray
    there: BoolArray
    taken: IndexArray
    readings: FloatArray
    quiet: IndexArray

    def part(self, begin: int, end: int) -> "Stretch":
        """Return the samples from number ``begin`` of this stretch up to ``end``."""
        low, high = self.first + begin, self.first + end
        taken, quiet = (slice(*np.searchsorted(at, (low, high))) for at in (self.taken, self.quiet))
        return Stretch(
            low,
            self.standing[begin:end],
            self.height[begin:end],
            self.there[begin:end],
            self.taken[taken],
            self.readings[taken],
            self.quiet[quiet],
        )


@dataclass
class References:
    """The observations of one wheel path, in the order of time: (6.48), (6.58) and (6.65).

    What it remembers depends on samples that came before, never on how they were split.

    Attributes:
        sub_block, step: samples of a sub-block, and the time of one in s.
        start_m: the filter's first height.
        arm_m: how far the antenna is above the reference point.
        datum: height from which GNSS heights are measured, in m; the first reading sets it.
        latest, observed: sample of the latest reading, and of the latest whose height was observed.
        constant: whether constants have been observed since then.
        origin: what the height sensor read where the stop began, in m; NaN while moving.
        last: sample and mark of the latest observation.
    """

    plan: Plan
    noise: Noise
    sub_block: int
    step: float
    start_m: float
    arm_m: float
    datum: float = np.nan
    latest: int = 0
    observed: int = 0
    constant: bool = False
    origin: float = np.nan
    last: tuple[int, int] = (0, 0)

    def schedule(self, stretch: Stretch) -> Observations:
        """Return the observations of ``stretch``, which follows the one before."""
        parts = []
        for part, standing in _runs(stretch, self.plan.reflects):
            parts.append(self._observe_standing(part) if standing else self._observe_moving(part))
        found = parts[0] if len(parts) == 1 else join_observations(parts)
        observed = np.flatnonzero(found.marks != FORGET)[-1:]
        if observed.size:
            self.last = int(found.at[observed[0]]), int(found.marks[observed[0]])
        return found

    def ending(self, end: int) -> tuple[FloatArray, FloatArray]:
        """Return what to observe at sample ``end``, the last: values and variances, shape (4,).

        Constants count for half a sub-block before them and half a one behind. A variance below
        zero takes back what the last ones have counted too much: the sum is that of all samples,
        by trapezoids. NaN if there is nothing to observe.
        """
        y, variance = np.full((2, KINDS), np.nan)
        at, mark = self.last
        behind = end - at
        weight = 0.5 * (2 * behind + 1 - self.sub_block)
        if mark & RELATIVE and behind < self.sub_block and weight:
            y, variance = np.zeros(KINDS), self.noise.constants(weight * self.step)
            y[HEIGHT] = np.nan if mark & REFLECTED else 0.0
        return y, variance

    def _observe_moving(self, stretch: Stretch) -> Observations:
        self.origin = np.nan
        observed = self._observe(stretch, heights=True)
        for sample in stretch.quiet.tolist():
            observed = mark_sample(observed, sample, FORGET)
        return observed

    def _observe_standing(self, stretch: Stretch) -> Observations:
        """Return the height sensor's readings in place of heights, the rest as ever."""
        beside = self._observe(stretch, heights=False)
        beside.values[:, HEIGHT], beside.drifted[:] = np.nan, 0.0
        return merge(beside, self._reflections(stretch))

    def _observe(self, stretch: Stretch, heights: bool) -> Observations:
        """Return GNSS readings, and constants where they are missing."""
        end, taken = stretch.first + stretch.height.size, stretch.taken
        if not self.plan.gnss:
            return self._constants(stretch.first, end)
        patience = round(PATIENCE_S / self.step)
        edges = np.concatenate(([self.latest], taken, [end]))
        lost = np.flatnonzero(np.diff(edges) > patience)
        again = lost[lost < taken.size].tolist() + ([0] if self.constant and taken.size else [])
        readings = self._readings(stretch, heights, again)
        gaps = []
        for k in lost:
            self.constant = self.constant and not (heights and k > 0)
            begin = max(stretch.first, int(edges[k]) + patience)
            gaps.append(self._constants(begin, int(edges[k + 1])))
        if heights and taken.size and taken.size not in lost:
            self.constant = False
        self.latest = int(edges[-2])
        return merge(readings, join_observations(gaps)) if gaps else readings

    def _readings(self, stretch: Stretch, heights: bool, again: list[int]) -> Observations:
        """Return the GNSS readings, heights from the datum of this wheel path, (6.48).

        The datum may have moved slowly since the reading before, and anywhere in an outage, behind
        which the readings ``again`` come.
        """
        at, interval_s = stretch.taken, stretch.readings[:, KINDS]
        if at.size == 0:
            return join_observations([])
        if np.isnan(self.datum):
            self.datum = float(stretch.readings[0, HEIGHT]) - self.arm_m - self.start_m
        y = stretch.readings[:, :KINDS] - [self.datum, 0.0, 0.0, 0.0]
        crowded = np.where(interval_s < READING_S, USUAL_S / interval_s, 1.0)
        variance = self.noise.readings() * crowded[:, None]
        if not self.plan.attitude:
            y[:, PITCH:] = 0.0
            variance[:, PITCH:] = self.noise.constants(USUAL_S)[PITCH:] * crowded[:, None]
        moved = self.noise.gnss_height_walk**2 * np.diff(at, prepend=self.observed) * self.step
        moved[again] = DATUM_M**2
        self.observed = int(at[-1]) if heights else self.observed
        return observations_of(at, 0, y, variance, moved)

    def _constants(self, begin: int, end: int) -> Observations:
        """Return what replaces GNSS from ``begin`` up to ``end``, per sub-block, (6.65)."""
        at = self._ends(begin, end)
        if at.size == 0:
            return join_observations([])
        weight = np.where(at == 0, 0.5 * (self.sub_block + 1), self.sub_block)
        variance = self.noise.constants(1.0) / (weight * self.step)[:, None]
        found = observations_of(at, RELATIVE | TRUSTED, np.zeros(KINDS), variance)
        if not self.constant:
            found.marks[0] |= CAPTURE
        self.constant = True
        return found

    def _ends(self, begin: int, end: int) -> IndexArray:
        """Return the samples from ``begin`` up to ``end`` that end a sub-block."""
        return np.arange(-(-begin // self.sub_block) * self.sub_block, end, self.sub_block)

    def _reflections(self, stretch: Stretch) -> Observations:
        """Return the readings of the height sensor as its own motion, (6.58)-(6.60)."""
        at = self._ends(stretch.first, stretch.first + stretch.height.size)
        at = at[stretch.there[at - stretch.first]]
        if at.size == 0:
            return join_observations([])
        height = stretch.height[at - stretch.first]
        begins = np.isnan(self.origin)
        if begins:
            self.origin = float(height[0])
        y = np.full((at.size, KINDS), np.nan)
        y[:, HEIGHT] = height - self.origin
        variance = np.full(KINDS, np.nan)
        variance[HEIGHT] = self.noise.reflection**2 / (self.sub_block * self.step)
        found = observations_of(at, TRUSTED | REFLECTED, y, variance)
        if begins:
            found.marks[0] |= RENEW
        return found


def _runs(stretch: Stretch, reflects: bool) -> Iterator[tuple[Stretch, bool]]:
    """Yield the parts of ``stretch`` that are stationary, or are not, in turn."""
    if not reflects or not stretch.standing.any():
        yield stretch, False
        return
    edges = np.flatnonzero(np.diff(stretch.standing)) + 1
    for begin, end in pairwise([0, *edges.tolist(), stretch.standing.size]):
        yield stretch.part(begin, end), bool(stretch.standing[begin])
