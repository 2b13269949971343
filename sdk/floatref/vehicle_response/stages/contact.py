"""Restores the short waves that a tyre averages over its contact."""

from typing import Any, ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ELEVATION
from floatref.values.arrays import Flag, FloatArray
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId

FULL, NONE = 0.5, 0.8
"""Wave numbers, in cycles per contact length, up to which waves are restored in full, and
from which on they are not: beyond, the mean over the contact is mostly noise."""
REACH = 8.0
"""Contact lengths to either side that a point's correction is calculated from."""
SHAPE = 5.0
"""Parameter of the Kaiser window."""


class RestoreContact(Stage):
    """Divides `elevation` by the gain sin(πnL)/(πnL) of a mean over the contact length L.

    In full up to half a cycle per L, a gain of 1/0.64, and less and less up to 0.8. The filter is
    symmetrical, so it shifts no wave; blocks wait for the points that it needs. A point with a
    missing one within eight contact lengths is not changed.
    """

    declared: ClassVar[Declared] = Declared(delay=1 << 62)

    def __init__(self, contact_m: float) -> None:
        """Restore waves averaged over ``contact_m``; InputError unless it is above zero."""
        super().__init__()
        if not (np.isfinite(contact_m) and contact_m > 0):
            raise InputError(
                f"stage {self.name}: a contact of {contact_m:g} m; give the length over which the "
                "tyre levels the road, in m, above zero"
            )
        self.contact_m = contact_m
        self._taps = np.empty(0)
        self._made: tuple[ChannelId, ...] = ()

    def open(self, header: Header) -> Header:
        """Ask for the elevation over distance."""
        if header.axis is not Axis.DISTANCE:
            raise InputError(f"stage {self.name}: the stream is not on the distance axis")
        self._made = tuple(ChannelId(ELEVATION, track) for track in header.tracks)
        header.require(self.name, *self._made)
        self._taps = correction(self.contact_m, header.step)
        self.memory = {"waiting": None, "next": None}
        return header

    def advance(self, block: Block) -> Block:
        """Return the points whose neighbours are all known."""
        waiting: Block | None = self.memory["waiting"]
        wide = block if waiting is None else join_blocks((waiting, block))
        if self.memory["next"] is None:
            self.memory["next"] = wide.first
        return self._until(wide, wide.first + len(wide) - self._taps.size + 1)

    def close(self) -> tuple[Block, ...]:
        """Return the points held back; beyond the end nothing is known."""
        waiting: Block | None = self.memory["waiting"]
        return () if waiting is None else (self._until(waiting, waiting.first + len(waiting)),)

    def _until(self, wide: Block, end: int) -> Block:
        """Return the points up to ``end`` and store the points that later ones need."""
        first, reach = self.memory["next"], self._taps.size - 1
        end = max(first, end)
        low, high = first - wide.first, end - wide.first
        values = {
            c: wide[c][low:high] + self._change(_sound(wide, c), low, high) for c in self._made
        }
        self.memory["next"] = end
        kept = max(0, high - reach)
        self.memory["waiting"] = wide.part(min(kept, len(wide)), len(wide))
        return wide.part(low, high).setting(values)

    def _change(self, x: FloatArray, low: int, high: int) -> FloatArray:
        """Return the correction at ``low`` to ``high - 1``; beyond ``x`` nothing is known."""
        reach = self._taps.size - 1
        padded = np.full(high - low + 2 * reach, np.nan)
        begin, end = max(low - reach, 0), min(high + reach, x.size)
        at = begin - low + reach
        padded[at : at + end - begin] = x[begin:end]
        # One tap after the other: the same sum for any length of a block.
        change: FloatArray = self._taps[0] * padded[reach : reach + high - low]
        for lag, tap in enumerate(self._taps[1:], start=1):
            before = padded[reach - lag : reach - lag + high - low]
            change += tap * (before + padded[reach + lag : reach + lag + high - low])
        return np.where(np.isnan(change), 0.0, change)


def _sound(block: Block, channel: ChannelId) -> FloatArray:
    """Return the samples of ``channel``, NaN where they are flagged as missing."""
    marks = flags_of(block, channel)
    if marks is None:
        return block[channel]
    return np.where(marks & np.uint8(Flag.MISSING), np.nan, block[channel])


def correction(contact_m: float, interval_m: float) -> FloatArray:
    """Return one half, the middle first, of the filter that gives the correction.

    The inverse transform of its gain, windowed; a constant is left as it is.
    """
    reach = max(1, round(REACH * contact_m / interval_m))
    size = 8 * reach
    cycles = np.fft.rfftfreq(size, interval_m) * contact_m
    levelled = 1.0 / np.sinc(np.minimum(cycles, FULL)) - 1.0
    fading = np.clip((cycles - FULL) / (NONE - FULL), 0.0, 1.0)
    gain = levelled * np.cos(np.pi / 2 * fading) ** 2
    window: Any = np.kaiser(2 * reach + 1, SHAPE)[reach:]
    taps = np.fft.irfft(gain, size)[: reach + 1] * window
    taps[0] -= taps[0] + 2.0 * taps[1:].sum()
    return np.asarray(taps)
