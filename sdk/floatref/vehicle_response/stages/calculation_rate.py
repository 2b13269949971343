"""From the sensors' rate to that of the calculation, which follows the speed."""

from dataclasses import replace
from fractions import Fraction
from math import ceil, isfinite
from typing import Any, ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import CUTOFF, DISTANCE, TRAVEL_SPEED
from floatref.values.arrays import FlagArray, FloatArray, frozen
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId
from floatref.vehicle_response.stages.lower_rate import Resampling, Waiting

LINEAR = DISTANCE, TRAVEL_SPEED, CUTOFF
"""Channels that are linear between samples: the controls of stages must not overshoot."""
LONG = 1 << 62
"""A number of samples above that of any run: the windows of a low rate are long."""


class ToRate(Stage):
    """Gives every channel at ``rate_hz``, not above the stream's own: section 4.3 of Zhu.

    Channels of a wheel path are resampled by a windowed sinc without delay, with their first and
    last sample repeated beyond the ends; `distance`, `travel_speed` and `high_pass_cutoff` are
    linear. An output has the flags of all samples less than one new step away; the error of a
    flagged sample reaches as far as the window. Output 0 lies at the first sample, the last one at
    the last sample or less than a new step beyond.
    """

    declared: ClassVar[Declared] = Declared(shift_invariant=False, delay=LONG)

    def __init__(self, rate_hz: Fraction, end_m: float = -np.inf) -> None:
        """Resample to ``rate_hz``; `distance` ends at ``end_m`` or farther."""
        super().__init__()
        self.rate_hz, self.end_m = rate_hz, end_m
        self._resampling = Resampling(1.0, 1.0)
        self._made: frozenset[ChannelId] = frozenset()

    def open(self, header: Header) -> Header:
        """Ask for the time axis; InputError for a rate above the stream's."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        self._resampling = Resampling(float(header.rate), float(self.rate_hz))
        self._made = header.channels
        self.memory = {"runs": {}, "waiting": None, "begun": 0, "next": 0}
        return replace(header, rate=self.rate_hz, step=float(1 / self.rate_hz))

    def advance(self, block: Block) -> Block:
        """Return the outputs whose windows are complete."""
        if len(block) == 0:
            return Block(self.memory["next"], dict.fromkeys(self._made, frozen(())))
        if self.memory["waiting"] is None:
            self._begin(block)
        waiting: Block | None = self.memory["waiting"]
        wide = block if waiting is None else join_blocks((waiting, block))
        runs: dict[ChannelId, Waiting] = self.memory["runs"]
        found = {c: self._resampling.advance(runs[c], block[c]) for c in runs}
        return self._out(wide, found)

    def close(self) -> tuple[Block, ...]:
        """Return the rest, the last sample repeated."""
        waiting: Block | None = self.memory["waiting"]
        if waiting is None or len(waiting) == 0:
            return ()
        last = waiting.first + len(waiting) - 1 - self.memory["begun"]
        count = ceil(last / self._resampling.ratio) + 1 - self.memory["next"]
        found = {}
        for channel, run in self.memory["runs"].items():
            end = np.full(self._beyond, waiting[channel][-1])
            more = self._resampling.advance(run, end), self._resampling.finish(run)
            found[channel] = np.concatenate(more)[:count]
        return (self._at_the_end(self._out(waiting, found)),)

    def _at_the_end(self, block: Block) -> Block:
        """Return the last block, its last distance that of the encoder until then."""
        end = {c: x.copy() for c, x in block.values.items() if c.name == DISTANCE and x.size}
        for distance in end.values():
            distance[-1] = max(distance[-1], self.end_m)
        return block.setting(end)

    @property
    def _beyond(self) -> int:
        return ceil(self._resampling.reach_s * self._resampling.from_hz) + 1

    def _begin(self, block: Block) -> None:
        size = self._beyond
        self.memory["begun"] = block.first
        self.memory["runs"] = {
            c: Waiting(np.full(size, x[0]), -size)
            for c, x in block.values.items()
            if c.name not in LINEAR
        }

    def _out(self, wide: Block, found: dict[ChannelId, FloatArray]) -> Block:
        """Return ``found`` with the linear channels and all flags; drop the input that is done."""
        first, ratio = self.memory["next"], self._resampling.ratio
        size = next(iter(found.values())).size
        at = np.arange(first, first + size) * ratio - (wide.first - self.memory["begun"])
        place = np.arange(len(wide))
        linear = {c: np.interp(at, place, x) for c, x in wide.values.items() if c.name in LINEAR}
        flags = {c: _gather(f, at, ratio) for c, f in wide.flags.items()}
        self.memory["next"] = first + size
        done = ceil((first + size - 1) * ratio) - (wide.first - self.memory["begun"]) - 1
        self.memory["waiting"] = _bare(wide).part(max(0, min(done, len(wide) - 1)), len(wide))
        return Block(first, {**found, **linear}, flags=flags)


def _gather(flags: FlagArray, at: FloatArray, ratio: float) -> FlagArray:
    """Return the flags less than ``ratio`` samples from each of ``at``."""
    low = np.clip(np.floor(at - ratio).astype(np.int64) + 1, 0, flags.size)
    high = np.clip(np.ceil(at + ratio).astype(np.int64), low, flags.size)
    pairs = np.stack([low, high], axis=1).reshape(-1)
    if not pairs.size:
        return np.zeros(0, np.uint8)
    found: Any = np.bitwise_or.reduceat(np.append(flags, np.uint8(0)), pairs)[::2]
    return np.asarray(np.where(high > low, found, np.uint8(0)))


def _bare(block: Block) -> Block:
    """Return ``block`` without its masks of fresh samples and its events."""
    return Block(block.first, block.values, flags=block.flags)


POINTS_PER_M = 20.0
"""Samples per metre of road: half of them, 10 cycles/m, is the highest wave number seen."""


def calculation_rate(speed_mps: float) -> float:
    """Return the rate f = 20·v in Hz for a speed in m/s, section 4.3 of Zhu.

    The spacing of the estimate over distance is then 0.05 m at every speed. Raises InputError
    unless the speed is a finite number above zero.
    """
    if not (isfinite(speed_mps) and speed_mps > 0):
        raise InputError(
            f"the calculation rate follows the speed, which is {speed_mps:g} m/s; "
            "give the part of the drive that has a speed above zero"
        )
    return POINTS_PER_M * speed_mps
