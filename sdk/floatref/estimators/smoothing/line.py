"""What the smoother stores of one wheel path until its readings no longer matter."""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from floatref.estimators.smoothing.lag import changes
from floatref.estimators.smoothing.nodes import Nodes
from floatref.estimators.smoothing.segment import Marks, Segment
from floatref.estimators.smoothing.sigma import REACH, Settled, sigma
from floatref.values.arrays import FloatArray, IndexArray, Records


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
    """Heights that have not come out, nodes of the segment in the making, and segments not closed.

    Attributes:
        rule: when segments are closed.
        heights: of blocks, filtered until smoothed, in m, with the number of their first sample.
        parts, distances: nodes, and distance there, of what is behind the segments.
        coming: the same of the segments behind that, of a block that holds several.
        segments: those that are complete.
        before, origin: last node of a complete segment, its sample and itself.
        behind: marks of closed segments that the filter still reaches.
        shift: correction in m at the last closed node, as given out.
        known_at, known: marks of closed segments that have not come out, and 1-σ in m there.
    """

    rule: Closing
    heights: list[tuple[int, FloatArray]] = field(default_factory=list)
    parts: list[Nodes] = field(default_factory=list)
    distances: list[FloatArray] = field(default_factory=list)
    coming: list[tuple[Nodes, FloatArray]] = field(default_factory=list)
    segments: list[Segment] = field(default_factory=list)
    before: int = -1
    origin: Nodes | None = None
    behind: Settled | None = None
    shift: float = 0.0
    known_at: IndexArray = field(default_factory=lambda: np.empty(0, np.int64))
    known: FloatArray = field(default_factory=lambda: np.empty(0))

    def add(self, nodes: Nodes, distance_m: FloatArray, borders: Sequence[int] = ()) -> None:
        """Store nodes behind those before, and the distance there.

        ``borders`` are the samples where segments end before the last of these nodes, in order.
        """
        pieces = nodes.split(borders)
        ends = np.cumsum([len(piece.at) for piece in pieces])
        distances = [part.copy() for part in np.split(distance_m, ends[:-1])]
        self.parts.append(pieces.pop(0))
        self.distances.append(distances.pop(0))
        self.coming = list(zip(pieces, distances, strict=True))

    def end_segment(self) -> None:
        """Make a segment of the nodes up to the next border, one or more."""
        nodes, distance = self.parts[0].concatenate(self.parts), np.concatenate(self.distances)
        marks = Marks.of(self.before, nodes, distance, self.rule.step)
        self.segments.append(Segment(self.before, self.origin, nodes, marks))
        self.before, self.origin = self.segments[-1].last, nodes.last()
        ahead = [self.coming.pop(0)] if self.coming else []
        self.parts, self.distances = [n for n, _ in ahead], [d for _, d in ahead]

    def changes(self) -> FloatArray:
        """Return by how much what is to come can change the end of each segment but the last."""
        return changes(self.segments, self.behind, self.rule.wavelength_m)

    def count_passed(self) -> int:
        """Return how many segments lie so far behind that their 1-σ needs nothing to come."""
        places = np.fmax.accumulate([s.marks.distance_m[-1] for s in self.segments])
        reach = REACH * self.rule.wavelength_m
        return int(np.searchsorted(places, places[-1] - reach, "right"))

    def count_standing(self) -> int:
        """Return how many of the last segments end where the last one does."""
        places = np.array([s.marks.distance_m[-1] for s in self.segments])
        return int(np.argmin(np.append(places[::-1] >= places[-1], False)))

    def close(self, count: int, beyond: FloatArray | None = None) -> None:
        """Smooth the first ``count`` segments and let go of them.

        ``beyond``, shape (states,), is lambda behind the last segment, zero if not given.
        """
        states = self.segments[0].nodes.states
        adjoint = np.zeros(states) if beyond is None else beyond
        found = []
        for segment in reversed(self.segments):
            corrections = segment.back(adjoint, self.rule.step)
            found.append((segment, corrections, adjoint.copy()))
        self._smooth(found[: -count - 1 : -1])
        self._settle(count)
        del self.segments[:count]

    def _smooth(self, found: Sequence[tuple[Segment, Records, FloatArray]]) -> None:
        """Correct the heights of segments by the corrections at their nodes, with lambda before.

        What has come out stays, and what follows begins there.
        """
        firsts, shift = [first for first, _ in self.heights], 0.0
        place = np.nan if self.behind is None else float(self.behind.distance_m[-1])
        for segment, corrections, behind in found:
            start = segment.start(behind)
            if segment is self.segments[0] and self.behind is not None:
                shift = self.shift - float(start.far_height)
            shift = segment.shift(start, corrections, shift, place)
            place = float(np.fmax(place, segment.marks.distance_m[-1]))
            low = bisect_right(firsts, segment.before + 1) - 1
            pieces = self.heights[low : bisect_right(firsts, segment.last)]
            segment.smooth(corrections, start, self.rule.step, pieces)
            self.shift = float(corrections["far_height"][-1])

    def _settle(self, count: int) -> None:
        """Find 1-σ of the first ``count`` segments."""
        marks = Settled.of([segment.marks for segment in self.segments])
        marks = marks if self.behind is None else marks.behind(self.behind)
        first = 0 if self.behind is None else len(self.behind.at)
        last = first + sum(len(segment.marks.at) for segment in self.segments[:count])
        reach = REACH * self.rule.wavelength_m
        end = int(np.searchsorted(marks.distance_m, marks.distance_m[last - 1] + reach, "right"))
        marks = marks.part(slice(0, max(end, last)))
        found = sigma(marks, first, last, self.rule.wavelength_m, self.rule.noise_m)
        self.known_at = np.concatenate((self.known_at, marks.at[first:last]))
        self.known = np.concatenate((self.known, found))
        keep = int(np.searchsorted(marks.distance_m, marks.distance_m[last - 1] - reach))
        self.behind = marks.part(slice(min(keep, last - 1), last)).without_standing()

    def take(self) -> tuple[FloatArray, FloatArray]:
        """Return smoothed height and 1-σ of the next block, all of whose samples are closed."""
        from floatref.estimators.smoothing import segment

        first, height = self.heights.pop(0)
        deviation = np.empty(height.size)
        segment.ramp(self.known_at, self.known, first, deviation)
        done = max(int(np.searchsorted(self.known_at, first + height.size, "right")) - 1, 0)
        self.known_at, self.known = self.known_at[done:], self.known[done:]
        return height, deviation
