"""From specific force to acceleration."""

import numpy as np

from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ACCELERATION
from floatref.values.block import Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId

SPECIFIC_FORCE = "vertical_specific_force"


class RemoveGravity(Stage):
    """Removes the 1-g offset: ``target`` in place of ``source``, a specific force.

    This is the reading of (1.4), 0 at rest and level.
    """

    declared = Declared(linear=False, zero_in_zero_out=False)

    def __init__(self, source: str = SPECIFIC_FORCE, target: str = ACCELERATION) -> None:
        """Turn ``source`` of every track into ``target``."""
        super().__init__()
        self.source, self.target = source, target

    def open(self, header: Header) -> Header:
        """Ask for the specific force of every track."""
        self._tracks = header.tracks
        header.require(self.name, *(ChannelId(self.source, t) for t in header.tracks))
        return header.replacing(self.source, self.target)

    def advance(self, block: Block) -> Block:
        """Subtract standard gravity."""
        values, flags = {}, {}
        for track in self._tracks:
            source, target = ChannelId(self.source, track), ChannelId(self.target, track)
            values[target] = block[source] - STANDARD_GRAVITY
            marks = flags_of(block, source)
            if marks is not None:
                flags[target] = marks
        return block.setting(values, flags).without(self.source)


class Drop(Stage):
    """Drops the channels called ``names``, shared or of every track.

    Dropped channels take no space on the tape of a backward pass. No point is changed.
    """

    declared = Declared()

    def __init__(self, *names: str) -> None:
        """Drop all channels called one of ``names``."""
        super().__init__()
        self.names = names

    def open(self, header: Header) -> Header:
        """Ask for the channels."""
        there = {channel.name for channel in header.channels}
        header.require(self.name, *(ChannelId(name) for name in self.names if name not in there))
        return header.without(*self.names)

    def advance(self, block: Block) -> Block:
        """Leave the channels out."""
        return block.without(*self.names)


class FromFirst(Stage):
    """Subtracts from ``channel`` of every track its first sample that is not missing.

    The elevation of a profile has no datum of its own, (1.2); a high-pass filter then starts
    without a step of the height sensor's stand-off. The stage changes no point's shape: it moves
    all of them by the same height.
    """

    declared = Declared(shift_invariant=True)

    def __init__(self, channel: str) -> None:
        """Measure ``channel`` from its first sample."""
        super().__init__()
        self.channel = channel

    def open(self, header: Header) -> Header:
        """Ask for the channel of every track."""
        header.require(self.name, *(ChannelId(self.channel, t) for t in header.tracks))
        self.memory = dict.fromkeys(header.tracks)
        return header

    def advance(self, block: Block) -> Block:
        """Subtract the first sample."""
        values, flags = {}, {}
        for track in self.memory:
            channel = ChannelId(self.channel, track)
            x = block[channel]
            known = x[~np.isnan(x)] if self.memory[track] is None else x[:0]
            if known.size:
                self.memory[track] = float(known[0])
            values[channel] = x - (self.memory[track] or 0.0)
            marks = flags_of(block, channel)
            if marks is not None:
                flags[channel] = marks
        return block.setting(values, flags)
