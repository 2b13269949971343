"""The datum of a signal: what it is measured from."""

import numpy as np

from floatref.stages.marking import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId


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
