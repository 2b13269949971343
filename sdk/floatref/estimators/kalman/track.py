"""The forward filter of one wheel path, fed stretch by stretch."""

from copy import deepcopy
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from floatref.estimators.kalman.noise import Noise
from floatref.estimators.kalman.normalized import NormalizedInnovations
from floatref.estimators.kalman.observations import part
from floatref.estimators.kalman.references import DATUM_M, Plan, References, Stretch
from floatref.estimators.models.kalman_values import (
    DRIFT,
    HEIGHT,
    KINDS,
    MEMORY,
    NODE,
    OFFSET,
    STATES,
    UPDATE,
    Filter,
    Inputs,
    Model,
    Observations,
    Output,
)
from floatref.estimators.smoothing.nodes import Kind, Nodes
from floatref.values.arrays import BoolArray, FloatArray, frozen, new_record
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Vector

NODES_PER_S = 100.0
"""Sub-blocks of 160 samples at 16 kHz: long enough that covariances cost very little."""
START_SIGMA = (1.0, 1.0, 0.1, 0.1, 0.1, 0.01, 0.01)
"""1-σ of the first state: height, velocity, pitch, roll, and biases, in SI units."""
FLOORS = (0.2, 0.5, np.radians(3.0), np.radians(3.0))
"""Innovations of GNSS readings up to here are taken, however small the filter expects them."""
KNOWN = np.delete(np.eye(STATES), (DRIFT, OFFSET), axis=0)
"""What later readings can show of the state at last: never the height but with GNSS's drift."""
KNOWN[HEIGHT, DRIFT] = 1.0
STANDING = np.eye(STATES)[HEIGHT] + np.eye(STATES)[OFFSET]
"""At a stop also how far the height is from where the stop began."""
NODES = Kind(NODE, UPDATE, KNOWN, np.vstack([KNOWN, STANDING]))


def sub_block(step: float) -> int:
    """Return how many samples of ``step`` in s a sub-block has."""
    return max(1, round(1.0 / (NODES_PER_S * step)))


class Passed(NamedTuple):
    """Filtered height in m, nodes, and whether samples of the inputs were missing."""

    height: FloatArray
    nodes: Nodes
    missing: bool


@dataclass(eq=False)
class TrackFilter:
    """State, covariance and references of the filter of one wheel path.

    Inputs are specific force along X, Y, Z in m/s² and rates about X, Y, Z in rad/s, (6.47). Up to
    sample ``lost_until`` the density of the acceleration is the root of ``lost_white``.
    ``innovations`` are None unless they are kept.
    """

    model: Model
    references: References
    state: Filter
    lost_white: float
    lost_until: int = -1
    innovations: NormalizedInnovations | None = None

    @classmethod
    def of(
        cls, plan: Plan, noise: Noise, step: float, arm: Vector, start_m: float
    ) -> "TrackFilter":
        """Return the filter before its first sample; ``arm`` leads to the antenna, in m."""
        length = sub_block(step)
        white, roll, pitch, yaw, walk, walk_roll, walk_pitch = noise.process().tolist()
        model = Model(
            step,
            length,
            STANDARD_GRAVITY,
            *arm,
            *(white, roll, pitch, yaw),
            *(walk, walk_roll, walk_pitch),
            datum=DATUM_M**2,
            floors=np.array(FLOORS),
            lean=noise.lean_rad**2,
        )
        state = Filter(
            np.zeros(STATES),
            np.diag(np.square([*START_SIGMA, noise.lean_rad, 0.0, 0.0])),
            new_record(MEMORY),
        )
        state.x[HEIGHT] = start_m
        references = References(plan, noise, length, step, start_m, arm[2])
        return cls(model, references, state, noise.missing_acceleration**2)

    def advance(self, u: Inputs, stretch: Stretch, lost: BoolArray | None = None) -> Passed:
        """Filter ``stretch``; what is missing of the inputs, as NaN, is zero.

        At samples ``lost`` there was no vertical acceleration for long: little is known behind.
        """
        schedule = self.references.schedule(stretch)
        parts = self._parts(stretch.first, stretch.height.size, lost)
        begun = deepcopy(self.state)
        height, nodes = self._filter(u, schedule, parts)
        # A NaN in any input stays in the state: to look for it there takes no time.
        missing = bool(np.isnan(self.state.x.sum()) or _latest_is_missing(self.state.memory))
        if missing:
            self.state = begun
            known = Inputs(u.first, *(frozen(np.nan_to_num(values)) for values in u[1:]))
            height, nodes = self._filter(known, schedule, parts)
        if self.innovations is not None:
            self.innovations.add(nodes, schedule)
        return Passed(height, nodes, missing)

    def _parts(self, first: int, size: int, lost: BoolArray | None) -> list[tuple[int, int, bool]]:
        """Return parts, and whether acceleration is lost in each: up to the next node."""
        if lost is None and self.lost_until < first:
            return [(0, size, False)]
        noisy = np.zeros(size + 1, np.bool_)
        noisy[: max(0, self.lost_until + 1 - first)] = True
        for sample in [] if lost is None else (first + np.flatnonzero(lost)).tolist():
            self.lost_until = -(-sample // self.model.sub_block) * self.model.sub_block
            noisy[sample - first : self.lost_until + 1 - first] = True
        noisy = noisy[:size]
        edges = [0, *(np.flatnonzero(noisy[1:] != noisy[:-1]) + 1).tolist(), size]
        return [(begin, end, bool(noisy[begin])) for begin, end in pairwise(edges)]

    def _filter(
        self, u: Inputs, schedule: Observations, parts: list[tuple[int, int, bool]]
    ) -> tuple[FloatArray, Nodes]:
        if len(parts) == 1:
            return self._run(u, schedule, parts[0][2])
        found = []
        for begin, end, lost in parts:
            own = Inputs(u.first + begin, *(values[begin:end] for values in u[1:]))
            low, high = np.searchsorted(schedule.at, (u.first + begin, u.first + end))
            found.append(self._run(own, part(schedule, slice(low, high)), lost))
        heights, nodes = zip(*found, strict=True)
        return np.concatenate(heights), Nodes.concatenate(nodes)

    def _run(self, u: Inputs, schedule: Observations, lost: bool) -> tuple[FloatArray, Nodes]:
        from floatref.estimators.kalman import forward

        model = self.model._replace(white=self.lost_white) if lost else self.model
        height, observed = np.empty(u.x.size), schedule.at.size
        nodes = Nodes.room(NODES, height.size // model.sub_block + observed + 2, KINDS * observed)
        out = Output(height, nodes.rows, nodes.updates)
        return height, nodes.take_first(forward.run(model, u, schedule, self.state, out))

    def end(self) -> Nodes:
        """Return a node at the sample advanced to last, empty if it is one already."""
        from floatref.estimators.kalman import forward

        nodes = Nodes.room(NODES, 1, 0)
        return nodes.take_first(forward.end(self.model, self.state, nodes.rows))

    def beyond(self) -> FloatArray:
        """Return lambda behind the last node, which `end` has made: by the constants there."""
        from floatref.estimators.kalman import forward

        y, variance = self.references.ending(int(self.state.memory.latest))
        h, expected = np.empty((KINDS, STATES)), np.empty(KINDS)
        forward.expect(self.model, self.state, h, expected)
        known = ~np.isnan(y)
        rows = h[known]
        spread = rows @ self.state.p @ rows.T + np.diag(variance[known])
        return -rows.T @ np.linalg.solve(spread, (y - expected)[known])


def _latest_is_missing(memory: np.record) -> bool:
    force, rates = (memory.x, memory.y, memory.z), (memory.roll_rate, memory.pitch_rate)
    return bool(np.isnan([*force, *rates, memory.yaw_rate]).any())
