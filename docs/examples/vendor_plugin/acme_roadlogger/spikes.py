"""A stage: readings of the laser that leap away from those around them, and come back."""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from floatref import Block, ChannelId, Declared, Flag, Header, Stage, join_blocks

HALF = 5
"""Samples on either side with which a reading is compared.

One reading of the laser may last for five samples of a 16-kHz clock.
"""

Floats = NDArray[np.float64]


class RemoveSpikes(Stage):
    """Puts the median in place of a height that is farther than ``spike_m`` from it, and flags it.

    The median is that of the eleven samples around it; at either end of the run the outermost
    sample is repeated. Where one of the eleven is NaN, nothing is removed. The height
    under a spike is not known: the sample is flagged as missing, like a dropout of the laser.
    """

    declared = Declared(linear=False, delay=HALF)

    def __init__(self, spike_m: float) -> None:
        """Treat a deviation of more than ``spike_m``, in m, as a spike."""
        super().__init__()
        self._spike_m = spike_m

    def open(self, header: Header) -> Header:
        """Ask for the height of every wheel path."""
        self._channels = [ChannelId("height", track) for track in header.tracks]
        header.require(self.name, *self._channels)
        self.memory = {"waiting": None, "before": {}, "removed": 0}
        return header

    def advance(self, block: Block) -> Block:
        """Return the samples that have `HALF` others behind them."""
        waiting = self.memory["waiting"]
        wide = block if waiting is None else join_blocks((waiting, block))
        ready = max(0, len(wide) - HALF)
        self.memory["waiting"] = wide.part(ready, len(wide))
        return self._cleaned(wide, ready, 0)

    def close(self) -> tuple[Block, ...]:
        """Return the samples that waited for later ones."""
        waiting = self.memory["waiting"]
        if waiting is None or not len(waiting):
            return ()
        return (self._cleaned(waiting, len(waiting), HALF),)

    def warnings(self) -> tuple[str, ...]:
        """Return the number of replaced samples."""
        removed = self.memory["removed"]
        return (f"{removed} samples of laser spikes removed and flagged",) if removed else ()

    def _cleaned(self, wide: Block, ready: int, more: int) -> Block:
        """Return the first ``ready`` samples of ``wide``, its last one repeated ``more`` times."""
        out, values, flags = wide.part(0, ready), {}, {}
        for channel in self._channels if ready else ():
            heights = self._surrounded(channel, wide[channel], ready, more)
            middle = np.median(sliding_window_view(heights, 2 * HALF + 1)[:ready], axis=1)
            spikes = np.abs(out[channel] - middle) > self._spike_m
            if spikes.any():
                values[channel] = np.where(spikes, middle, out[channel])
                marks = out.flags.get(channel, np.uint8(0))
                flags[channel] = marks | np.where(spikes, np.uint8(Flag.MISSING), np.uint8(0))
                self.memory["removed"] += int(spikes.sum())
        return out.setting(values, flags)

    def _surrounded(self, channel: ChannelId, heights: Floats, ready: int, more: int) -> Floats:
        """Return ``heights`` with those that came before, and keep what the next will need."""
        before = self.memory["before"].get(channel, np.full(HALF, heights[0]))
        wide = np.concatenate((before, heights, np.full(more, heights[-1])))
        self.memory["before"][channel] = wide[ready : ready + HALF].copy()
        return wide
