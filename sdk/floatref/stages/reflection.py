"""Height-sensor reflection: what the timer takes away is filled in from the height sensor."""

import numpy as np

from floatref.errors import InputError
from floatref.stages.marking import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import (
    HEIGHT,
    REFERENCE_HEIGHT,
    TIME_STEP,
    TRUE_TIME_STEP,
    VELOCITY,
)
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId


class IntegrateReflecting(Stage):
    """Adds ``target``, the integral of ``source`` with reflected ``height`` (5.9), to every track.

    r_k = r_{k-1} + dt_adj (v_k + v_{k-1})/2 + (1 - (dt_adj/dt)^2)(h_k - h_{k-1}) with dt_adj of
    `time_step` and dt of `true_time_step`; the last term is 0 where dt is. Its sign is that
    which cancels in r - h. The integral starts at zero; ``source`` is dropped. A missing sample
    is bridged by the one before it and flagged. Where dt_adj falls short of dt the profile is
    flat: its content there is the height sensor's, cancelled.
    """

    declared = Declared()

    def __init__(
        self, source: str = VELOCITY, target: str = REFERENCE_HEIGHT, height: str = HEIGHT
    ) -> None:
        """Integrate ``source`` into ``target``, reflecting ``height``."""
        super().__init__()
        self.source, self.target, self.height = source, target, height

    def open(self, header: Header) -> Header:
        """Ask for both signals of every track and both time steps."""
        if header.axis is not Axis.DISTANCE:
            raise InputError(f"stage {self.name}: the stream is not on the distance axis")
        header.require(self.name, ChannelId(TIME_STEP), ChannelId(TRUE_TIME_STEP))
        for name in (self.source, self.height):
            header.require(self.name, *(ChannelId(name, t) for t in header.tracks))
        self.memory = {track: np.zeros(4) for track in header.tracks}
        return header.replacing(self.source, self.target)

    def advance(self, block: Block) -> Block:
        """Integrate every track."""
        from floatref.kernels import motion

        values, flags = {}, {}
        steps = block[ChannelId(TIME_STEP)], block[ChannelId(TRUE_TIME_STEP)]
        for track, memory in self.memory.items():
            source, height = ChannelId(self.source, track), ChannelId(self.height, track)
            target = ChannelId(self.target, track)
            y = np.empty(len(block))
            motion.integrate_reflecting(block[source], block[height], y, memory, *steps)
            values[target] = y
            marks = flags_of(block, source, height)
            if marks is not None:
                flags[target] = marks
        return block.setting(values, flags).without(self.source)
