"""The filter stages of appendix A, streaming and in reverse, in time and in distance."""

import math
from copy import deepcopy
from typing import Any, ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.kernels.cut_off import high_pass_setting as high_pass_setting
from floatref.kernels.cut_off import high_pass_wavelength_setting as high_pass_wavelength_setting
from floatref.kernels.cut_off import low_pass_setting as low_pass_setting
from floatref.kernels.memories import STATE_VARIABLE
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Direction, Stage
from floatref.values.arrays import FloatArray, new_record, read_only
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId


class ButterworthStage(Stage):
    """One stage of the third-order Butterworth cascade, applied to one channel of every track.

    ``cutoff`` is that of the third-order filter: f_c in Hz on the time axis, the wave number
    1 / λ_c in cycles/m on the distance axis. A missing sample is bridged by the one before it,
    and its output is flagged.
    """

    order: ClassVar[int]
    passes_high: ClassVar[bool]

    def __init__(self, channel: str, cutoff: float) -> None:
        """Filter ``channel`` of every track at ``cutoff``."""
        super().__init__()
        self.channel = channel
        self.cutoff = cutoff
        self._c = math.nan

    def open(self, header: Header) -> Header:
        """Refuse a cut-off outside (0, half the sampling rate)."""
        header.require(self.name, *self._channels(header.tracks))
        if not 0.0 < self.cutoff * header.step < 0.5:
            raise InputError(
                f"stage {self.name}: cut-off {self.cutoff:g} cycles per unit of "
                f"{header.axis.value} is outside 0 to {0.5 / header.step:g}, half the sampling rate"
            )
        self._c = math.tan(math.pi * self.cutoff * header.step)
        self.memory = {track: new_record(STATE_VARIABLE) for track in header.tracks}
        return header

    def advance(self, block: Block) -> Block:
        """Filter every track."""
        values, flags = {}, {}
        for channel in self._channels(tuple(self.memory)):
            y = np.empty(len(block))
            self._apply(block[channel], y, self.memory[channel.track or ""])
            values[channel] = y
            marks = flags_of(block, channel)
            if marks is not None:
                flags[channel] = marks
        return block.setting(values, flags)

    def _apply(self, x: FloatArray, y: FloatArray, memory: Any) -> None:
        from floatref.kernels import state_variable

        kernel = {
            (True, 1): state_variable.high_pass_1,
            (True, 2): state_variable.high_pass_2,
            (False, 1): state_variable.low_pass_1,
            (False, 2): state_variable.low_pass_2,
        }[self.passes_high, self.order]
        # Read-only or not: the kernel is compiled for one of them alone.
        kernel(read_only(x), y, memory, self._c, self.direction is Direction.BACKWARD)

    def _channels(self, tracks: tuple[str, ...]) -> list[ChannelId]:
        return [ChannelId(self.channel, track) for track in tracks]


class HighPassB3S1(ButterworthStage):
    """HPF_B3S1: (A.2), started by (A.14)."""

    order, passes_high = 1, True


class HighPassB3S2(ButterworthStage):
    """HPF_B3S2: (A.3), started by (A.15)."""

    order, passes_high = 2, True


class LowPassB3S1(ButterworthStage):
    """LPF_B3S1: (A.4), started by (A.12)."""

    order, passes_high = 1, False


class LowPassB3S2(ButterworthStage):
    """LPF_B3S2: (A.5), started by (A.13)."""

    order, passes_high = 2, False


class LowPassB3(ButterworthStage):
    """LPF_B3: LPF_B3S1 and LPF_B3S2 in one pass over a block, bit for bit."""

    order, passes_high = 3, False

    def open(self, header: Header) -> Header:
        """Refuse a cut-off as either stage does; remember what both do."""
        header = super().open(header)
        self.memory = {track: (each, deepcopy(each)) for track, each in self.memory.items()}
        return header

    def _apply(self, x: FloatArray, y: FloatArray, memory: tuple[np.record, np.record]) -> None:
        from floatref.kernels import state_variable

        state_variable.low_pass_12(read_only(x), y, *memory, self._c)


class HighPassB3S1R(HighPassB3S1):
    """HPF_B3S1R: HPF_B3S1 from the last sample to the first, started by (A.18)."""

    direction = Direction.BACKWARD


class HighPassB3S2R(HighPassB3S2):
    """HPF_B3S2R: HPF_B3S2 from the last sample to the first, started by the mirror of (A.15)."""

    direction = Direction.BACKWARD


class LowPassB3S1R(LowPassB3S1):
    """LPF_B3S1R: LPF_B3S1 from the last sample to the first, started by (A.16)."""

    direction = Direction.BACKWARD


class LowPassB3S2R(LowPassB3S2):
    """LPF_B3S2R: LPF_B3S2 from the last sample to the first, started by (A.17)."""

    direction = Direction.BACKWARD


def high_pass_b3(channel: str, cutoff: float) -> tuple[Stage, ...]:
    """Return HPF_B3 (A.1): HPF_B3S1 followed by HPF_B3S2."""
    return HighPassB3S1(channel, cutoff), HighPassB3S2(channel, cutoff)


def low_pass_b3(channel: str, cutoff: float) -> tuple[Stage, ...]:
    """Return LPF_B3: LPF_B3S1 followed by LPF_B3S2."""
    return (LowPassB3(channel, cutoff),)


def high_pass_b3x2(channel: str, cutoff: float) -> tuple[Stage, ...]:
    """Return HPF_B3x2: HPF_B3S1, HPF_B3S2R, HPF_B3S1R and HPF_B3S2."""
    return (
        HighPassB3S1(channel, cutoff),
        HighPassB3S2R(channel, cutoff),
        HighPassB3S1R(channel, cutoff),
        HighPassB3S2(channel, cutoff),
    )


def low_pass_b3x2(channel: str, cutoff: float) -> tuple[Stage, ...]:
    """Return LPF_B3x2: LPF_B3S1, LPF_B3S2R, LPF_B3S1R and LPF_B3S2."""
    return (
        LowPassB3S1(channel, cutoff),
        LowPassB3S2R(channel, cutoff),
        LowPassB3S1R(channel, cutoff),
        LowPassB3S2(channel, cutoff),
    )
