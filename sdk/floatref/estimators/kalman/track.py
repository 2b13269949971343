"""The forward filter of one wheel path, fed stretch by stretch."""

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from floatref.estimators.kalman.layout import KINDS, LATEST, MEMORY, STATES
from floatref.estimators.kalman.nodes import KalmanNodes
from floatref.estimators.kalman.noise import Noise
from floatref.estimators.kalman.observations import Chunk
from floatref.estimators.kalman.references import DATUM_M, Plan, References, Stretch
from floatref.values.arrays import BoolArray, FloatArray, frozen
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Vector

NODES_PER_S = 100.0
"""Sub-blocks of 160 samples at 16 kHz: long enough that covariances cost next to nothing."""
START_SIGMA = (1.0, 1.0, 0.1, 0.1, 0.1, 0.01, 0.01)
"""1-σ of the first state: height, velocity, pitch, roll, and biases, in SI units."""
WHITE = 5
"""Place of the acceleration's density, squared, in the model."""
FLOORS = (0.2, 0.5, np.radians(3.0), np.radians(3.0))
"""Innovations of GNSS readings up to here are taken, however small the filter expects them."""

Inputs = tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]


def sub_block(step: float) -> int:
    """Return how many samples of ``step`` in s a sub-block has."""
    return max(1, round(1.0 / (NODES_PER_S * step)))


class Passed(NamedTuple):
    """Filtered height in m, nodes, and whether samples of the inputs were missing."""

    height: FloatArray
    nodes: KalmanNodes
    missing: bool


@dataclass(eq=False)
class TrackFilter:
    """State, covariance and references of the filter of one wheel path.

    Inputs are specific force along X, Y, Z in m/s² and rates about X, Y, Z in rad/s, (6.47). Up to
    sample ``lost_until`` the density of the acceleration is the root of ``lost_white``.
    """

    model: FloatArray
    sub_block: int
    references: References
    x: FloatArray
    p: FloatArray
    memory: FloatArray
    lost_white: float
    lost_until: int = -1

    @classmethod
    def of(
        cls, plan: Plan, noise: Noise, step: float, arm: Vector, start_m: float
    ) -> "TrackFilter":
        """Return the filter before its first sample; ``arm`` leads to the antenna, in m."""
        length = sub_block(step)
        references = References(plan, noise, length, step, start_m, arm[2])
        model = np.array(
            [
                step,
                STANDARD_GRAVITY,
                *arm,
                *noise.process(),
                DATUM_M**2,
                *FLOORS,
                noise.lean_rad**2,
            ]
        )
        x, memory = np.zeros(STATES), np.zeros(MEMORY)
        x[0] = start_m
        return cls(
            model,
            length,
            references,
            x,
            np.diag(np.square([*START_SIGMA, noise.lean_rad, 0.0, 0.0])),
            memory,
            noise.missing_acceleration**2,
        )

    def advance(self, u: Inputs, stretch: Stretch, lost: BoolArray | None = None) -> Passed:
        """Filter ``stretch``; what is missing of the inputs, as NaN, is zero.

        At samples ``lost`` there was no vertical acceleration for long: little is known behind.
        """
        schedule = self.references.schedule(stretch)
        parts = self._parts(stretch.first, stretch.height.size, lost)
        begun = self.x.copy(), self.p.copy(), self.memory.copy()
        height, nodes = self._filtered(u, stretch.first, schedule, parts)
        # A NaN in any input stays in the state: to look for it there takes no time.
        missing = bool(np.isnan(self.x.sum() + self.memory.sum()))
        if missing:
            self.x, self.p, self.memory = begun
            x, y, z, roll, pitch, yaw = (frozen(np.nan_to_num(values)) for values in u)
            known = (x, y, z, roll, pitch, yaw)
            height, nodes = self._filtered(known, stretch.first, schedule, parts)
        return Passed(height, nodes, missing)

    def _parts(self, first: int, size: int, lost: BoolArray | None) -> list[tuple[int, int, bool]]:
        """Return parts, and whether acceleration is lost in each: up to the next node."""
        if lost is None and self.lost_until < first:
            return [(0, size, False)]
        noisy = np.zeros(size + 1, np.bool_)
        noisy[: max(0, self.lost_until + 1 - first)] = True
        for sample in [] if lost is None else (first + np.flatnonzero(lost)).tolist():
            self.lost_until = -(-sample // self.sub_block) * self.sub_block
            noisy[sample - first : self.lost_until + 1 - first] = True
        noisy = noisy[:size]
        edges = [0, *(np.flatnonzero(noisy[1:] != noisy[:-1]) + 1).tolist(), size]
        return [(begin, end, bool(noisy[begin])) for begin, end in pairwise(edges)]

    def _filtered(
        self, u: Inputs, first: int, schedule: Chunk, parts: list[tuple[int, int, bool]]
    ) -> tuple[FloatArray, KalmanNodes]:
        if len(parts) == 1:
            return self._run(u, first, schedule, parts[0][2])
        found = []
        for begin, end, lost in parts:
            x, y, z, roll, pitch, yaw = (values[begin:end] for values in u)
            low, high = np.searchsorted(schedule[0], (first + begin, first + end))
            at, marks, rows = schedule
            part = at[low:high], marks[low:high], rows[low:high]
            own = (x, y, z, roll, pitch, yaw)
            found.append(self._run(own, first + begin, part, lost))
        heights, nodes = zip(*found, strict=True)
        return np.concatenate(heights), KalmanNodes.joined(nodes)

    def _run(
        self, u: Inputs, first: int, schedule: Chunk, lost: bool
    ) -> tuple[FloatArray, KalmanNodes]:
        from floatref.estimators.kalman import forward

        at, marks, rows = schedule
        model = self.model.copy()
        if lost:
            model[WHITE] = self.lost_white
        height = np.empty(u[0].size)
        room = height.size // self.sub_block + at.size + 2
        nodes = KalmanNodes.room(room, KINDS * at.size)
        count = forward.run(
            u,
            first,
            self.sub_block,
            model,
            at,
            marks,
            rows,
            self.x,
            self.p,
            self.memory,
            height,
            nodes.at,
            nodes.rows,
            nodes.updates,
        )
        return height, nodes.filled(count)

    def end(self) -> KalmanNodes:
        """Return a node at the sample advanced to last, or none if it is one already."""
        from floatref.estimators.kalman import forward

        nodes = KalmanNodes.room(1, 0)
        count = forward.end(self.model, self.x, self.p, self.memory, nodes.at, nodes.rows)
        return nodes.filled(count)

    def beyond(self) -> FloatArray:
        """Return lambda behind the last node, which `end` has made: what constants tell there."""
        from floatref.estimators.kalman import forward

        y, variance = self.references.ending(int(self.memory[LATEST]))
        h, expected = np.empty((KINDS, STATES)), np.empty(KINDS)
        forward.expect(self.model, self.x, self.memory, h, expected)
        told = ~np.isnan(y)
        rows = h[told]
        spread = rows @ self.p @ rows.T + np.diag(variance[told])
        return -rows.T @ np.linalg.solve(spread, (y - expected)[told])
