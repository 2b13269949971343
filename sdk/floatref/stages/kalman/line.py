"""What the smoother keeps of one wheel path until its readings no longer matter."""

from dataclasses import dataclass, field

import numpy as np

from floatref.kernels.kalman_layout import NODE, STATES
from floatref.stages.kalman.lag import closing
from floatref.stages.kalman.nodes import Nodes
from floatref.stages.kalman.segment import Marks, Segment
from floatref.stages.kalman.sigma import REACH, Settled, sigma
from floatref.values.arrays import FloatArray


@dataclass(frozen=True)
class Closing:
    """When segments are closed, and what their 1-σ is made of.

    Attributes:
        step: in s.
        tolerance_m: 1-σ of what later readings may still change.
        wavelength_m: cut-off of either pass of the filter over distance.
        noise_m: 1-σ of a reading of the height sensor.
    """

    step: float
    tolerance_m: float
    wavelength_m: float
    noise_m: float


@dataclass(eq=False)
class Line:
    """A segment in the making, those not closed, and what has been smoothed and not come out.

    Attributes:
        rule: when segments are closed.
        heights, parts, distances: filtered heights, nodes, and distance at the nodes, of the
            segment in the making.
        segments: those that are complete.
        before, origin: sample and row of the last node of a complete segment.
        behind: marks of closed segments that the filter still reaches.
        smoothed, sigmas: what has been closed, per sample, in m.
    """

    rule: Closing
    heights: list[FloatArray] = field(default_factory=list)
    parts: list[Nodes] = field(default_factory=list)
    distances: list[FloatArray] = field(default_factory=list)
    segments: list[Segment] = field(default_factory=list)
    before: int = -1
    origin: FloatArray = field(default_factory=lambda: np.zeros(NODE))
    behind: Settled | None = None
    smoothed: list[FloatArray] = field(default_factory=list)
    sigmas: list[FloatArray] = field(default_factory=list)

    def add(self, height: FloatArray, nodes: Nodes, distance_m: FloatArray) -> None:
        """Keep what the filter made of a block, and the distance at its nodes."""
        self.heights.append(height)
        self.parts.append(nodes)
        self.distances.append(distance_m)

    def end_segment(self) -> None:
        """Make a segment of what was added; its last sample is a node."""
        nodes = Nodes.joined(self.parts)
        marks = Marks.of(self.before, nodes, np.concatenate(self.distances), self.rule.step)
        height = np.concatenate(self.heights)
        segment = Segment(self.before, self.origin, height, nodes, marks)
        self.segments.append(segment)
        self.before, self.origin = segment.last, nodes.nodes[-1].copy()
        self.heights, self.parts, self.distances = [], [], []

    def ready(self) -> int:
        """Return how many segments nothing to come changes by more than the tolerance."""
        rule = self.rule
        return closing(self.segments, self.behind, rule.wavelength_m, rule.tolerance_m)

    def close(self, count: int) -> None:
        """Smooth the first ``count`` segments and let go of them."""
        adjoint, found = np.zeros(STATES), []
        for segment in reversed(self.segments):
            corrections = segment.back(adjoint, self.rule.step)
            found.append((segment, corrections, adjoint.copy()))
        for segment, corrections, behind in found[: -count - 1 : -1]:
            segment.smooth(corrections, behind, self.rule.step)
            self.smoothed.append(segment.height)
        self._settle(count)
        del self.segments[:count]

    def _settle(self, count: int) -> None:
        """Find 1-σ of the first ``count`` segments."""
        from floatref.kernels import kalman_backward

        marks = Settled.of([segment.marks for segment in self.segments])
        closed = sum(len(segment.marks.at) for segment in self.segments[:count])
        reach = REACH * self.rule.wavelength_m
        end = int(np.searchsorted(marks.distance_m, marks.distance_m[closed - 1] + reach, "right"))
        marks = marks.part(slice(0, max(end, closed)))
        first = 0 if self.behind is None else len(self.behind.at)
        marks = marks if self.behind is None else marks.behind(self.behind)
        last = first + closed
        low = max(first - 1, 0)
        found = sigma(marks, low, last, self.rule.wavelength_m, self.rule.noise_m)
        line = np.empty(sum(segment.height.size for segment in self.segments[:count]))
        kalman_backward.ramp(marks.at[low:last], found, self.segments[0].before + 1, line)
        self.sigmas.append(line)
        keep = int(np.searchsorted(marks.distance_m, marks.distance_m[last - 1] - reach))
        self.behind = marks.part(slice(min(keep, last - 1), last))

    def take(self, count: int) -> tuple[FloatArray, FloatArray]:
        """Return smoothed height and 1-σ of the next ``count`` samples, which are there."""
        return _front(self.smoothed, count), _front(self.sigmas, count)


def _front(pieces: list[FloatArray], count: int) -> FloatArray:
    """Take the first ``count`` samples off ``pieces``."""
    taken = [np.empty(0)] if count == 0 else []
    while count:
        piece = pieces.pop(0)
        if piece.size > count:
            pieces.insert(0, piece[count:])
        taken.append(piece[:count])
        count -= taken[-1].size
    return taken[0] if len(taken) == 1 else np.concatenate(taken)
