"""The encoder's distance at the nodes, and the travel from node to node."""

from dataclasses import dataclass

import numpy as np

from floatref.stages.signals import DISTANCE
from floatref.values.arrays import Flag, FloatArray, IndexArray
from floatref.values.block import Block
from floatref.values.channels import ChannelId


@dataclass(eq=False)
class Travel:
    """What the encoder gives from block to block.

    Attributes:
        place: distance at the latest node, in m, NaN where it is not known.
        pace: travel to that node, in m.
        miscounted: whether samples behind it are no travel.
    """

    place: float = np.nan
    pace: float = 0.0
    miscounted: bool = False

    def find_places(self, block: Block, nodes: IndexArray) -> FloatArray:
        """Return the distances at the ``nodes`` of the next block, in m, shape (n,).

        One is NaN if between it and the node before the encoder leaps, or gives no travel for long:
        their difference would look like a brake.
        """
        places, flags = block[ChannelId(DISTANCE)][nodes], block.flags.get(ChannelId(DISTANCE))
        if flags is None and not self.miscounted:
            return places
        marks = np.zeros(len(block), np.uint8) if flags is None else flags
        total = np.cumsum((marks & np.uint8(Flag.SLOW)) != 0)
        before = np.concatenate(([-int(self.miscounted)], total[nodes]))
        self.miscounted = bool(total[-1] > before[-1])
        return np.where(np.diff(before) > 0, np.nan, places)

    def take(self, places: FloatArray) -> FloatArray:
        """Return the travel to each of ``places``, at the last speed where one is not known."""
        travel = np.maximum(np.diff(places, prepend=self.place), 0.0)
        known = np.append(self.pace, travel)
        latest = np.maximum.accumulate(np.where(np.isnan(known), 0, np.arange(known.size)))
        known = known[latest]
        self.place, self.pace = float(places[-1]), float(known[-1])
        return known[1:]

    def since(self, distance: float) -> float:
        """Return the travel in m from the latest node to a ``distance``, 0 where not known."""
        return max(0.0, float(np.nan_to_num(distance - self.place)))
