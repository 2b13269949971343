"""Bumps and dips of a deviation: where a road leaves a line, and how much of that is valid.

The line at a point is made from the points on both sides of it, as far as half a length: a moving
average, or a straightedge on two wheels.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.measures.gaps import bridge, check_elevation, measured_stretch
from floatref.measures.roughness.areas import (
    Area,
    list_areas,
    share,
    valid_points,
    valid_throughout,
)
from floatref.values.arrays import BoolArray, FloatArray, release
from floatref.values.scanning import chunks

SIGNS = (("bump", 1.0), ("dip", -1.0))


@dataclass(frozen=True)
class BumpOrDip:
    """An area from its first to its last point in m, and its largest deviation in m.

    ``kind`` is "bump" or "dip"; ``deviation_m`` is below zero for a dip and lies at ``peak_at_m``.
    ``valid_share`` is the share, 0 to 1, of its points whose line is made from valid points only.
    """

    kind: str
    start_m: float
    end_m: float
    peak_at_m: float
    deviation_m: float
    valid_share: float


@dataclass(frozen=True, eq=False)
class Deviation:
    """How far a road is above its line in m, for each point of a profile; NaN where unknown.

    ``sound`` says for each point whether its line is made from valid points only.
    """

    values: FloatArray
    sound: BoolArray
    interval_m: float
    start_m: float

    def list_areas(self, limit_m: float) -> tuple[BumpOrDip, ...]:
        """Return every stretch farther than ``limit_m`` above or below the line, in order.

        Raises InputError for a limit that is not above zero.
        """
        check_limit(limit_m)
        found = [
            self._describe(kind, area)
            for kind, sign in SIGNS
            for area in list_areas(self.values, limit_m, sign)
        ]
        return tuple(sorted(found, key=lambda each: each.start_m))

    def _describe(self, kind: str, area: Area) -> BumpOrDip:
        """Return the record of ``area``."""
        first, last, peak = (
            self.start_m + k * self.interval_m for k in (area.first, area.end - 1, area.peak)
        )
        valid_share = share(self.sound[area.first : area.end])
        return BumpOrDip(kind, first, last, peak, float(self.values[area.peak]), valid_share)


Line = Callable[[FloatArray, int], FloatArray]
"""From heights in m, (N,), and the points of half a window to the line at (N − 2 half,) of them."""


def deviation_from_line(
    elevation: FloatArray,
    interval_m: float,
    half: int,
    line_of: Line,
    start_m: float = 0.0,
    valid: ArrayLike | None = None,
) -> Deviation:
    """Return how far ``elevation`` in m is above the line through its window of 2 half + 1 points.

    Gaps are bridged; NaN where the window is not inside the measured stretch, and in gaps. Without
    ``valid``, finite points are valid. Raises InputError for elevations that cannot be used.
    """
    stretch, road = bridged_stretch(elevation, interval_m)
    values = np.full(np.size(elevation), np.nan)

    def above_line(part: FloatArray) -> FloatArray:
        rise = part - road[0]
        return np.asarray(rise[half:-half] - line_of(rise, half))

    in_pieces(above_line, road, Window(half, half), values[stretch])
    clear_gaps(values, elevation)
    sound = sound_points(valid, elevation, half, half)
    return Deviation(values, sound, interval_m, start_m)


def half_count(length_m: float, interval_m: float, name: str) -> int:
    """Return the intervals in half of ``length_m``: round(length/2/interval), at least 1.

    Ties go to even. Raises InputError, with ``name``, for a length that is not finite and above
    zero.
    """
    check_length(length_m, name)
    return max(round(length_m / 2.0 / interval_m), 1)


def check_limit(limit_m: float) -> None:
    """Raise InputError unless the deviation ``limit_m`` in m is above zero."""
    if not limit_m > 0:
        raise InputError(f"a deviation of {limit_m} m is no limit; it must be above zero")


def check_length(length_m: float, name: str) -> None:
    """Raise InputError, with ``name``, unless ``length_m`` is finite and above zero."""
    if not (np.isfinite(length_m) and length_m > 0):
        raise InputError(f"{name} is {length_m} m; it must be above zero")


def bridged_stretch(elevation: FloatArray, interval_m: float) -> tuple[slice, FloatArray]:
    """Return the measured stretch of ``elevation``, and its elevations in m with gaps bridged.

    Raises InputError for elevations that cannot be used.
    """
    values = check_elevation(elevation, interval_m)
    stretch = measured_stretch(values)
    return stretch, bridge(values[stretch])


class Window(NamedTuple):
    """The points before and behind one from which its value is made, 0 or more of each."""

    before: int
    behind: int


def in_pieces(
    value_of: Callable[[FloatArray], FloatArray],
    road: FloatArray,
    window: Window,
    out: FloatArray,
) -> None:
    """Write the value of every point of ``road`` whose window is inside it to ``out``.

    ``value_of`` gets a piece of ``road`` and returns the values of its points but those that have
    no whole window in it. A long road then takes no more memory than ``out``, of as many points.
    """
    needed = window.before + window.behind
    for at, part in chunks(road, needed):
        if part.size > needed:
            begin = at + window.before
            out[begin : begin + part.size - needed] = value_of(part)


def clear_gaps(values: FloatArray, elevation: FloatArray) -> None:
    """Write NaN to ``values`` where ``elevation``, of as many points, has no finite number."""
    for at, part in chunks(np.asarray(elevation, dtype=np.float64)):
        values[at : at + part.size][~np.isfinite(part)] = np.nan


def sound_points(
    valid: ArrayLike | None, elevation: FloatArray, before: int, after: int
) -> BoolArray:
    """Return of which points those from ``before`` before to ``after`` behind are all valid.

    Without ``valid``, finite points are valid. Raises InputError unless it has a value for each.
    """
    values = np.asarray(elevation, dtype=np.float64)
    points = valid_points(valid, values)
    # What was read of a file would stay in memory.
    release(values)
    return valid_throughout(points, before, after)
