"""Segments of a run between two nodes, as the backward pass takes them."""

from dataclasses import dataclass

import numpy as np

from floatref.kernels.kalman_layout import STATES
from floatref.stages.kalman.nodes import Nodes
from floatref.values.arrays import FloatArray, IndexArray

CORRECTIONS = 4
"""Numbers of a correction: height and velocity on both sides of a node."""
APART_M = 8.0
APART_S = 0.5
"""Marks are so far apart, in travel and in time."""


@dataclass(eq=False)
class Marks:
    """A few of a segment's nodes, the last among them, for what concerns covariances alone.

    Attributes:
        at: samples, shape (n,).
        distance_m: encoder distance there, shape (n,).
        covariance: P, shape (n, 10, 10).
        passed: product of (I - K H) F from the mark before, or the node before the segment.
        gathered: what the observations since then add to the covariance of lambda.
    """

    at: IndexArray
    distance_m: FloatArray
    covariance: FloatArray
    passed: FloatArray
    gathered: FloatArray

    @classmethod
    def of(cls, before: int, nodes: Nodes, distance_m: FloatArray, step: float) -> "Marks":
        """Choose the marks of a segment from its ``nodes``, at ``distance_m`` each."""
        from floatref.kernels import kalman_backward, kalman_covariance

        chosen = _chosen(nodes.at[:, 0], distance_m, step)
        passed, gathered = np.empty((2, chosen.size, STATES, STATES))
        kalman_backward.closed_loop(
            nodes.at, nodes.nodes, nodes.updates, max(before, 0), step, chosen, passed, gathered
        )
        spread = np.empty_like(passed)
        kalman_covariance.unpack(nodes.nodes, chosen, spread)
        return cls(nodes.at[chosen, 0], distance_m[chosen], spread, passed, gathered)


def _chosen(at: IndexArray, distance_m: FloatArray, step: float) -> IndexArray:
    """Return the nodes that are far enough from those before, in time or travel, and the last."""
    travelled = np.floor((distance_m - distance_m[0]) / APART_M)
    elapsed = np.floor((at - at[0]) * (step / APART_S))
    moved = np.diff(travelled, prepend=travelled[0]) + np.diff(elapsed, prepend=elapsed[0])
    return np.union1d(np.flatnonzero(moved > 0), [at.size - 1])


@dataclass(eq=False)
class Segment:
    """One wheel path between two nodes.

    Attributes:
        before: sample of the node before the first sample; -1 before the run.
        origin: row of that node.
        height: of the samples from ``before`` + 1 to the last node, in m, filtered until smoothed.
        nodes: those after ``before``.
        marks: those of them that tell how covariances pass on.
    """

    before: int
    origin: FloatArray
    height: FloatArray
    nodes: Nodes
    marks: Marks

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

    def smooth(self, corrections: FloatArray, adjoint: FloatArray, step: float) -> None:
        """Make `height` the smoothed one; ``adjoint`` is lambda behind the node ``before``."""
        from floatref.kernels import kalman_backward

        start = np.zeros(CORRECTIONS)
        if self.before >= 0:
            kalman_backward.correct(self.origin, adjoint, start)
        place = np.array([max(self.before, 0), start[2], start[3]])
        kalman_backward.interpolate(
            self.nodes.at, corrections, self.before + 1, place, step, self.height
        )
