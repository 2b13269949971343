"""The Kalman smoother in place of both integrations."""

from collections.abc import Iterator
from dataclasses import replace
from math import ceil
from typing import ClassVar

import numpy as np

from floatref.stages.kalman.filter import KalmanStage
from floatref.stages.kalman.inputs import IMU
from floatref.stages.kalman.line import Closing, Line
from floatref.stages.kalman.noise import Noise
from floatref.stages.kalman.references import Plan
from floatref.stages.kalman.track import sub_block
from floatref.stages.protocol import Declared
from floatref.stages.signals import ACCELERATION, DISTANCE, REFERENCE_HEIGHT, SIGMA
from floatref.values.arrays import FlagArray
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId

SUB_BLOCKS, SEGMENT_S = 400, 4.0
"""Sub-blocks of a segment, and its duration."""
WAITING_S = 60.0
"""A segment waits so long, whatever the bound says: what changes since at the place where one part
has come out and the next has not would be a step there."""
TOLERANCE_M = 2e-6
"""1-σ of what later readings may still change when a segment is closed."""
ALL = 1 << 62
"""More samples than any run has."""


class KalmanSmoother(KalmanStage):
    """Filter and smoother (section 6.6.2 and its variants).

    Adds `floating_reference_height`, and `elevation_sigma`: 1-σ of the elevation after HPF_B3x2 at
    ``wavelength_m``. Segments of four seconds are smoothed once the readings behind them no longer
    matter, and a block comes out with each that is pushed from then on. What is kept until then
    depends on the drive, not on its length (section 7.3.4).
    """

    declared: ClassVar[Declared] = replace(KalmanStage.declared, delay=ALL)

    def __init__(
        self,
        plan: Plan,
        noise: Noise,
        wavelength_m: float = 105.91,
        tolerance_m: float = TOLERANCE_M,
        waiting_s: float = WAITING_S,
    ) -> None:
        """Observe what ``plan`` says, with ``noise``.

        Segments are closed within ``tolerance_m``, after ``waiting_s`` at the earliest.
        """
        super().__init__(plan, noise, wavelength_m)
        self.tolerance_m, self.waiting_s = tolerance_m, waiting_s
        self._length = 1

    def open(self, header: Header) -> Header:
        """Begin with nothing kept."""
        out = super().open(header)
        self._length = SUB_BLOCKS * sub_block(header.step)
        rule = Closing(header.step, self.tolerance_m, self.wavelength_m, self.noise.height_m)
        self.memory["lines"] = {track: Line(rule) for track in header.tracks}
        self.memory["blocks"] = []
        self.memory["closed"] = 0
        return out.adding(*(ChannelId(SIGMA, track) for track in header.tracks))

    def advance(self, block: Block) -> Block:
        """Filter the block; return the blocks whose segments are closed."""
        if len(block) == 0:
            return self._nothing(block)
        for part, full in self._split(block):
            distance = part[ChannelId(DISTANCE)]
            for track, (height, nodes) in self.forward(part).items():
                line: Line = self.memory["lines"][track]
                line.add(height, nodes, distance[nodes.at[:, 0] - part.first])
            if full:
                self._end_segment()
        self.memory["blocks"].append(self._without_inputs(block))
        return next(self._closed_blocks(), None) or self._nothing(block)

    def close(self) -> tuple[Block, ...]:
        """Return all that is left."""
        ending = self.ending()
        for track, line in self.memory["lines"].items():
            if track in ending and len(ending[track].at):
                last = self.memory["blocks"][-1][ChannelId(DISTANCE)][-1:]
                line.add(np.empty(0), ending[track], last)
            if line.heights:
                line.end_segment()
            if line.segments:
                line.close(len(line.segments))
        self.memory["closed"] = ALL
        return tuple(self._closed_blocks())

    def _split(self, block: Block) -> Iterator[tuple[Block, bool]]:
        """Yield ``block`` in parts; the flag tells those that end a segment."""
        begin, end = 0, len(block)
        while begin < end:
            sample = block.first + begin
            last = max(-(-sample // self._length), 1) * self._length
            stop = min(begin + last - sample + 1, end)
            yield block.part(begin, stop), block.first + stop == last + 1
            begin = stop

    def _end_segment(self) -> None:
        lines: list[Line] = list(self.memory["lines"].values())
        for line in lines:
            line.end_segment()
        waiting = ceil(self.waiting_s / SEGMENT_S)
        # What is smoothed again later shall not be more than what is closed.
        least, open_ones = max(waiting, 1), len(lines[0].segments)
        if open_ones < 2 * least:
            return
        count = min(min(line.ready() for line in lines), open_ones - waiting)
        if 2 * count >= open_ones:
            self.memory["closed"] = lines[0].segments[count - 1].last + 1
            for line in lines:
                line.close(count)

    def _closed_blocks(self) -> Iterator[Block]:
        """Yield the blocks that are kept and lie before the last closed sample."""
        blocks = self.memory["blocks"]
        while blocks and blocks[0].first + len(blocks[0]) <= self.memory["closed"]:
            block = blocks.pop(0)
            values = {}
            for track, line in self.memory["lines"].items():
                height, deviation = line.take(len(block))
                values[ChannelId(REFERENCE_HEIGHT, track)] = height
                values[ChannelId(SIGMA, track)] = deviation
            yield block.setting(values)

    def _nothing(self, block: Block) -> Block:
        """Return an empty block at the place of the next one, ``block`` if none is kept."""
        blocks: list[Block] = self.memory["blocks"]
        return self.empty(blocks[0] if blocks else block, SIGMA)

    def _without_inputs(self, block: Block) -> Block:
        flags: dict[ChannelId, FlagArray] = {}
        for channels in self._channels:
            marks = self.flags(block, channels)
            if marks is not None:
                names = REFERENCE_HEIGHT, SIGMA
                flags |= {ChannelId(name, channels.track): marks for name in names}
        return block.setting({}, flags).without(ACCELERATION, *IMU)
