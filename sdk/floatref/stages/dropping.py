"""Letting go of channels that nothing downstream reads."""

from floatref.stages.protocol import Declared, Stage
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId


class Drop(Stage):
    """Drops the channels called ``names``, shared or of every track.

    What is dropped needs no place on the tape of a backward pass. No point is changed.
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
