"""Segments of a run between two nodes, as the backward pass takes them."""

from dataclasses import dataclass

import numpy as np

from floatref.kernels.kalman_layout import NODE, STATES
from floatref.stages.kalman.nodes import Nodes
from floatref.values.arrays import FloatArray

CORRECTIONS = 5


@dataclass(eq=False)
class Segment:
    """One wheel path between two nodes.

    Attributes:
        before: sample of the node before the first sample; -1 before the run.
        origin: row of that node.
        height: filtered height of the samples from ``before`` + 1 to the last node, in m.
        nodes: those after ``before``.
        passed: how an error at ``before`` passes on to the last node, (7, 7).
    """

    before: int
    origin: FloatArray
    height: FloatArray
    nodes: Nodes
    passed: FloatArray

    @classmethod
    def of(
        cls,
        before: int,
        origin: FloatArray,
        heights: list[FloatArray],
        parts: list[Nodes],
        step: float,
    ) -> "Segment":
        """Join what the filter made of the blocks of a segment."""
        from floatref.kernels import kalman_backward

        nodes = Nodes.joined(parts)
        passed = np.empty((1, STATES, STATES))
        none = np.empty(0, np.int64)
        kalman_backward.closed_loop(
            nodes.at, nodes.nodes, nodes.updates, max(before, 0), step, none, passed
        )
        return cls(before, origin, np.concatenate(heights), nodes, passed[0])

    @property
    def last(self) -> int:
        """Sample of the last node."""
        return self.before + self.height.size

    def back(self, adjoint: FloatArray, step: float) -> FloatArray:
        """Return the corrections at the nodes; ``adjoint`` goes from the last to ``before``."""
        from floatref.kernels import kalman_backward

        found = np.empty((len(self.nodes.at), CORRECTIONS))
        n = self.nodes
        kalman_backward.smooth(n.at, n.nodes, n.updates, max(self.before, 0), step, adjoint, found)
        return found

    def smoothed(
        self, corrections: FloatArray, adjoint: FloatArray, datum: float, step: float
    ) -> tuple[FloatArray, float]:
        """Return the smoothed height, and the leaps of the datum so far.

        ``adjoint`` is lambda behind the node ``before``.
        """
        from floatref.kernels import kalman_backward

        start = np.zeros(CORRECTIONS)
        if self.before >= 0:
            kalman_backward.correct(self.origin, adjoint, start)
        place = np.array([max(self.before, 0), start[2], start[3]])
        height = self.height.copy()
        leaps = kalman_backward.interpolate(
            self.nodes.at, corrections, self.before + 1, place, step, datum, height
        )
        return height, leaps
