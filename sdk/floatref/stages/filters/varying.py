"""The high-pass stages of appendix A with a cut-off that varies from sample to sample."""

from types import ModuleType
from typing import ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.kernels import memories
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Direction, Stage
from floatref.stages.signals import CUTOFF
from floatref.values.arrays import FloatArray, Records, new_records
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId


class VaryingHighPass(Stage):
    """Sections of HPF_B3 applied to one channel of every track at `high_pass_cutoff`.

    At every sample the recursion (A.9) takes the coefficients of Table A.1 from the cut-off of
    that sample, in Hz on the time axis or cycles/m on the distance axis. A missing sample, or
    cut-off, is bridged by the one before it, and the output is flagged. The stage removes content
    below the cut-off from every point, and the points within about a wavelength of the cut-off
    from where it starts are its run-in.
    """

    orders: ClassVar[str]
    """The order of each section that is passed, first to last, as its kernel is named."""
    _section: ClassVar[np.dtype[np.void]] = memories.VARYING

    def __init__(self, channel: str) -> None:
        """Filter ``channel`` of every track."""
        super().__init__()
        self.channel = channel
        self._step = 1.0

    def open(self, header: Header) -> Header:
        """Ask for the channel and the cut-off."""
        channels = [ChannelId(self.channel, track) for track in header.tracks]
        header.require(self.name, *channels, ChannelId(CUTOFF))
        self._step = header.step
        count = len(self.orders)
        self.memory = {track: new_records(count, self._section) for track in header.tracks}
        return header

    def advance(self, block: Block) -> Block:
        """Filter every track; raises InputError for a cut-off that cannot be."""
        values, flags = {}, {}
        c = tangents(block[ChannelId(CUTOFF)], self._step, self.name)
        for track, memory in self.memory.items():
            channel = ChannelId(self.channel, track)
            values[channel] = self._filter(block[channel], c, memory)
            marks = flags_of(block, channel, ChannelId(CUTOFF))
            if marks is not None:
                flags[channel] = marks
        return block.setting(values, flags)

    def _filter(self, x: FloatArray, c: FloatArray, memory: Records) -> FloatArray:
        y = np.empty(x.size)
        kernel = getattr(self._kernels(), f"high_pass_{self.orders}")
        kernel(x, y, c, *memory, self.direction is Direction.BACKWARD)
        return y

    @staticmethod
    def _kernels() -> ModuleType:
        from floatref.kernels import varying

        return varying


class VaryingHighPassB3S1(VaryingHighPass):
    """HPF_B3S1, (A.2) at a varying cut-off, started by (A.14).

    It removes content below the cut-off from every point.
    """

    orders = "1"


class VaryingHighPassB3S2(VaryingHighPass):
    """HPF_B3S2, (A.3) at a varying cut-off, started by (A.15).

    It removes content below the cut-off from every point.
    """

    orders = "2"


class VaryingHighPassB3S1R(VaryingHighPassB3S1):
    """HPF_B3S1R: VaryingHighPassB3S1 from the last sample to the first, started by (A.18).

    It removes content below the cut-off from every point.
    """

    direction = Direction.BACKWARD


class VaryingHighPassB3S2R(VaryingHighPassB3S2):
    """HPF_B3S2R: VaryingHighPassB3S2 in reverse, started by the mirror of (A.15).

    It removes content below the cut-off from every point.
    """

    direction = Direction.BACKWARD


class VaryingHighPassB3(VaryingHighPass):
    """HPF_B3: VaryingHighPassB3S1, then VaryingHighPassB3S2, in one loop.

    It removes content below the cut-off from every point.
    """

    orders = "12"


class VaryingHighPassB3R(VaryingHighPass):
    """HPF_B3 in reverse: VaryingHighPassB3S2R, then VaryingHighPassB3S1R, in one loop.

    It removes content below the cut-off from every point.
    """

    orders = "21"
    direction = Direction.BACKWARD


class StateHighPassB3S1R(VaryingHighPass):
    """HPF_B3S1R in state-variable form: at a varying cut-off s' = w hp, hp = x - s.

    It removes content below the cut-off from every point.
    """

    orders = "1"
    direction = Direction.BACKWARD
    _section = memories.VARYING_STATES

    @staticmethod
    def _kernels() -> ModuleType:
        from floatref.kernels import varying_states

        return varying_states


class StateHighPassB3S2R(StateHighPassB3S1R):
    """HPF_B3S2R in state-variable form: bp' = w hp, lp' = w bp, hp = x - bp - lp.

    Unlike (A.10) with varying coefficients, its output does not grow where the cut-off falls, as on
    the way back from a stop. It removes content below the cut-off from every point.
    """

    orders = "2"


def tangents(cutoff: FloatArray, step: float, stage: str) -> FloatArray:
    """Return c of (A.11), shape (N,), at every ``cutoff`` in cycles per unit of ``step``.

    Raises InputError in the name of ``stage`` where a cut-off is below zero or not below half
    the sampling rate.
    """
    from floatref.kernels import schedule

    c = np.empty(cutoff.size)
    if schedule.tangents(cutoff, step, c):
        worst = cutoff[(cutoff < 0.0) | (cutoff * step >= 0.5)][0]
        raise InputError(
            f"stage {stage}: channel {CUTOFF} holds {worst:g}; it must lie within 0 to "
            f"{0.5 / step:g}, half the sampling rate"
        )
    return c
