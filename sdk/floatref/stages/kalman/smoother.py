"""The Kalman smoother in place of both integrations."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from floatref.kernels.kalman_layout import NODE, STATES
from floatref.stages.kalman.filter import KalmanStage
from floatref.stages.kalman.inputs import IMU
from floatref.stages.kalman.lag import closing
from floatref.stages.kalman.noise import Noise
from floatref.stages.kalman.nodes import Nodes
from floatref.stages.kalman.references import Plan
from floatref.stages.kalman.segment import Segment
from floatref.stages.signals import ACCELERATION, REFERENCE_HEIGHT
from floatref.values.arrays import FloatArray
from floatref.values.block import Block, Header, joined
from floatref.values.channels import ChannelId

SUB_BLOCKS = 400
"""Sub-blocks of a segment: four seconds."""
TOLERANCE_M = 2e-6
"""1-σ of what later readings may still change when a segment is closed."""


@dataclass(eq=False)
class Line:
    """What the smoother keeps of one wheel path: a segment in the making, and those not closed.

    ``smoothed`` are the heights of closed segments that have not come out yet.
    """

    heights: list[FloatArray] = field(default_factory=list)
    parts: list[Nodes] = field(default_factory=list)
    segments: list[Segment] = field(default_factory=list)
    before: int = -1
    origin: FloatArray = field(default_factory=lambda: np.zeros(NODE))
    datum: float = 0.0
    smoothed: list[FloatArray] = field(default_factory=list)

    def add(self, height: FloatArray, nodes: Nodes) -> None:
        """Keep what the filter made of a block."""
        self.heights.append(height)
        self.parts.append(nodes)

    def end_segment(self, step: float) -> None:
        """Make a segment of what was added; its last sample is a node."""
        segment = Segment.of(self.before, self.origin, self.heights, self.parts, step)
        self.segments.append(segment)
        self.before, self.origin = segment.last, segment.nodes.nodes[-1].copy()
        self.heights, self.parts = [], []

    def close(self, count: int, step: float) -> None:
        """Smooth the first ``count`` segments."""
        adjoint = np.zeros(STATES)
        found = []
        for segment in reversed(self.segments):
            corrections = segment.back(adjoint, step)
            found.append((corrections, adjoint.copy()))
        for segment, (corrections, behind) in zip(
            self.segments[:count], reversed(found), strict=False
        ):
            height, self.datum = segment.smoothed(corrections, behind, self.datum, step)
            self.smoothed.append(height)
        del self.segments[:count]

    def take(self, count: int) -> FloatArray:
        """Return the next ``count`` smoothed heights, which are there."""
        whole = np.concatenate(self.smoothed)
        self.smoothed = [whole[count:]]
        return whole[:count]


class KalmanSmoother(KalmanStage):
    """Filter and smoother (section 6.6.2 and its variants).

    A segment is smoothed, and comes out, once the readings behind it no longer matter.
    """

    def __init__(self, plan: Plan, noise: Noise, tolerance_m: float = TOLERANCE_M) -> None:
        """Observe what ``plan`` says, with ``noise``; close segments within ``tolerance_m``."""
        super().__init__(plan, noise)
        self.tolerance_m = tolerance_m
        self._step, self._length = 1.0, 1

    def open(self, header: Header) -> Header:
        """Begin with nothing kept."""
        out = super().open(header)
        self._step = header.step
        self._length = SUB_BLOCKS * max(1, round(0.01 / header.step))
        self.memory["lines"] = {track: Line() for track in header.tracks}
        self.memory["blocks"] = []
        self.memory["closed"] = 0
        return out

    def advance(self, block: Block) -> Block:
        """Filter the block; return the blocks whose segments are closed."""
        for part, full in self._split(block):
            for track, (height, nodes) in self.forward(part).items():
                self.memory["lines"][track].add(height, nodes)
            if full:
                self._end_segment()
        self.memory["blocks"].append(self._without_inputs(block))
        done = [out for out in self._closed_blocks()]
        return joined(done) if done else self.memory["blocks"][0].part(0, 0)

    def close(self) -> tuple[Block, ...]:
        """Return all that is left."""
        lines = self.memory["lines"]
        for track, nodes in self.ending().items():
            if len(nodes.at):
                lines[track].add(np.empty(0), nodes)
        for line in lines.values():
            if line.heights:
                line.end_segment(self._step)
            if line.segments:
                line.close(len(line.segments), self._step)
        self.memory["closed"] = 1 << 62
        return tuple(self._closed_blocks())

    def _split(self, block: Block) -> Iterator[tuple[Block, bool]]:
        """Yield ``block`` in parts that end with a segment, as the flag tells, or with the block."""
        begin, end = 0, len(block)
        while begin < end:
            sample = block.first + begin
            last = max(-(-sample // self._length), 1) * self._length
            stop = min(begin + last - sample + 1, end)
            yield block.part(begin, stop), block.first + stop == last + 1
            begin = stop

    def _end_segment(self) -> None:
        lines = self.memory["lines"].values()
        for line in lines:
            line.end_segment(self._step)
        count = min(closing(line.segments, self.tolerance_m) for line in lines)
        if count:
            for line in lines:
                self.memory["closed"] = line.segments[count - 1].last + 1
                line.close(count, self._step)

    def _closed_blocks(self) -> Iterator[Block]:
        """Yield the blocks that are kept and lie before the last closed sample."""
        blocks = self.memory["blocks"]
        while blocks and blocks[0].first + len(blocks[0]) <= self.memory["closed"]:
            block = blocks.pop(0)
            heights = {
                ChannelId(REFERENCE_HEIGHT, track): line.take(len(block))
                for track, line in self.memory["lines"].items()
            }
            yield block.setting(heights)

    def _without_inputs(self, block: Block) -> Block:
        flags = {}
        for channels in self._channels:
            marks = self.flags(block, channels)
            if marks is not None:
                flags[ChannelId(REFERENCE_HEIGHT, channels.track)] = marks
        return block.setting({}, flags).without(ACCELERATION, *IMU)
