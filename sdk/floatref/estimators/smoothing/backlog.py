"""Blocks that wait for the readings that still matter to them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import ceil, inf, log2

import numpy as np

from floatref.estimators.smoothing.lag import count_settled
from floatref.estimators.smoothing.line import Closing, Line
from floatref.estimators.smoothing.nodes import Filtered, Nodes
from floatref.stages.signals import DISTANCE, REFERENCE_HEIGHT, SIGMA
from floatref.values.arrays import FlagArray, FloatArray
from floatref.values.block import Block
from floatref.values.channels import ChannelId

SEGMENT_S = 4.0
"""Duration of a segment, but for its power of two in samples."""
WAITING_S = 60.0
"""A segment waits this long at least, at any bound: what changes since at the place where one part
has come out and the next has not would be a step there."""
STANDING = 5.0
"""Longest wait of a segment, in multiples of the longest time: a vehicle may stand for hours."""
STOOD_S = 900.0
"""After so long a standstill no segment waits longer than it must: what readings at one place still
change is less and less, and every part of the stop would be smoothed again with each segment."""
JOINT_M = 3e-4
"""1-σ of what may still change where a part that has waited so long ends."""
TOLERANCE_M = 2e-6
"""1-σ of what later readings may still change when a segment is closed."""
ALL = 1 << 62
"""More samples than any run has."""


@dataclass(eq=False)
class Backlog:
    """The wheel paths' lines, and the blocks that they belong to.

    Attributes:
        lines: of every wheel path.
        waiting_s: segments are closed no earlier than that.
        longest_s: nor much later, except where the vehicle is stationary or has just been.
            There all that may be is closed after `STOOD_S`.
        length: samples of a segment.
        blocks: stored, without height and 1-σ.
        closed: all samples before this one are.
    """

    lines: dict[str, Line]
    waiting_s: float
    longest_s: float
    length: int
    blocks: list[Block] = field(default_factory=list)
    closed: int = 0

    @classmethod
    def of(
        cls, tracks: tuple[str, ...], rule: Closing, waiting_s: float, longest_s: float = inf
    ) -> "Backlog":
        """Return an empty one."""
        length = 1 << max(0, round(log2(SEGMENT_S / rule.step)))
        return cls({track: Line(rule) for track in tracks}, waiting_s, longest_s, length)

    def add(self, block: Block, found: Mapping[str, Filtered]) -> None:
        """Store ``block`` and the results of the filters."""
        distance, flags = block[ChannelId(DISTANCE)], {}
        full = range(block.first // self.length, (block.first + len(block)) // self.length)
        borders = [(number + 1) * self.length for number in full]
        for track, passed in found.items():
            line = self.lines[track]
            line.heights.append((block.first, passed.height))
            line.add(passed.nodes, distance[passed.nodes.at - block.first], borders)
            flags.update(_collect_flags(track, passed))
        for _ in borders:
            self._end_segment()
        self.blocks.append(block.setting({}, flags))

    def finish(self, ending: Mapping[str, tuple[Nodes, FloatArray | None]]) -> None:
        """Close all; ``ending`` has a node at the last sample, if need be, and lambda behind it."""
        for track, (nodes, beyond) in ending.items():
            line = self.lines[track]
            last = self.blocks[-1][ChannelId(DISTANCE)][-1:]
            line.add(nodes, last[: len(nodes.at)])
            if any(len(part.at) for part in line.parts):
                line.end_segment()
            if line.segments:
                line.close(len(line.segments), beyond)
        self.closed = ALL

    def come_out(self) -> Iterator[Block]:
        """Yield the blocks that lie before the last closed sample."""
        while self.blocks and self.blocks[0].first + len(self.blocks[0]) <= self.closed:
            block, values = self.blocks.pop(0), {}
            for track, line in self.lines.items():
                height, deviation = line.take()
                values[ChannelId(REFERENCE_HEIGHT, track)] = height
                values[ChannelId(SIGMA, track)] = deviation
            yield block.setting(values)

    def next_sample(self, block: Block) -> int:
        """Return where the next output begins: at ``block`` if no block is stored."""
        return (self.blocks[0] if self.blocks else block).first

    def _end_segment(self) -> None:
        """End the segments before the next border, and close those that are ready."""
        lines = list(self.lines.values())
        for line in lines:
            line.end_segment()
        waiting = ceil(self.waiting_s / (self.length * lines[0].rule.step))
        # What is smoothed again later shall not be more than what is closed.
        least, open_ones = max(waiting, 1), len(lines[0].segments)
        if open_ones < 2 * least:
            return
        count = self._ready(lines, open_ones - waiting)
        if 2 * count >= open_ones:
            self.closed = lines[0].segments[count - 1].last + 1
            for line in lines:
                line.close(count)

    def _ready(self, lines: Sequence[Line], most: int) -> int:
        """Return how many segments, ``most`` at most, need not wait, or may no longer."""
        change: FloatArray = np.maximum.reduce([line.changes() for line in lines])
        ready = min(count_settled(change, lines[0].rule.tolerance_m), most)
        waited_s = (change.size + 1) * self.length * lines[0].rule.step
        stood_s = lines[0].count_standing() * self.length * lines[0].rule.step
        if waited_s >= STANDING * self.longest_s or stood_s >= STOOD_S:
            return most
        half, passed = ceil(change.size / 2), min(most, *(line.count_passed() for line in lines))
        if waited_s < self.longest_s or passed <= half:
            return ready
        # Little is still to come away from stops, so that the joint bends nothing.
        least = half + int(np.argmin(change[half:passed]))
        return max(ready, least + 1 if change[least] <= JOINT_M else 0)


def _collect_flags(track: str, passed: Filtered) -> dict[ChannelId, FlagArray]:
    if passed.flags is None:
        return {}
    return {ChannelId(name, track): passed.flags for name in (REFERENCE_HEIGHT, SIGMA)}
