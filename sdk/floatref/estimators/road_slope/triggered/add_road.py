"""The stage that adds the expected road to what the smoother has found beside it."""

from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import EXPECTED_ROAD, REFERENCE_HEIGHT
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId

ROAD = ChannelId(EXPECTED_ROAD)


class AddRoad(Stage):
    """Adds `expected_road`, which is left out of the accelerations, to every reference height.

    The channel is dropped. No point is marked by it.
    """

    declared = Declared(linear=False, zero_in_zero_out=False)

    def open(self, header: Header) -> Header:
        """Ask for the reference heights and the road."""
        self._tracks = header.tracks
        header.require(self.name, ROAD, *(ChannelId(REFERENCE_HEIGHT, t) for t in header.tracks))
        return header.without(EXPECTED_ROAD)

    def advance(self, block: Block) -> Block:
        """Add the road."""
        heights = [ChannelId(REFERENCE_HEIGHT, track) for track in self._tracks]
        raised = {height: block[height] + block[ROAD] for height in heights}
        return block.setting(raised).without(EXPECTED_ROAD)
