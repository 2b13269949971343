"""The road-prior filter of one wheel path, fed block by block."""

from dataclasses import dataclass

import numpy as np

from floatref.kernels.road_prior_layout import BEFORE, ENDS, MEMORY, MODEL, STATES
from floatref.stages.road_prior.constants import RoadPrior
from floatref.stages.road_prior.nodes import RoadNodes
from floatref.values.arrays import FloatArray

NODES_PER_S = 500.0
"""A node every 32 samples at 16 kHz."""


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

    @classmethod
    def of(cls, constants: RoadPrior, step: float, start_m: float) -> "RoadTrack":
        """Return the filter before its first sample, at the height ``start_m``."""
        model = constants.model(step)
        assert model.size == MODEL
        x, memory = np.zeros(STATES), np.zeros(MEMORY)
        x[0] = memory[0] = start_m
        return cls(model, sub_block(step), x, constants.start(), memory)

    def advance(self, a: FloatArray, first: int, ends: FloatArray) -> tuple[FloatArray, RoadNodes]:
        """Return the heights integrated from the accelerations ``a``, in m, and the nodes.

        ``ends`` has a row for each node, see `road_prior_layout`.
        """
        from floatref.kernels import road_prior

        height, nodes = np.empty(a.size), RoadNodes.room(len(ends), len(ends))
        kept = nodes.at, nodes.rows, nodes.updates
        state = self.x, self.p, self.memory
        count = road_prior.run(a, first, self.sub_block, self.model, ends, *state, height, *kept)
        return height, nodes.filled(count)

    def end(self, at: int, travel_m: float) -> RoadNodes:
        """Return a node at sample ``at``, the last, or none if it is one already."""
        from floatref.kernels import road_prior

        known = np.full(ENDS, np.nan)
        known[:3], known[3:] = self.memory[BEFORE:], (travel_m, np.nan, 0.0, 0.0)
        nodes = RoadNodes.room(1, 0)
        state = self.x, self.p, self.memory
        count = road_prior.end(at, self.model, known, *state, nodes.at, nodes.rows)
        return nodes.filled(count)
