"""Removal of the mean of a whole run (section 5.4)."""

import numpy as np

from floatref.stages.protocol import Declared, Stage
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId


class RemoveMean(Stage):
    """Subtracts from ``channel`` of every track its mean over the run.

    The mean is that of the samples that are there; it needs the whole run before the first
    output, so the engine surveys the run first. Missing samples stay missing.
    """

    surveys = True
    declared = Declared(shift_invariant=False)

    def __init__(self, channel: str) -> None:
        """Remove the mean of ``channel``."""
        super().__init__()
        self.channel = channel

    def open(self, header: Header) -> Header:
        """Ask for the channel of every track."""
        header.require(self.name, *(ChannelId(self.channel, t) for t in header.tracks))
        self.memory = {track: np.zeros(3) for track in header.tracks}
        return header

    def survey(self, block: Block) -> None:
        """Add the block to the sums."""
        from floatref.kernels import motion

        for track, memory in self.memory.items():
            motion.add_up(block[ChannelId(self.channel, track)], memory)

    def advance(self, block: Block) -> Block:
        """Subtract the mean."""
        values = {}
        for track, (total, rest, count) in self.memory.items():
            channel = ChannelId(self.channel, track)
            values[channel] = block[channel] - (total + rest) / max(count, 1.0)
        return block.setting(values)
