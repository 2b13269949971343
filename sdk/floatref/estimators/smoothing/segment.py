"""Segments of a run between two nodes, as the backward pass takes them."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from floatref.estimators.smoothing.nodes import CORRECTION, Nodes
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray, Records, new_record


@compiled
def interpolate(
    begin: int,
    start: np.record,
    at: IndexArray,
    corrections: Records,
    first: int,
    step: float,
    height: FloatArray,
) -> None:
    """Add the corrections at nodes ``at`` to the filtered ``height`` of samples ``first`` on.

    ``start`` is the correction of the node before, at sample ``begin``. Between two nodes it is the
    cubic of values and slopes at both.
    """
    r_0, v_0, behind = start.far_height, start.far_velocity, first + height.size
    for k in range(at.size):
        end, near = at[k], corrections[k]
        span = (end - begin) * step
        r_1, slope_0, slope_1 = near.near_height, span * v_0, span * near.near_velocity
        rise = r_1 - r_0
        square, cube = 3.0 * rise - 2.0 * slope_0 - slope_1, slope_0 + slope_1 - 2.0 * rise
        scale = 1.0 / max(end - begin, 1)
        for i in range(max(begin, first), min(end, behind)):
            t = (i - begin) * scale
            height[i - first] += r_0 + t * (slope_0 + t * (square + t * cube))
        begin, r_0, v_0 = end, near.far_height, near.far_velocity
    if first <= begin < behind:
        height[begin - first] += r_0


@compiled
def ramp(at: IndexArray, values: FloatArray, first: int, line: FloatArray) -> None:
    """Write the line through ``values`` at the samples ``at``, in order, from sample ``first``.

    Before the first of them, and behind the last, it stays level.
    """
    i, size = 0, line.size
    for k in range(at.size - 1):
        begin, end = at[k] - first, min(at[k + 1] - first, size)
        while i < min(begin, end):
            line[i] = values[k]
            i += 1
        slope = (values[k + 1] - values[k]) / (at[k + 1] - at[k])
        for j in range(i, end):
            line[j] = values[k] + (j - begin) * slope
        i = max(i, end)
    for j in range(i, size):
        line[j] = values[at.size - 1]


APART_M = 8.0
APART_S = 0.5
"""Marks are so far apart, in travel and in time."""
FADE_M = 500.0
"""Over so much travel the level goes to what later readings have made of it: far longer than any
wave that the high-pass lets through."""


@dataclass(eq=False)
class Marks:
    """A few of a segment's nodes, the last among them, for what concerns covariances alone.

    Attributes:
        at: samples, shape (n,).
        distance_m: encoder distance there, shape (n,).
        column: P e_r, shape (n, states).
        latest: P at the last mark, shape (states, states).
        passed: product of (I - K H) F from the mark before, or the node before the segment.
        gathered: what the observations since then add to the covariance of lambda.
    """

    at: IndexArray
    distance_m: FloatArray
    column: FloatArray
    latest: FloatArray
    passed: FloatArray
    gathered: FloatArray

    @classmethod
    def of(cls, before: int, nodes: Nodes, distance_m: FloatArray, step: float) -> "Marks":
        """Choose the marks of a segment from its ``nodes``, at ``distance_m`` each."""
        chosen = _choose_nodes(nodes.at, distance_m, step)
        passed, gathered = nodes.passes(max(before, 0), step, chosen)
        place = nodes.at[chosen], distance_m[chosen]
        return cls(*place, nodes.column(chosen), nodes.latest(), passed, gathered)


def _choose_nodes(at: IndexArray, distance_m: FloatArray, step: float) -> IndexArray:
    """Return the nodes that are far enough from those before, in time or travel, and the last.

    Time at a standstill does not count: it could be an hour.
    """
    apart = np.zeros(at.size)
    travel = distance_m[1:] - distance_m[:-1]
    elapsed = (at[1:] - at[:-1]) * (travel != 0.0) * (step / APART_S)
    # Where distances are missing, time alone tells.
    np.fmax(travel * (1.0 / APART_M), elapsed, out=apart[1:])
    gone = apart.cumsum().astype(np.int64)
    gone[-1] += 1
    return np.flatnonzero(gone[1:] > gone[:-1]) + 1 if at.size > 1 else np.zeros(1, np.int64)


@dataclass(eq=False)
class Segment:
    """One wheel path between two nodes.

    Attributes:
        before: sample of the node before the first one; -1 before the run.
        origin: that node alone; empty before the run.
        nodes: those after ``before``.
        marks: those of them that carry how covariances pass on.
    """

    before: int
    origin: Nodes | None
    nodes: Nodes
    marks: Marks

    @property
    def last(self) -> int:
        """Sample of the last node."""
        return int(self.nodes.at[-1])

    def back(self, adjoint: FloatArray, step: float) -> Records:
        """Return the corrections at the nodes; ``adjoint`` goes from the last to ``before``."""
        return self.nodes.back(max(self.before, 0), step, adjoint)

    def start(self, adjoint: FloatArray) -> np.record:
        """Return the corrections at ``before``; ``adjoint`` is lambda behind it."""
        return new_record(CORRECTION) if self.origin is None else self.origin.correction(adjoint)

    def shift(self, start: np.record, corrections: Records, step_m: float, place_m: float) -> float:
        """Shift all corrections by ``step_m``, less with the travel from ``place_m`` on.

        Returns what remains of it at the last node.
        """
        if step_m == 0.0:
            return 0.0
        marks = np.append(max(self.before, 0), self.marks.at)
        travel = np.fmax.accumulate(np.append(place_m, self.marks.distance_m)) - place_m
        left = step_m * np.exp(-travel / FADE_M)
        start.far_height += step_m
        at_nodes = np.interp(self.nodes.at, marks, left)
        corrections["near_height"] += at_nodes
        corrections["far_height"] += at_nodes
        return float(left[-1])

    def smooth(
        self,
        corrections: Records,
        start: np.record,
        step: float,
        pieces: Iterable[tuple[int, FloatArray]],
    ) -> None:
        """Correct the filtered heights of ``pieces`` behind ``before``, up to the last node.

        A piece has the number of its first sample; ``start`` are the corrections at ``before``.
        """
        begin, end = max(self.before, 0), self.last + 1
        for first, height in pieces:
            low = max(self.before + 1, first)
            part = height[low - first : max(end, first) - first]
            interpolate(begin, start, self.nodes.at, corrections, low, step, part)
