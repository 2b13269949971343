"""Local suppression: a controller that holds the vertical velocity at zero at low speed."""

import numpy as np

from floatref.errors import InputError
from floatref.kernels.memories import CONTROLLER
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import TRAVEL_SPEED, VELOCITY
from floatref.values.arrays import FloatArray, new_record
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId


class SuppressLocally(Stage):
    """Acts on ``channel`` of every track below ``below_mps`` with a PI controller (5.6).

    The integrated accelerometer signal d is the controller's disturbance, its set point zero: v = d
    + o - K_P v - K_I ∫v dt, trapezoidal, which has the time constant (5.1) and the response (5.2).
    The integral starts at zero whenever the speed comes below the limit; o is the offset of the
    controller's last action, so v continues without a step when the speed has risen again. A
    missing value or speed is bridged by the one before it and flagged. The controller removes
    content below about 0.13 Hz from every point passed below ``below_mps``.
    """

    declared = Declared()

    def __init__(
        self,
        channel: str = VELOCITY,
        below_mps: float = 4.4704,
        proportional: float = 0.001,
        integral_per_s: float = 0.834,
    ) -> None:
        """Control ``channel`` with K_P ``proportional`` and K_I ``integral_per_s``."""
        super().__init__()
        self.channel, self.below_mps = channel, below_mps
        self.proportional, self.integral_per_s = proportional, integral_per_s
        self._step = 1.0

    def open(self, header: Header) -> Header:
        """Ask for the channel and the speed, in time."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        channels = [ChannelId(self.channel, track) for track in header.tracks]
        header.require(self.name, *channels, ChannelId(TRAVEL_SPEED))
        self._step = header.step
        self.memory = {track: new_record(CONTROLLER) for track in header.tracks}
        return header

    def advance(self, block: Block) -> Block:
        """Control every track."""
        values, flags = {}, {}
        speed = ChannelId(TRAVEL_SPEED)
        for track, memory in self.memory.items():
            channel = ChannelId(self.channel, track)
            values[channel] = self._control(block[channel], block[speed], memory)
            marks = flags_of(block, channel, speed)
            if marks is not None:
                flags[channel] = marks
        return block.setting(values, flags)

    def _control(self, x: FloatArray, speed: FloatArray, memory: np.record) -> FloatArray:
        from floatref.kernels import local_suppression

        y = np.empty(x.size)
        gains = self.proportional, self.integral_per_s * self._step
        local_suppression.hold_at_zero(x, speed, y, memory, self.below_mps, *gains)
        return y
