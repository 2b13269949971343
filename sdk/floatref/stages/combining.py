"""Floating reference height minus height: the elevation."""

from floatref.stages.marking import flags_of
from floatref.stages.protocol import Stage
from floatref.stages.signals import ELEVATION, HEIGHT, REFERENCE_HEIGHT
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId


class Combine(Stage):
    """Adds `elevation` = `floating_reference_height` - `height` (1.2) and drops the two."""

    def open(self, header: Header) -> Header:
        """Ask for both heights of every track."""
        self._tracks = header.tracks
        for name in (REFERENCE_HEIGHT, HEIGHT):
            header.require(self.name, *(ChannelId(name, t) for t in header.tracks))
        return header.replacing(REFERENCE_HEIGHT, ELEVATION).without(HEIGHT)

    def advance(self, block: Block) -> Block:
        """Subtract; a flag of either is a flag of the elevation."""
        values, flags = {}, {}
        for track in self._tracks:
            reference, height = ChannelId(REFERENCE_HEIGHT, track), ChannelId(HEIGHT, track)
            target = ChannelId(ELEVATION, track)
            values[target] = block[reference] - block[height]
            marks = flags_of(block, reference, height)
            if marks is not None:
                flags[target] = marks
        return block.setting(values, flags).without(REFERENCE_HEIGHT, HEIGHT)
