"""The Kalman smoother in place of both integrations."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import ceil, log2
from typing import ClassVar

from floatref.stages.kalman.filter import Filtered, KalmanStage
from floatref.stages.kalman.inputs import IMU
from floatref.stages.kalman.line import Closing, Line
from floatref.stages.kalman.noise import Noise
from floatref.stages.kalman.references import Plan
from floatref.stages.protocol import Declared
from floatref.stages.signals import ACCELERATION, DISTANCE, REFERENCE_HEIGHT, SIGMA
from floatref.values.arrays import FlagArray
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId

SEGMENT_S = 4.0
"""Duration of a segment, but for its power of two in samples."""
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
        self._length = 1 << max(0, round(log2(SEGMENT_S / header.step)))
        rule = Closing(header.step, self.tolerance_m, self.wavelength_m, self.noise.height_m)
        self.memory["lines"] = {track: Line(rule) for track in header.tracks}
        self.memory["blocks"] = []
        self.memory["closed"] = 0
        out = out.adding(*(ChannelId(SIGMA, track) for track in header.tracks))
        self._made = out.channels
        return out

    def advance(self, block: Block) -> Block:
        """Filter the block; return the block that is ready by now, if one is."""
        if len(block) == 0:
            return self._nothing(block)
        found, distance = self.forward(block), block[ChannelId(DISTANCE)]
        for track, passed in found.items():
            line: Line = self.memory["lines"][track]
            line.heights.append((block.first, passed.height))
            line.add(passed.nodes, distance[passed.nodes.at[:, 0] - block.first])
        full = range(block.first // self._length, (block.first + len(block)) // self._length)
        for number in full:
            self._end_segment((number + 1) * self._length)
        self.memory["blocks"].append(self._without_inputs(block, found))
        return next(self._closed_blocks(), None) or self._nothing(block)

    def close(self) -> tuple[Block, ...]:
        """Return all that is left."""
        for track, (nodes, beyond) in self.ending().items():
            line: Line = self.memory["lines"][track]
            last = self.memory["blocks"][-1][ChannelId(DISTANCE)][-1:]
            line.add(nodes, last[: len(nodes.at)])
            if any(len(nodes.at) for nodes in line.parts):
                line.end_segment(ALL)
            if line.segments:
                line.close(len(line.segments), beyond)
        self.memory["closed"] = ALL
        return tuple(self._closed_blocks())

    def _end_segment(self, sample: int) -> None:
        """End the segments before ``sample``, and close those that are ready."""
        lines: list[Line] = list(self.memory["lines"].values())
        for line in lines:
            line.end_segment(sample)
        waiting = ceil(self.waiting_s / (self._length * lines[0].rule.step))
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
                height, deviation = line.take()
                values[ChannelId(REFERENCE_HEIGHT, track)] = height
                values[ChannelId(SIGMA, track)] = deviation
            yield block.setting(values)

    def _nothing(self, block: Block) -> Block:
        """Return an empty block at the place of the next one, ``block`` if none is kept."""
        blocks: list[Block] = self.memory["blocks"]
        return self.empty((blocks[0] if blocks else block).first)

    def _without_inputs(self, block: Block, found: Mapping[str, Filtered]) -> Block:
        flags: dict[ChannelId, FlagArray] = {}
        for track, passed in found.items():
            if passed.flags is not None:
                names = REFERENCE_HEIGHT, SIGMA
                flags |= {ChannelId(name, track): passed.flags for name in names}
        return block.setting({}, flags).without(ACCELERATION, *IMU)
