"""The road-prior filter of one wheel path, fed block by block."""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from floatref.estimators.models.road_prior_values import (
    CLEARANCE,
    ENDS,
    HEIGHT,
    MEMORY,
    NODE,
    STATES,
    UPDATE,
    Filter,
    Inputs,
    Model,
    Output,
)
from floatref.estimators.road_prior.constants import RoadPrior
from floatref.estimators.road_prior.leaps import Leap, changes, leaps
from floatref.estimators.road_prior.learned import BOTH, Brake
from floatref.estimators.road_prior.misfits import Misfits
from floatref.estimators.road_prior.spectrum import RoadSpectrum
from floatref.estimators.smoothing.nodes import Kind, Nodes
from floatref.values.arrays import FloatArray, Records, new_record

NODES = Kind(NODE, UPDATE, np.eye(STATES), np.eye(STATES))
"""The road makes every state known in time, at a stop as well."""
NODES_PER_S = 500.0
"""A node every 32 samples at 16 kHz."""
RENEWAL = 500
"""Nodes after which the spectrum of the road is renewed by that of the road so far."""


def sub_block(step: float) -> int:
    """Return how many samples of ``step`` in s lie between two nodes."""
    return max(1, round(1.0 / (NODES_PER_S * step)))


@dataclass(eq=False)
class RoadTrack:
    """State and covariance of the filter of one wheel path.

    Attributes:
        model: what sensors, vehicle and road are taken for at present.
        state: x, P and what goes from sample to sample.
        spectrum: of the road that it has gone.
        bends: how far the road bends, in m, from which sample on.
        reading_m2: least variance of a reading of the height sensor, in m².
        brakes: estimates of lean and tilt, one per brake.
        leaps: of the height sensor at standstills.
        misfits: normalized innovations, if they are kept.
    """

    model: Model
    state: Filter
    spectrum: RoadSpectrum
    bends: list[tuple[int, float]]
    reading_m2: float
    brakes: list[Brake] = field(default_factory=list)
    leaps: list[Leap] = field(default_factory=list)
    misfits: Misfits | None = None

    @classmethod
    def of(cls, constants: RoadPrior, step: float, start_m: float) -> "RoadTrack":
        """Return the filter before its first sample, at the height ``start_m``."""
        model = constants.model(step, sub_block(step))
        state = Filter(np.zeros(STATES), constants.start(), new_record(MEMORY))
        # The road begins at 0.
        state.x[HEIGHT] = state.x[CLEARANCE] = state.memory.height = start_m
        state.x[BOTH] = constants.lean_expected_rad, constants.tilt_expected
        spectrum = RoadSpectrum.of(constants, step * model.sub_block)
        return cls(model, state, spectrum, [(0, spectrum.bend_m)], model.reading)

    def advance(self, u: Inputs) -> tuple[FloatArray, Nodes]:
        """Return the heights integrated from the accelerations of ``u``, in m, and the nodes."""
        a, first, ends = u.acceleration, u.first, u.ends
        height, room = np.empty(a.size), Nodes.room(NODES, len(ends), len(ends))
        found = room.take_first(0)
        roads, brakes = self._changes(first, a.size, ends)
        cuts = sorted({first, *roads, *brakes, first + a.size})
        for low, high in pairwise(cuts):
            if low in roads:
                self._renew_road(low)
            if low in brakes:
                self.brakes = self.all_brakes()
            count = -(-high // self.model.sub_block) - -(-low // self.model.sub_block)
            inside = slice(low - first, high - first)
            part = Inputs(low, a[inside], ends[:count])
            found = room.grow(found, self._advance(part, height[inside], room.behind(found)))
            ends = ends[count:]
        return height, found

    @property
    def height_m(self) -> float:
        """The filtered height at the latest node."""
        return float(self.state.x[HEIGHT])

    def _renew_road(self, sample: int) -> None:
        """Take the road from ``sample`` on for what it has been."""
        road, slope = self.spectrum.road().tolist()
        reading = max(self.reading_m2, self.spectrum.reading_m2())
        self.model = self.model._replace(road=road, slope=slope, reading=reading)
        self.bends.append((sample, self.spectrum.bend_m))

    def all_brakes(self) -> list[Brake]:
        """Return the brakes with an estimate of lean and tilt, also the one not yet ended."""
        latest = Brake.of(self.state.x, self.state.p)
        news = latest.tells(np.array([self.model.lean_prior, self.model.tilt_prior]))
        return [*self.brakes, latest] if news else self.brakes

    def _changes(self, first: int, size: int, ends: Records) -> tuple[set[int], set[int]]:
        """Return samples at which the road is renewed, and before which a brake has ended.

        The latter follow the node before the one where lean and tilt begin anew.
        """
        every = self.model.sub_block * RENEWAL
        nodes = -(-first // self.model.sub_block) + np.flatnonzero(ends["anew"] > 0.0)
        behind = np.maximum((nodes - 1) * self.model.sub_block + 1, first)
        return {*range(first + -first % every, first + size, every)}, {*behind.tolist()}

    def _advance(self, u: Inputs, height: FloatArray, nodes: Nodes) -> Nodes:
        """Return those of the room ``nodes`` that the filter fills by ``u``."""
        from floatref.estimators.road_prior import forward

        out = Output(height, nodes.rows, nodes.updates)
        found = nodes.take_first(forward.run(self.model, u, self.state, out))
        elevation = height[found.at - u.first] - u.ends["seen"]
        self.spectrum.add(elevation, u.ends["travel"].copy(), changes(found, u.ends))
        self.leaps += leaps(found, u.ends, self.model.edge)
        if self.misfits is not None:
            self.misfits.add(found, u.ends)
        return found

    def bends_of(self, first: int, size: int) -> FloatArray:
        """Return how far the road bends at samples from ``first`` on, in m; earlier ones go."""
        while len(self.bends) > 1 and self.bends[1][0] <= first:
            self.bends.pop(0)
        begins, values = zip(*self.bends, strict=True)
        ends = np.clip([*begins[1:], first + size], first, first + size)
        return np.repeat(values, np.diff(ends, prepend=first))

    def end(self, at: int, travel_m: float) -> Nodes:
        """Return a node at sample ``at``, the last; empty if it is one already."""
        from floatref.estimators.road_prior import forward

        known, memory = new_record(ENDS), self.state.memory
        known.leaning, known.tilting, known.along = memory.leaning, memory.tilting, memory.along
        known.travel, known.seen = travel_m, np.nan
        nodes = Nodes.room(NODES, 1, 1)
        count = forward.end(self.model, at, known, self.state, nodes.rows, nodes.updates)
        return nodes.take_first(count)
