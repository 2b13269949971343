"""The forward filter of one wheel path, fed stretch by stretch."""

from dataclasses import dataclass

import numpy as np

from floatref.kernels.kalman_layout import MEMORY, STATES
from floatref.stages.kalman.nodes import Nodes
from floatref.stages.kalman.noise import Noise
from floatref.stages.kalman.references import DATUM_M, Plan, References, Stretch
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Vector

NODES_PER_S = 100.0
"""Sub-blocks of 160 samples at 16 kHz: long enough that covariances cost next to nothing."""
START_SIGMA = (1.0, 1.0, 0.1, 0.1, 0.1, 0.01, 0.01)
"""1-σ of the first state: height, velocity, pitch, roll, and biases, in SI units."""
FLOORS = (0.2, 0.5, np.radians(3.0), np.radians(3.0))
"""Innovations of GNSS readings up to here are taken, however small the filter expects them."""

Inputs = tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]


def sub_block(step: float) -> int:
    """Return how many samples of ``step`` in s a sub-block has."""
    return max(1, round(1.0 / (NODES_PER_S * step)))


@dataclass(eq=False)
class TrackFilter:
    """State, covariance and references of the filter of one wheel path.

    Inputs are specific force along X, Y, Z in m/s² and rates about X, Y, Z in rad/s, (6.47).
    """

    model: FloatArray
    sub_block: int
    references: References
    x: FloatArray
    p: FloatArray
    memory: FloatArray

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
        )

    def advance(self, u: Inputs, stretch: Stretch) -> tuple[FloatArray, Nodes]:
        """Return the filtered height of ``stretch``, and its nodes."""
        from floatref.kernels import kalman

        at, marks, rows = self.references.schedule(stretch)
        height = np.empty(stretch.height.size)
        nodes = Nodes.room(height.size, self.sub_block, at.size)
        count = kalman.run(
            u,
            stretch.first,
            self.sub_block,
            self.model,
            at,
            marks,
            rows,
            self.x,
            self.p,
            self.memory,
            height,
            nodes.at,
            nodes.nodes,
            nodes.updates,
        )
        return height, nodes.filled(count)

    def end(self) -> Nodes:
        """Return a node at the sample advanced to last, or none if it is one already."""
        from floatref.kernels import kalman

        nodes = Nodes.room(0, self.sub_block, 0)
        count = kalman.end(self.model, self.x, self.p, self.memory, nodes.at, nodes.nodes)
        return nodes.filled(count)
