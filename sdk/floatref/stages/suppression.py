"""Local suppression: a controller that holds the vertical velocity at zero at low speed."""

import numpy as np

from floatref.errors import InputError
from floatref.kernels.compiling import compiled
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import TRAVEL_SPEED, VELOCITY
from floatref.values.arrays import FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

MEMORY = 6
"""Length of the memory: active, the last d, speed and v, the integral, the offset."""


@compiled
def hold_at_zero(
    disturbance: FloatArray,
    speed: FloatArray,
    y: FloatArray,
    memory: FloatArray,
    limit: float,
    proportional: float,
    integral: float,
) -> None:
    """Write to ``y`` the ``disturbance`` as a PI controller with set point 0 leaves it.

    It acts where ``speed`` is below ``limit``; ``integral`` is K_I dt. A missing (NaN)
    disturbance or speed is bridged by the one before it, 0 if there is none.
    """
    active, held, moving = memory[0], memory[1], memory[2]
    last, area, offset = memory[3], memory[4], memory[5]
    at_once = 1.0 / (1.0 + proportional)
    later = 1.0 / (1.0 + proportional + 0.5 * integral)
    for i in range(disturbance.size):
        before = held
        held = disturbance[i] if disturbance[i] == disturbance[i] else held
        moving = speed[i] if speed[i] == speed[i] else moving
        if moving < limit:
            if active == 0.0:
                active, area = 1.0, 0.0
                value = (held + offset) * at_once
            else:
                area += 0.5 * integral * last
                value = (held + offset - area) * later
                area += 0.5 * integral * value
        else:
            if active != 0.0:
                active, offset = 0.0, last - before
            value = held + offset
        last = value
        y[i] = value
    memory[0], memory[1], memory[2] = active, held, moving
    memory[3], memory[4], memory[5] = last, area, offset


class SuppressLocally(Stage):
    """Acts on ``channel`` of every track below ``below_mps`` with a PI controller (5.6).

    The integrated accelerometer signal d is the controller's disturbance, its set point zero:
    v = d + o - K_P v - K_I ∫v dt, trapezoidal, which has the time constant (5.1) and the response
    (5.2). The integral starts at zero whenever the speed comes below the limit; o is the offset
    that the controller's last action left, so v goes on without a step when the speed is back.
    A missing value or speed is bridged by the one before it and flagged. Every point passed
    below ``below_mps`` lacks the content that the controller removed (below about 0.13 Hz).
    """

    declared = Declared()

    def __init__(
        self,
        channel: str = VELOCITY,
        below_mps: float = 16 / 3.6,
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
        self.memory = {track: np.zeros(6) for track in header.tracks}
        return header

    def advance(self, block: Block) -> Block:
        """Control every track."""
        values, flags = {}, {}
        speed = ChannelId(TRAVEL_SPEED)
        for track, memory in self.memory.items():
            channel = ChannelId(self.channel, track)
            values[channel] = self._controlled(block[channel], block[speed], memory)
            marks = flags_of(block, channel, speed)
            if marks is not None:
                flags[channel] = marks
        return block.setting(values, flags)

    def _controlled(self, x: FloatArray, speed: FloatArray, memory: FloatArray) -> FloatArray:
        from floatref.stages import suppression

        y = np.empty(x.size)
        gains = self.proportional, self.integral_per_s * self._step
        suppression.hold_at_zero(x, speed, y, memory, self.below_mps, *gains)
        return y
