"""From samples that the encoder triggered back to a stream in time."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ACCELERATION, DISTANCE, HEIGHT, MISSING_SHARE, TIME
from floatref.values.arrays import (
    LASTING,
    BoolArray,
    Flag,
    FlagArray,
    FloatArray,
    IndexArray,
    frozen,
)
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId

NEAR_S = 1e-3
"""Distance from a trigger, in s, within which the reading of the height sensor is valid."""
TIE = 1e-6
"""Share of a step by which a trigger may differ from the sample that it is put on."""
LONGEST_S = 10.0
"""Longest duration of an interval; the motion before it no longer matters afterwards."""
JOLT_M_S = 2e-3
"""Speed lost or won from one interval to the next, times the share of the speed that it is and the
square of the duration, at which the line has no information: the body moves as a brake ends."""


class ToTime(Stage):
    """Turns samples at the triggers, with their `time`, into a stream at the recording's rate.

    All channels are linear between triggers, `distance` too, which is exact at a trigger; it is NaN
    where the encoder has lost travel, which is known by the flag `SLOW` of a height. The shared
    channel `missing_share` is the share of the acceleration that a line misses: the missed
    amplitude grows with the square of the interval, its square is the share, and that is 1 where an
    interval lasts ``unknown_s``, or less with a jolt (`JOLT_M_S`). The acceleration is reduced by
    that share. A height away from any trigger is flagged. A sample has the flags of the trigger
    behind it, and the non-lasting ones of the trigger before it. The distance has those of the
    time, where the encoder gives no travel or makes it up.

    An interval of more than `LONGEST_S` is cut to that duration, so that a stop of an hour does not
    give an hour of samples. Sample 0 lies at the first trigger.
    """

    declared: ClassVar[Declared] = Declared(shift_invariant=False)

    def __init__(self, unknown_s: float = 0.8) -> None:
        """Take the acceleration for unknown in intervals of ``unknown_s``."""
        super().__init__()
        self.unknown_s = unknown_s
        self._header: Header | None = None
        self._made: frozenset[ChannelId] = frozenset()

    def open(self, header: Header) -> Header:
        """Ask for the times of the triggers, and what the accelerometers and lasers read then."""
        if header.axis is not Axis.DISTANCE:
            raise InputError(f"stage {self.name}: the stream is not on the distance axis")
        own = [ChannelId(n, track) for n in (ACCELERATION, HEIGHT) for track in header.tracks]
        header.require(self.name, ChannelId(TIME), *own)
        self._header = header
        self.memory = {"carry": None, "next": 0, "start": 0.0, "cut": 0.0, "lasted": np.nan}
        out = header.without(TIME).adding(ChannelId(DISTANCE), ChannelId(MISSING_SHARE))
        self._made = out.channels
        return replace(out, axis=Axis.TIME, step=float(1 / header.rate), origin=0.0)

    def advance(self, block: Block) -> Block:
        """Return the samples up to the last trigger of the block."""
        if len(block) == 0:
            return Block(self.memory["next"], dict.fromkeys(self._made, frozen(())))
        carry: Block | None = self.memory["carry"]
        wide = block if carry is None else join_blocks((carry, block))
        if carry is None:
            self.memory["start"] = self._count(wide)[0]
        places, cut = self._places(wide)
        share = self._shares(places)
        end = int(places[-1]) + 1
        out = self._sample(wide, places, share, end)
        # Triggers behind the last sample are needed for the next one.
        kept = int(np.searchsorted(places, end - 1, "right")) - 1
        if kept > 0:
            self.memory["lasted"] = float(places[kept] - places[kept - 1])
        self.memory["carry"], self.memory["cut"] = wide.part(kept, len(wide)), float(cut[kept])
        return out

    def close(self) -> tuple[Block, ...]:
        """Return one sample more if the last trigger lies behind the last."""
        carry: Block | None = self.memory["carry"]
        if carry is None or len(carry) == 1:
            return ()
        places, _ = self._places(carry)
        share = self._shares(places)
        places[-1] = self.memory["next"]
        return (self._sample(carry, places, share, self.memory["next"] + 1),)

    def _count(self, block: Block) -> FloatArray:
        """Return the times of the triggers in steps of the recording's clock."""
        assert self._header is not None
        return block[ChannelId(TIME)] * float(self._header.rate)

    def _places(self, wide: Block) -> tuple[FloatArray, FloatArray]:
        """Return the triggers' times in samples of the output, and how many were cut out."""
        assert self._header is not None
        times = self._count(wide)
        over = np.floor(np.diff(times) - LONGEST_S * float(self._header.rate) + TIE)
        cut = self.memory["cut"] + np.append(0.0, np.cumsum(np.maximum(over, 0.0)))
        places = times - self.memory["start"] - cut
        near = np.rint(places)
        return np.where(np.abs(places - near) < TIE, near, places), cut

    def _shares(self, places: FloatArray) -> FloatArray:
        """Return the missing share of the interval that ends with each trigger."""
        assert self._header is not None
        step = float(1 / self._header.rate)
        lasts = np.diff(places) * step
        before = np.append(self.memory["lasted"] * step, lasts[:-1])
        short, long = np.fmin(lasts, before), np.fmax(lasts, before)
        # Several triggers at one moment change no speed.
        speed = np.divide(self._header.step, short, where=short > 0.0, out=np.zeros(lasts.size))
        lost = np.divide(long - short, long, where=long > 0.0, out=np.zeros(lasts.size))
        jolt = speed * (lost * lasts) ** 2 / JOLT_M_S
        return np.append(0.0, np.minimum(((lasts / self.unknown_s) ** 2 + jolt) ** 2, 1.0))

    def _sample(self, wide: Block, places: FloatArray, shares: FloatArray, end: int) -> Block:
        """Return the samples before ``end`` that were not yet returned."""
        assert self._header is not None
        header, first = self._header, self.memory["next"]
        self.memory["next"] = end
        between = Between.of(places, np.arange(first, end))
        share, step = shares[between.behind], float(1 / header.rate)
        points = np.arange(wide.first, wide.first + len(wide), dtype=np.float64)
        distance = between.line(header.origin + points * header.step)
        distance[self._find_unknown(wide, between)] = np.nan
        values = {ChannelId(DISTANCE): distance, ChannelId(MISSING_SHARE): share}
        known = np.where(between.part < 1.0, 1.0 - share, 1.0)
        for channel, x in wide.without(TIME).values.items():
            values[channel] = between.line(x)
            if channel.name == ACCELERATION:
                values[channel] *= known
        flags = _mark(wide, between, between.apart * step > NEAR_S)
        marks = between.marks(wide.flags.get(ChannelId(TIME)))
        if marks is not None and marks.any():
            flags[ChannelId(DISTANCE)] = marks
        return Block(first, values, flags=flags)

    def _find_unknown(self, wide: Block, between: "Between") -> BoolArray:
        """Return the samples of unknown distance, where the encoder has lost travel.

        The sample next to the trigger before is not among them: later stages need it to find the
        gap.
        """
        assert self._header is not None
        flags = wide.flags.get(ChannelId(HEIGHT, self._header.tracks[0]))
        if flags is None:
            return np.zeros(between.part.size, np.bool_)
        lost = (flags & np.uint8(Flag.SLOW)) != 0
        found: BoolArray = lost[between.behind] & (between.gone >= 1.0)
        return found


@dataclass(frozen=True, eq=False)
class Between:
    """Where samples lie between the triggers before and behind them.

    Attributes:
        before, behind: numbers of these; one and the same at a trigger.
        part: of the way from one to the other.
        gone: since the one before, in samples.
        apart: from the nearer one, in samples.
    """

    before: IndexArray
    behind: IndexArray
    part: FloatArray
    gone: FloatArray
    apart: FloatArray

    @classmethod
    def of(cls, places: FloatArray, samples: IndexArray) -> "Between":
        """Return that of ``samples``; all lie before the last of the triggers at ``places``."""
        behind = np.searchsorted(places, samples)
        before = np.maximum(behind - 1, 0)
        left = places[behind] - samples
        before = np.where(left > 0.0, before, behind)
        gone = samples - places[before]
        part = np.divide(gone, gone + left, where=left > 0.0, out=np.ones(samples.size))
        return cls(before, behind, part, gone, np.minimum(gone, left))

    def line(self, x: FloatArray) -> FloatArray:
        """Return ``x`` of the triggers on the line between them."""
        start = x[self.before]
        found: FloatArray = start + self.part * (x[self.behind] - start)
        return found

    def marks(self, flags: FlagArray | None) -> FlagArray | None:
        """Return the flags of the samples from those of the triggers."""
        if flags is None or self.behind.size == 0:
            return None
        lasting = np.uint8(LASTING)
        # Between two samples there may be several triggers.
        first = np.minimum(np.append(1, self.behind[:-1] + 1), self.behind)
        since = np.bitwise_or.reduceat(flags[: self.behind[-1] + 1] & lasting, first)
        found: FlagArray = since | flags[self.behind] | (flags[self.before] & ~lasting)
        return found


def _mark(wide: Block, between: Between, far: BoolArray) -> dict[ChannelId, FlagArray]:
    """Return the flags of all channels that have some; heights are missing where it is ``far``."""
    found, missing = {}, np.where(far, np.uint8(Flag.MISSING), np.uint8(0))
    for channel in wide.without(TIME).values:
        marks = between.marks(wide.flags.get(channel))
        if channel.name == HEIGHT:
            marks = missing if marks is None else marks | missing
        if marks is not None and marks.any():
            found[channel] = marks
    return found
