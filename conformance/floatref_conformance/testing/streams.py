"""A stream of drawn samples for one stage: its header, its blocks, and how to push them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np

from floatref.stages.protocol import Direction, Stage
from floatref.values.arrays import BoolArray, FlagArray, FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

LENGTH = 240
"""Number of samples of a drawn stream."""
STEP = 0.01
"""Distance between samples, in s or m by the axis."""


@dataclass(frozen=True, eq=False)
class Stream:
    """The input of a stage; it can be run several times, each time by a new stage.

    Attributes:
        make: returns a new stage.
        samples: of every channel, shape (n,).
        tracks: the wheel paths.
        axis: what the index counts.
        first: index of the first sample.
        flags: `floatref.values.arrays.Flag` bits of some channels, shape (n,).
    """

    make: Callable[[], Stage]
    samples: Mapping[ChannelId, FloatArray]
    tracks: tuple[str, ...]
    axis: Axis = Axis.TIME
    first: int = 0
    flags: Mapping[ChannelId, FlagArray] = field(default_factory=dict)

    @property
    def header(self) -> Header:
        """The header that the stage is started with."""
        channels = frozenset(self.samples)
        rate = Fraction(1) / Fraction(STEP).limit_denominator()
        return Header(self.axis, STEP, 0.0, rate, channels, self.tracks)

    @property
    def backward(self) -> bool:
        """Whether the stage is pushed its blocks from the last to the first."""
        return self.make().direction is Direction.BACKWARD

    def blocks(self, cuts: Iterable[int] = ()) -> list[Block]:
        """Return the samples in blocks that begin at each of ``cuts``; some may be empty."""
        length = next(iter(self.samples.values())).size
        edges = [0, *sorted(cut for cut in set(cuts) if cut < length), length]
        return [
            Block(
                self.first + a,
                {channel: values[a:b] for channel, values in self.samples.items()},
                flags={channel: marks[a:b] for channel, marks in self.flags.items()},
            )
            for a, b in pairwise(edges)
        ]

    def begin(self, blocks: Sequence[Block]) -> Stage:
        """Return a started stage; one that surveys has surveyed ``blocks``."""
        stage = self.make()
        stage.start(self.header)
        for block in blocks if stage.surveys else ():
            stage.survey(block)
        return stage

    def order(self, blocks: Sequence[Block]) -> list[Block]:
        """Return ``blocks`` in the order in which they are pushed."""
        return list(reversed(blocks)) if self.backward else list(blocks)

    def run(self, cuts: Iterable[int] = ()) -> Block:
        """Return the whole output as one block, if the stream is cut at ``cuts``."""
        blocks = self.blocks(cuts)
        stage = self.begin(blocks)
        out = [stage.push(block) for block in self.order(blocks)]
        return join([*out, *stage.finish()])

    def change(self, change: Callable[[ChannelId, FloatArray], FloatArray]) -> "Stream":
        """Return the stream with the samples that ``change`` returns for every channel."""
        return replace(self, samples={c: change(c, x) for c, x in self.samples.items()})


def join(blocks: Sequence[Block]) -> Block:
    """Return ``blocks`` as one, in the order of the index; AssertionError without samples."""
    filled = sorted((block for block in blocks if len(block)), key=lambda block: block.first)
    if not filled:
        raise AssertionError("nothing came out of the stage")
    flagged = {channel for block in filled for channel in block.flags}
    return replace(
        filled[0],
        values={c: np.concatenate([block[c] for block in filled]) for c in filled[0].values},
        flags={c: np.concatenate([marks_of(block, c) for block in filled]) for c in flagged},
    )


def marks_of(block: Block, channel: ChannelId) -> FlagArray:
    """Return the flags of ``channel``; zeros if it is not flagged."""
    marks = block.flags.get(channel)
    return np.zeros(len(block), np.uint8) if marks is None else marks


def find_flagged(block: Block, channel: ChannelId) -> BoolArray:
    """Return where ``channel`` is NaN or flagged."""
    either: BoolArray = np.isnan(block[channel]) | (marks_of(block, channel) != 0)
    return either
