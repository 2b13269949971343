"""The road-prior filter of one wheel path, fed block by block."""

from dataclasses import dataclass

import numpy as np

from floatref.kernels.road_prior_layout import (
    BEFORE,
    ENDS,
    MEMORY,
    MODEL,
    ROAD_STEP,
    SEEN,
    SLOPE_STEP,
    STATES,
    STILL,
    TRAVEL,
)
from floatref.stages.road_prior.constants import RoadPrior
from floatref.stages.road_prior.nodes import RoadNodes
from floatref.stages.road_prior.spectrum import RoadSpectrum
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
    """State and covariance of the filter of one wheel path."""

    model: FloatArray
    sub_block: int
    x: FloatArray
    p: FloatArray
    memory: FloatArray
    spectrum: RoadSpectrum
    bends: list[tuple[int, float]]

    @classmethod
    def of(cls, constants: RoadPrior, step: float, start_m: float) -> "RoadTrack":
        """Return the filter before its first sample, at the height ``start_m``."""
        model = constants.model(step)
        assert model.size == MODEL
        x, memory = np.zeros(STATES), np.zeros(MEMORY)
        x[0] = memory[0] = start_m
        spectrum = RoadSpectrum.of(constants, step * sub_block(step))
        begun = model, sub_block(step), x, constants.start(), memory
        return cls(*begun, spectrum, [(0, spectrum.bend_m)])

    def advance(self, a: FloatArray, first: int, ends: FloatArray) -> tuple[FloatArray, RoadNodes]:
        """Return the heights integrated from the accelerations ``a``, in m, and the nodes.

        ``ends`` has a row for each node, see `road_prior_layout`.
        """
        height, parts = np.empty(a.size), [RoadNodes.room(0, 0)]
        every, low = self.sub_block * RENEWAL, 0
        while low < a.size:
            if (first + low) % every == 0:
                self.model[[ROAD_STEP, SLOPE_STEP]] = self.spectrum.road()
                self.bends.append((first + low, self.spectrum.bend_m))
            high = min(low + every - (first + low) % every, a.size)
            count = -(-(first + high) // self.sub_block) - -(-(first + low) // self.sub_block)
            nodes = self._advance(a[low:high], first + low, ends[:count], height[low:high])
            parts.append(nodes)
            ends, low = ends[count:], high
        return height, RoadNodes.joined(parts)

    def _advance(
        self, a: FloatArray, first: int, ends: FloatArray, height: FloatArray
    ) -> RoadNodes:
        from floatref.kernels import road_prior

        nodes = RoadNodes.room(len(ends), len(ends))
        kept = nodes.at, nodes.rows, nodes.updates
        state = self.x, self.p, self.memory
        count = road_prior.run(a, first, self.sub_block, self.model, ends, *state, height, *kept)
        found = nodes.filled(count)
        self.spectrum.add(height[found.at[:, 0] - first] - ends[:, SEEN], ends[:, TRAVEL])
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
        from floatref.kernels import road_prior

        known = np.full(ENDS, np.nan)
        known[:3], known[3:] = self.memory[BEFORE:STILL], (travel_m, np.nan, 0.0, 0.0)
        nodes = RoadNodes.room(1, 0)
        state = self.x, self.p, self.memory
        count = road_prior.end(at, self.model, known, *state, nodes.at, nodes.rows)
        return nodes.filled(count)
