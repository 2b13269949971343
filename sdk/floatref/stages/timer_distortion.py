"""Timer distortion: a limit on the time step of the integration over distance."""

import numpy as np

from floatref.errors import InputError
from floatref.kernels.memories import INTEGRATOR
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import HEIGHT, REFERENCE_HEIGHT, TIME_STEP, TRUE_TIME_STEP, VELOCITY
from floatref.values.arrays import FloatArray, new_record
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

BLUNTEST = 2.0
"""Least sharpness of (5.8): at 1 the time step is zero, below 1 it is negative."""


def adjusted_time_step(
    time_step: FloatArray, limit_s: float, sharpness: float = 25.0
) -> FloatArray:
    """Return dt_adj of (5.8), shape (N,), for ``time_step`` dt >= 0 and ``limit_s`` dt_0 in s.

    It is about dt where dt is short and dt_0 where dt is long; ``sharpness`` is β. No power
    of a number above one is taken, so nothing overflows however long the stop. Raises
    InputError unless the limit is above zero and the sharpness at least `BLUNTEST`.
    """
    if not limit_s > 0.0:
        raise InputError(f"time step limit {limit_s} s: give it above zero")
    if not sharpness >= BLUNTEST:
        raise InputError(f"timer_sharpness {sharpness:g}: give it at {BLUNTEST:g} or above")
    ratio = np.asarray(time_step, dtype=np.float64) / limit_s
    # max() and min() keep either branch finite where the other one is taken.
    short, long = np.minimum(ratio, 1.0), np.maximum(ratio, 1.0)
    below = short - np.expm1(np.log1p(short**sharpness) / sharpness)
    above = 1.0 - long * np.expm1(np.log1p((1.0 / long) ** sharpness) / sharpness)
    adjusted: FloatArray = limit_s * np.where(ratio > 1.0, above, below)
    return adjusted


class DistortTimer(Stage):
    """Replaces `time_step` by dt_adj of (5.8) and stores the old one as `true_time_step`.

    dt_0 is the profile's interval over ``slow_speed`` in m/s (5.7), ``sharpness`` is β. Points
    passed more slowly than about ``slow_speed`` lose content in proportion to the square of the
    removed time.
    """

    declared = Declared(linear=False)

    def __init__(self, slow_speed: float = 3.576, sharpness: float = 25.0) -> None:
        """Limit the time step to that of ``slow_speed``."""
        super().__init__()
        self.slow_speed, self.sharpness = slow_speed, sharpness
        self._limit_s = 1.0

    def open(self, header: Header) -> Header:
        """Ask for the time step of the triggers."""
        if header.axis is not Axis.DISTANCE:
            raise InputError(f"stage {self.name}: the stream is not on the distance axis")
        header.require(self.name, ChannelId(TIME_STEP))
        self._limit_s = header.step / self.slow_speed
        return header.adding(ChannelId(TRUE_TIME_STEP))

    def advance(self, block: Block) -> Block:
        """Adjust every step."""
        step, true = ChannelId(TIME_STEP), ChannelId(TRUE_TIME_STEP)
        adjusted = adjusted_time_step(block[step], self._limit_s, self.sharpness)
        flags = flags_of(block, step)
        marks = {} if flags is None else {step: flags, true: flags}
        # A view is frozen in its place: the steps are the caller's.
        return block.setting({step: adjusted, true: block[step].view()}, marks)


class IntegrateReflecting(Stage):
    """Adds ``target``, the integral of ``source`` with reflected ``height`` (5.9), to every track.

    r_k = r_{k-1} + dt_adj (v_k + v_{k-1})/2 + (1 - (dt_adj/dt)^2)(h_k - h_{k-1}) with dt_adj of
    `time_step` and dt of `true_time_step`; the last term is 0 where dt is. Its sign is that which
    cancels in r - h. The integral starts at zero; ``source`` is dropped. A missing sample is
    bridged by the one before it and flagged. Where dt_adj is below dt the profile is flat: its
    content there is the height sensor's, cancelled.
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
        self.memory = {track: new_record(INTEGRATOR) for track in header.tracks}
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
