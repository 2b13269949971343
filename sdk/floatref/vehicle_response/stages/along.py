"""Along the road: from the place of the wheel to that of the laser."""

from collections.abc import Mapping
from math import floor
from typing import ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ELEVATION, SIGMA
from floatref.values.arrays import BoolArray, Flag, FlagArray, FloatArray, IndexArray, frozen
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId

EXACT = 1e-6
"""Tolerance, in intervals, within which a shift is a whole number of intervals."""


class ShiftAlong(Stage):
    """Shifts channels forward by their own shift in m, linear between points.

    A wheel at x_w is at the encoder distance s on the road at s + x_w - x_l of an axis on which a
    sensor at x_l measures the road at s. Where no wheel has been the value is NaN, flagged as
    missing. A value is missing where one of its two points is missing, and has the flags of all
    points from there to its new place, since its distance depends on the encoder there. Blocks wait
    for a shift backwards.
    """

    declared: ClassVar[Declared] = Declared(linear=False, zero_in_zero_out=False, delay=1 << 62)

    def __init__(self, shifts_m: Mapping[ChannelId, float]) -> None:
        """Shift each channel by its value in ``shifts_m``, forward if above zero."""
        super().__init__()
        self.shifts_m = dict(shifts_m)
        self._points: dict[ChannelId, tuple[int, float]] = {}
        self._behind, self._ahead = 0, 0
        self._made: frozenset[ChannelId] = frozenset()

    def open(self, header: Header) -> Header:
        """Ask for the channels, over distance; others are dropped."""
        if header.axis is not Axis.DISTANCE:
            raise InputError(f"stage {self.name}: the stream is not on the distance axis")
        header.require(self.name, *self.shifts_m)
        self._points = {c: _split(x / header.step) for c, x in self.shifts_m.items()}
        whole = [points for points, _ in self._points.values()]
        self._behind, self._ahead = max(0, *whole) + 1, max(0, *(-points for points in whole))
        self._made = frozenset(self.shifts_m)
        self.memory = {"waiting": None, "begun": 0, "next": 0}
        names = {channel.name for channel in header.channels - self._made}
        return header.without(*names)

    def advance(self, block: Block) -> Block:
        """Return the points that are known."""
        waiting: Block | None = self.memory["waiting"]
        if waiting is None:
            self.memory["begun"] = self.memory["next"] = block.first
        wide = block if waiting is None else join_blocks((waiting, block))
        return self._until(wide, wide.first + len(wide) - self._ahead)

    def close(self) -> tuple[Block, ...]:
        """Return the points held back; no wheel has been beyond the end."""
        waiting: Block | None = self.memory["waiting"]
        return () if waiting is None else (self._until(waiting, waiting.first + len(waiting)),)

    def _until(self, wide: Block, end: int) -> Block:
        first = self.memory["next"]
        places = np.arange(first, max(first, end))
        values, flags = {}, {}
        for channel, (points, part) in self._points.items():
            values[channel], own = _take(wide, channel, places - points, part)
            flags[channel] = own | _gather_passed(
                flags_of(wide, channel), places - wide.first, points
            )
        self.memory["next"] = first + places.size
        keep = max(0, min(self.memory["next"] - self._behind - wide.first, len(wide)))
        self.memory["waiting"] = wide.part(keep, len(wide))
        return Block(
            first,
            {c: frozen(x) for c, x in values.items()},
            flags={c: f for c, f in flags.items() if f.any()},
        )


class Abeam(ShiftAlong):
    """Shifts elevation and 1-σ of each wheel path, so that all lie on the axis of one laser."""

    def __init__(self, shifts_m: Mapping[str, float]) -> None:
        """Shift each wheel path by its value in ``shifts_m``, in m, forward if above zero."""
        super().__init__({})
        self.by_track = dict(shifts_m)

    def open(self, header: Header) -> Header:
        """Ask for the elevations; the 1-σ is shifted where there is one."""
        header.require(self.name, *(ChannelId(ELEVATION, track) for track in self.by_track))
        found = (ChannelId(n, t) for n in (ELEVATION, SIGMA) for t in self.by_track)
        own = [channel for channel in found if channel in header.channels]
        self.shifts_m = {c: self.by_track[c.track] for c in own if c.track is not None}
        return super().open(header)


def _split(shift: float) -> tuple[int, float]:
    """Return whole points, and the part of one beyond, of a shift in points."""
    whole = floor(shift + EXACT)
    part = shift - whole
    return whole, part if part > EXACT else 0.0


def _take(
    wide: Block, channel: ChannelId, places: IndexArray, part: float
) -> tuple[FloatArray, FlagArray]:
    """Return values and flags between each of ``places`` and ``part`` before it."""
    x, marks = wide[channel], flags_of(wide, channel)
    marks = np.zeros(x.size, np.uint8) if marks is None else marks
    near, near_marks = _at(x, marks, places - wide.first)
    if part == 0.0:
        return near, near_marks
    far, far_marks = _at(x, marks, places - 1 - wide.first)
    return (1.0 - part) * near + part * far, near_marks | far_marks


def _gather_passed(marks: FlagArray | None, places: IndexArray, points: int) -> FlagArray:
    """Return the flags between each of ``places`` and ``points`` before it, both included."""
    if marks is None or not marks.any() or not places.size:
        return np.zeros(places.size, np.uint8)
    reach = abs(points)
    low, size = int(places[0]) - max(points, 0), places.size + reach
    padded = np.zeros(size, np.uint8)
    begin, end = max(low, 0), min(low + size, marks.size)
    padded[begin - low : end - low] = marks[begin:end]
    width = 1
    while width <= reach:
        step = min(width, reach + 1 - width)
        padded = padded[:-step] | padded[step:]
        width += step
    return padded


def _at(x: FloatArray, marks: FlagArray, index: IndexArray) -> tuple[FloatArray, FlagArray]:
    inside: BoolArray = (index >= 0) & (index < x.size)
    values, flags = np.full(index.size, np.nan), np.full(index.size, Flag.MISSING, np.uint8)
    values[inside], flags[inside] = x[index[inside]], marks[index[inside]]
    return values, flags
