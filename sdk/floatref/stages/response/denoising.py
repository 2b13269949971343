"""Noise taken out of the readings by singular spectrum analysis, section 5 of Zhu."""

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.response.denoising import denoised
from floatref.stages.marking import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId


class Denoise(Stage):
    """Keeps ``components`` principal components of the windows of each of ``names``.

    The whole run is held back, since the components are those of all windows; a missing sample is
    bridged by 0, as a high-passed signal has it, and flagged.
    """

    declared: ClassVar[Declared] = Declared(linear=False, delay=1 << 62)

    def __init__(self, names: Sequence[str], components: int, window_s: float) -> None:
        """Denoise channels called one of ``names``, in windows of ``window_s``."""
        super().__init__()
        self.names, self.components, self.window_s = tuple(names), components, window_s
        self._window = 2
        self._channels: tuple[ChannelId, ...] = ()

    def open(self, header: Header) -> Header:
        """Ask for the channels, in time; InputError for more components than a window has."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        self._window = max(2, round(self.window_s / header.step))
        if self.components > self._window:
            raise InputError(
                f"stage {self.name}: {self.components} components of a window of {self._window} "
                "samples; give fewer, or a longer window"
            )
        self._channels = tuple(ChannelId(n, track) for n in self.names for track in header.tracks)
        header.require(self.name, *self._channels)
        self.memory = {"blocks": []}
        return header

    def advance(self, block: Block) -> Block:
        """Hold the block back."""
        blocks: list[Block] = self.memory["blocks"]
        if len(block):
            blocks.append(block)
        return (blocks[0] if blocks else block).part(0, 0)

    def close(self) -> tuple[Block, ...]:
        """Return the whole run."""
        if not self.memory["blocks"]:
            return ()
        whole = join_blocks(self.memory["blocks"])
        window = min(self._window, len(whole) // 2)
        values, flags = {}, {}
        for channel in self._channels:
            marks = flags_of(whole, channel)
            if marks is not None:
                flags[channel] = marks
            if window >= 2:
                kept = min(self.components, window)
                values[channel] = denoised(np.nan_to_num(whole[channel]), window, components=kept)
        return (whole.setting(values, flags),)
