"""From specific force to acceleration."""

from floatref.stages.marking import flags_of
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
