"""A long road filtered piece by piece, each with the run-in of the filter on both sides.

A filter forgets: beyond its run-in what it was given changes its output by less than rounding. So
a piece of the output needs the road of the piece and of the run-in, not all of it. A piece begins
and ends at a usable point, so that bridges over the others are those of the whole road.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from floatref.measures.roughness.iri_settings import intervals_in
from floatref.values.arrays import BoolArray, FloatArray

PIECE = 1 << 19
"""Least intervals of a piece of a longer road: 4 MiB of float64."""
CAR_RUN_IN_M = 400.0
"""Its slowest mode falls by e in 8.6 m, and by exp(−46) in this."""
RUN_IN_WAVES = 12.0
"""Longest wavelengths λc of a filter: its pair of poles falls by exp(−π) in one,
by exp(−37) in these."""


class RoadPiece(NamedTuple):
    """Intervals from ``begin`` to before ``end``, and the points to calculate them from.

    These are from ``first`` to before ``last``.
    """

    begin: int
    end: int
    first: int
    last: int

    @property
    def points(self) -> slice:
        """The points to calculate from."""
        return slice(self.first, self.last)

    def inside(self, more: int = 0) -> slice:
        """Return the intervals, and ``more`` on both sides, as counted from the first point."""
        begin = max(self.begin - more, self.first)
        return slice(begin - self.first, min(self.end + more, self.last - 1) - self.first)


def cut_road(usable: BoolArray, run_in_m: float, interval_m: float) -> Iterator[RoadPiece]:
    """Yield the pieces of a road of points that are ``usable`` or not; both ends are.

    Each has at least ``run_in_m`` on both sides, or reaches the road's end.
    """
    run_in, count = intervals_in(run_in_m, interval_m), usable.size - 1
    # As long as the run-in at least: half of the work is then on the pieces themselves.
    pieces = max(count // max(PIECE, run_in), 1)
    edges = [count * k // pieces for k in range(pieces + 1)]
    for begin, end in pairwise(edges):
        first, last = max(begin - run_in, 0), min(end + run_in, count)
        first -= int(usable[first::-1].argmax())
        last += int(usable[last:].argmax())
        yield RoadPiece(begin, end, first, last + 1)


def mean_slope(elevation: FloatArray, interval_m: float) -> float:
    """Return the mean slope in m/m of a road whose first and last point are usable; 0 of a point.

    A piece that took its own mean off would differ from the road next to the road's ends.
    """
    rise = float(elevation[-1]) - float(elevation[0])
    return rise / (max(elevation.size - 1, 1) * interval_m)
