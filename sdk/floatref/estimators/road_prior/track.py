"""The road-prior filter of one wheel path, fed block by block."""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from floatref.estimators.road_prior.constants import RoadPrior
from floatref.estimators.road_prior.layout import (
    ANEW,
    BEFORE,
    EDGE,
    ENDS,
    LEAN_PRIOR,
    MEMORY,
    MODEL,
    READING,
    ROAD_STEP,
    SEEN,
    SLOPE_STEP,
    STATES,
    STILL,
    TILT_PRIOR,
    TRAVEL,
)
from floatref.estimators.road_prior.leaps import Leap, changes, leaps
from floatref.estimators.road_prior.learned import BOTH, Brake
from floatref.estimators.road_prior.nodes import RoadNodes
from floatref.estimators.road_prior.spectrum import RoadSpectrum
from floatref.values.arrays import FloatArray

NODES_PER_S = 500.0
"""A node every 32 samples at 16 kHz."""


RENEWAL = 500
"""After so many nodes the road is taken for what it has been."""


def sub_block(step: float) -> int:
    """Return how many samples of ``step`` in s lie between two nodes."""
    return max(1, round(1.0 / (NODES_PER_S * step)))


@dataclass(eq=False)
class RoadTrack:
    """State and covariance of the filter of one wheel path.

    Attributes:
        model, x, p, memory: see `road_prior_layout`.
        sub_block: samples between two nodes.
        spectrum: of the road that it has gone.
        bends: how far the road bends, in m, from which sample on.
        reading_m2: least variance of a reading of the height sensor, in m².
        brakes: what has been told of lean and tilt.
        leaps: of the height sensor at standstills.
    """

    model: FloatArray
    sub_block: int
    x: FloatArray
    p: FloatArray
    memory: FloatArray
    spectrum: RoadSpectrum
    bends: list[tuple[int, float]]
    reading_m2: float
    brakes: list[Brake] = field(default_factory=list)
    leaps: list[Leap] = field(default_factory=list)

    @classmethod
    def of(cls, constants: RoadPrior, step: float, start_m: float) -> "RoadTrack":
        """Return the filter before its first sample, at the height ``start_m``."""
        model = constants.model(step)
        assert model.size == MODEL
        x, memory = np.zeros(STATES), np.zeros(MEMORY)
        x[0] = memory[0] = start_m
        x[BOTH] = constants.lean_expected_rad, constants.tilt_expected
        spectrum = RoadSpectrum.of(constants, step * sub_block(step))
        begun = model, sub_block(step), x, constants.start(), memory
        return cls(*begun, spectrum, [(0, spectrum.bend_m)], float(model[READING]))

    def advance(self, a: FloatArray, first: int, ends: FloatArray) -> tuple[FloatArray, RoadNodes]:
        """Return the heights integrated from the accelerations ``a``, in m, and the nodes.

        ``ends`` has a row for each node, see `road_prior_layout`.
        """
        height, parts = np.empty(a.size), [RoadNodes.room(0, 0)]
        roads, brakes = self._changes(first, a.size, ends)
        cuts = sorted({first, *roads, *brakes, first + a.size})
        for low, high in pairwise(cuts):
            if low in roads:
                self.model[[ROAD_STEP, SLOPE_STEP]] = self.spectrum.road()
                self.model[READING] = max(self.reading_m2, self.spectrum.reading_m2())
                self.bends.append((low, self.spectrum.bend_m))
            if low in brakes:
                self.brakes = self.told()
            count = -(-high // self.sub_block) - -(-low // self.sub_block)
            inside = slice(low - first, high - first)
            parts.append(self._advance(a[inside], low, ends[:count], height[inside]))
            ends = ends[count:]
        return height, RoadNodes.joined(parts)

    def told(self) -> list[Brake]:
        """Return the brakes that have told of lean and tilt, with the one that has not ended."""
        latest = Brake.of(self.x, self.p)
        news = latest.tells(self.model[[LEAN_PRIOR, TILT_PRIOR]])
        return [*self.brakes, latest] if news else self.brakes

    def _changes(self, first: int, size: int, ends: FloatArray) -> tuple[set[int], set[int]]:
        """Return samples at which the road is renewed, and before which a brake has ended.

        The latter follow the node before the one where lean and tilt begin anew.
        """
        every = self.sub_block * RENEWAL
        nodes = -(-first // self.sub_block) + np.flatnonzero(ends[:, ANEW] > 0.0)
        behind = np.maximum((nodes - 1) * self.sub_block + 1, first)
        return {*range(first + -first % every, first + size, every)}, {*behind.tolist()}

    def _advance(
        self, a: FloatArray, first: int, ends: FloatArray, height: FloatArray
    ) -> RoadNodes:
        from floatref.estimators.road_prior import forward

        nodes = RoadNodes.room(len(ends), len(ends))
        kept = nodes.at, nodes.rows, nodes.updates
        state = self.x, self.p, self.memory
        count = forward.run(a, first, self.sub_block, self.model, ends, *state, height, *kept)
        found = nodes.filled(count)
        at = found.at[:, 0]
        elevation = height[at - first] - ends[:, SEEN]
        self.spectrum.add(elevation, ends[:, TRAVEL], changes(found, ends))
        self.leaps += leaps(found, ends, self.model[EDGE])
        return found

    def bends_of(self, first: int, size: int) -> FloatArray:
        """Return how far the road bends at samples from ``first`` on, in m; earlier ones go."""
        while len(self.bends) > 1 and self.bends[1][0] <= first:
            self.bends.pop(0)
        begins, values = zip(*self.bends, strict=True)
        found: FloatArray = np.array(values)[
            np.searchsorted(begins, np.arange(first, first + size), "right") - 1
        ]
        return found

    def end(self, at: int, travel_m: float) -> RoadNodes:
        """Return a node at sample ``at``, the last, or none if it is one already."""
        from floatref.estimators.road_prior import forward

        known = np.full(ENDS, np.nan)
        known[:3], known[3:] = self.memory[BEFORE:STILL], (travel_m, np.nan, 0.0, 0.0)
        nodes = RoadNodes.room(1, 0)
        state = self.x, self.p, self.memory
        count = forward.end(at, self.model, known, *state, nodes.at, nodes.rows)
        return nodes.filled(count)
