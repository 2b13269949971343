"""What a device gave out during one run of a stream, in order, each with its recorded time."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray
from floatref_conformance.devices.streams.answers import FINAL, Points, Started
from floatref_conformance.errors import DeviceError

MOST_POINTS = 10**8
"""Largest span of the points of a run."""


@dataclass(frozen=True, eq=False)
class Given:
    """Points, and the recorded time in s of the last sample that the device had for them.

    The time is infinite for what comes after `finish`.
    """

    points: Points
    until_s: float


@dataclass(frozen=True, eq=False)
class Line:
    """One wheel path of a run on the points ``first`` + k; shape (N,).

    Attributes:
        first, interval_m: number of the first point, and the distance between points in m.
        elevation: of the first time that a point was given, in m; NaN where missing.
        valid: the device's flags of that time.
        given_s: recorded time of it; NaN where a point was never given.
        changed_m: largest difference in m to a later elevation, infinite if its flag changed.
    """

    first: int
    interval_m: float
    elevation: FloatArray
    valid: BoolArray
    given_s: FloatArray
    changed_m: FloatArray

    @property
    def distance_m(self) -> FloatArray:
        """Distance of every point in m, shape (N,)."""
        return (self.first + np.arange(self.elevation.size, dtype=np.float64)) * self.interval_m


@dataclass
class Transcript:
    """All that came back in one run.

    Attributes:
        started: the device's declaration.
        given: points in the order in which they came.
        memory_bytes: memory of the device's processes at recorded times in s, in order.
    """

    started: Started
    given: list[Given] = field(default_factory=list)
    memory_bytes: list[tuple[float, int]] = field(default_factory=list)

    @property
    def final(self) -> tuple[Given, ...]:
        """What was given out as final."""
        return tuple(each for each in self.given if each.points.state == FINAL)

    @property
    def provisional(self) -> tuple[Given, ...]:
        """What was given out as provisional."""
        return tuple(each for each in self.given if each.points.state != FINAL)


def lines_of(given: Iterable[Given]) -> Mapping[str, Line]:
    """Return the wheel paths of ``given`` by name; empty without points.

    Raises DeviceError if the interval or the wheel paths change within a run.
    """
    pieces = list(given)
    if not pieces:
        return {}
    first, end, interval_m = _span(pieces)
    names = list(pieces[0].points.paths)
    for each in pieces:
        if list(each.points.paths) != names:
            raise DeviceError("gives out points of other wheel paths than before in this run")
    return {name: _line(pieces, name, first, end - first, interval_m) for name in names}


def _span(pieces: list[Given]) -> tuple[int, int, float]:
    intervals = {each.points.interval_m for each in pieces}
    if len(intervals) > 1:
        raise DeviceError("gives out points at several intervals in one run")
    first = min(each.points.first for each in pieces)
    end = max(each.points.first + each.points.count for each in pieces)
    if end - first > MOST_POINTS:
        raise DeviceError(f"gives out points {end - first} numbers apart in one run")
    return first, end, intervals.pop()


def _line(pieces: list[Given], name: str, first: int, count: int, interval_m: float) -> Line:
    elevation, given_s = np.full(count, np.nan), np.full(count, np.nan)
    valid, changed_m = np.zeros(count, dtype=bool), np.zeros(count)
    for each in pieces:
        path, at = each.points.paths[name], each.points.first - first
        here = slice(at, at + each.points.count)
        new = np.isnan(given_s[here])
        apart_m = differences(elevation[here], valid[here], path.elevation, path.valid)
        changed_m[here] = np.where(new, 0.0, np.maximum(changed_m[here], apart_m))
        elevation[here] = np.where(new, path.elevation, elevation[here])
        valid[here] = np.where(new, path.valid, valid[here])
        given_s[here] = np.where(new, each.until_s, given_s[here])
    return Line(first, interval_m, elevation, valid, given_s, changed_m)


def differences(a: FloatArray, a_valid: BoolArray, b: FloatArray, b_valid: BoolArray) -> FloatArray:
    """Return the differences of two elevations in m, infinite where flags or gaps differ."""
    with np.errstate(invalid="ignore"):
        apart = np.abs(a - b)
    apart = np.where(np.isnan(a) & np.isnan(b), 0.0, apart)
    return np.where(np.isnan(apart) | (a_valid != b_valid), np.inf, apart)
