"""One channel on another clock: passed through, or linear between its samples."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.screening.damage.damaged_samples import Damage, within
from floatref.stages.signals import DISTANCE
from floatref.values.arrays import BoolArray, FloatArray, IndexArray, release
from floatref.values.clock import Clock, StampedClock, UniformClock
from floatref.values.recording import Channel
from floatref.values.scanning import CHUNK, median_step

APART = 0.01
"""Largest distance of the samples of two clocks of one rate that agree, in steps."""
GAP = 5.0
"""Distance of time stamps in median steps that counts as a gap; not for an encoder at a stop."""
BRIDGE_S = 0.01
"""Longest gap in s that a line bridges well: its error is a tenth of a 15-Hz swing of the body."""
BLIND_S = 0.5
"""A gap of the encoder longer than this, in s, can hide a stop."""
TURN_S = 0.1
"""Gap in s over which a line misses a 2-Hz pitch of the body by a few hundredths of a degree."""
BRIDGES_S = {DISTANCE: BLIND_S, **dict.fromkeys(("roll_rate", "pitch_rate", "yaw_rate"), TURN_S)}
"""Longest gap in s to bridge, for channels where it is not `BRIDGE_S`."""
FAR = 1 << 40
"""Number of samples to the next known one, if no such sample exists."""
LOOK = 4096
"""Samples searched in one go for the end of a gap."""
Read = Callable[[int, int], FloatArray]
"""A function that returns a channel's samples from one index up to another, NaN if missing."""


@dataclass(frozen=True, eq=False)
class Stretch:
    """Samples of a channel on the clock of the blocks, with masks of their kinds.

    ``missing`` samples were bridged; of these, ``lost`` ones lie in a gap longer than `BRIDGE_S`,
    or the channel's entry in `BRIDGES_S`, or in one of lasting damage. Samples of void damage are
    NaN.
    """

    values: FloatArray
    fresh: BoolArray | None = None
    missing: BoolArray | None = None
    lost: BoolArray | None = None


class AlignedChannel:
    """A channel resampled to ``clock``; ``first`` is the clock's sample that counts as 0."""

    def __init__(
        self, channel: Channel, clock: UniformClock, first: int, damage: Damage | None = None
    ) -> None:
        """Find out whether the two clocks agree; samples of ``damage`` count as missing.

        Raises InputError if no sample remains.
        """
        self.channel = channel
        self._damage = damage or Damage()
        self._check_sound()
        self._clock, self._first = clock, first
        self._offset = _common_grid(channel.clock, clock)
        self._gap_s = _gap(channel)
        self._bridge_s = BRIDGES_S.get(channel.id.name, BRIDGE_S)

    def take(self, begin: int, end: int) -> Stretch:
        """Return samples ``begin`` to ``end - 1``, which lie within the channel's span."""
        if self._offset is not None:
            low = begin + self._first + self._offset
            longest = int(self._bridge_s * float(self._clock.rate))
            values, missing, lost = self._samples(low, low + end - begin, longest)
            return Stretch(values, missing=missing, lost=lost)
        before = max(begin - 1, 0)
        place = self._places(self._clock.times(end - before, self._first + before))
        low = int(place[0])
        high = min(math.ceil(place[-1]) + 1, self.channel.values.size)
        longest = int(self._bridge_s * self.channel.mean_rate_hz)
        samples, missing, lost = self._samples(low, high, longest)
        values = np.interp(place, np.arange(low, high), samples)
        fresh = np.diff(np.floor(place), prepend=-1.0 if begin == before else np.nan) > 0
        skip = begin - before
        masks = [
            self._between(place, low, mask, apart_s)
            for mask, apart_s in ((missing, 0.0), (lost, self._bridge_s))
        ]
        gone, far = (None if mask is None else mask[skip:] for mask in masks)
        return Stretch(values[skip:], fresh[skip:], gone, far)

    def release(self) -> None:
        """Release the memory of the samples read, if they lie in a file."""
        release(self.channel.values)
        if isinstance(self.channel.clock, StampedClock):
            release(self.channel.clock.times_s)

    def _samples(
        self, low: int, high: int, longest: int
    ) -> tuple[FloatArray, BoolArray | None, BoolArray | None]:
        """Return samples ``low`` to ``high - 1``, which of them are missing, and which are lost."""
        values, missing, lost = bridge(self._sound, self.channel.values.size, low, high, longest)
        void = within(self._damage.void, low, high)
        if void is not None:
            values = np.where(void, np.nan, values)
        lasting = within(self._damage.lasting, low, high)
        if lasting is not None:
            lost = lasting if lost is None else lost | lasting
        return values, missing, lost

    def _check_sound(self) -> None:
        size = self.channel.values.size
        if all(np.isnan(self._sound(at, at + CHUNK)).all() for at in range(0, size, CHUNK)):
            raise InputError(
                f"channel {self.channel.id}: no sample measures anything, all are missing, stuck "
                "or out of range; connect the sensor, or leave the track out"
            )

    def _sound(self, low: int, high: int) -> FloatArray:
        """Return samples ``low`` to ``high - 1``; damaged samples are NaN."""
        values = self.channel.values[low:high]
        high = low + values.size
        for spans in (self._damage.gone, self._damage.void):
            mask = within(spans, low, high)
            if mask is not None:
                values = np.where(mask, np.nan, values)
        return values

    def _places(self, times: FloatArray) -> FloatArray:
        clock, last = self.channel.clock, self.channel.values.size - 1
        if isinstance(clock, UniformClock):
            return np.clip((times - clock.start_s) * float(clock.rate), 0.0, last)
        low = max(int(np.searchsorted(clock.times_s, times[0], "right")) - 1, 0)
        high = min(int(np.searchsorted(clock.times_s, times[-1])) + 1, last + 1)
        return np.interp(times, clock.times_s[low:high], np.arange(low, high, dtype=np.float64))

    def _between(
        self, place: FloatArray, low: int, mask: BoolArray | None, apart_s: float
    ) -> BoolArray | None:
        """Return which places use a sample of ``mask``, or lie in a gap of more than ``apart_s``.

        The first place behind a jump of the encoder is marked, at any rate of its samples.
        """
        before, after = np.floor(place).astype(np.int64), np.ceil(place).astype(np.int64)
        passed = before.copy()
        if self.channel.id.name == DISTANCE:
            passed[1:] = np.minimum(before[:-1] + 1, before[1:])
        found = None
        if mask is not None:
            counts = np.cumsum(np.append(0, mask))
            found = counts[after + 1 - low] > counts[passed - low]
        if self._gap_s is None or not isinstance(self.channel.clock, StampedClock):
            return found
        times, most_s = self.channel.clock.times_s, max(self._gap_s, apart_s)
        # A receiver has one sample for a thousand places, and a gap hardly ever.
        if not (np.diff(times[low : int(after[-1]) + 1]) > most_s).any():
            return found
        wide: BoolArray = times[after] - times[before] > most_s
        return wide if found is None else np.logical_or(found, wide)


def bridge(
    read: Read, size: int, low: int, high: int, longest: int = 0
) -> tuple[FloatArray, BoolArray | None, BoolArray | None]:
    """Return samples ``low`` to ``high - 1``, NaN bridged linearly, and which were bridged.

    ``size`` is the number of samples that can be read. The last array marks those that lie in a gap
    of more than ``longest`` samples, or one that is open at an end of the channel.
    """
    part = read(low, high)
    if not np.isnan(part.sum()):
        return part, None, None
    missing = np.isnan(part)
    inside = np.flatnonzero(~missing)
    left, before = _good_before(read, low)
    right, after = _good_after(read, high, size)
    known = np.concatenate((left, inside + low, right))
    where = np.arange(low, high)
    lost = missing & (_gap_lengths(known, where) > longest)
    there = np.concatenate((before, part[inside], after))
    return np.interp(where, known, there), missing, lost


def _gap_lengths(known: IndexArray, where: IndexArray) -> IndexArray:
    """Return the number of samples between the known ones on both sides of each of ``where``."""
    edges = np.concatenate(([-FAR], known, [known[-1] + FAR]))
    after = np.searchsorted(edges, where, "right")
    return np.asarray(edges[after] - edges[after - 1] - 1)


def _good_before(read: Read, low: int) -> tuple[IndexArray, FloatArray]:
    """Return index and value of the last known sample before ``low``, or empty arrays."""
    for end in range(low, 0, -LOOK):
        values = read(max(end - LOOK, 0), end)
        good = np.flatnonzero(~np.isnan(values))[-1:]
        if good.size:
            return good + max(end - LOOK, 0), values[good]
    return np.empty(0, np.int64), np.empty(0)


def _good_after(read: Read, high: int, size: int) -> tuple[IndexArray, FloatArray]:
    """Return index and value of the first known sample from ``high`` on."""
    for begin in range(high, size, LOOK):
        values = read(begin, min(begin + LOOK, size))
        good = np.flatnonzero(~np.isnan(values))[:1]
        if good.size:
            return good + begin, values[good]
    return np.empty(0, np.int64), np.empty(0)


def _common_grid(clock: Clock, other: UniformClock) -> int | None:
    if not isinstance(clock, UniformClock) or clock.rate != other.rate:
        return None
    offset = (other.start_s - clock.start_s) * float(clock.rate)
    return round(offset) if abs(offset - round(offset)) < APART else None


def _gap(channel: Channel) -> float | None:
    if channel.id.name == DISTANCE or not isinstance(channel.clock, StampedClock):
        return None
    return GAP * median_step(channel.clock.times_s)
