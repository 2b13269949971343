"""From specific force to acceleration."""

from floatref.stages.marking import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ACCELERATION
from floatref.values.block import Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId

SPECIFIC_FORCE = "vertical_specific_force"


class RemoveGravity(Stage):
    """Removes the 1-g offset: `vertical_acceleration` in place of `vertical_specific_force`.

    This is the reading of (1.4), 0 at rest and level.
    """

    declared = Declared(linear=False, zero_in_zero_out=False)

    def open(self, header: Header) -> Header:
        """Ask for the specific force of every track."""
        self._tracks = header.tracks
        header.require(self.name, *(ChannelId(SPECIFIC_FORCE, t) for t in header.tracks))
        return header.replacing(SPECIFIC_FORCE, ACCELERATION)

    def advance(self, block: Block) -> Block:
        """Subtract standard gravity."""
        values, flags = {}, {}
        for track in self._tracks:
            source, target = ChannelId(SPECIFIC_FORCE, track), ChannelId(ACCELERATION, track)
            values[target] = block[source] - STANDARD_GRAVITY
            marks = flags_of(block, source)
            if marks is not None:
                flags[target] = marks
        return block.setting(values, flags).without(SPECIFIC_FORCE)
