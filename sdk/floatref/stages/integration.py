"""Trapezoidal integration, in time or over the encoder's triggers."""

import numpy as np

from floatref.kernels.memories import INTEGRATOR, SUM
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ELEVATION, HEIGHT, REFERENCE_HEIGHT, TIME_STEP
from floatref.values.arrays import FloatArray, new_record
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId


class Integrate(Stage):
    """Adds ``target``, the trapezoidal integral of ``source``, to every track.

    On the time axis the step is constant; on the distance axis it is the channel `time_step`, as in
    (5.5) and (5.6) with the factor ½ of the trapezoidal rule. The integral starts at zero, or at
    the first value of channel ``starts_at`` of the same track. ``source`` is dropped unless
    ``keep`` is set. A missing sample is bridged by the one before it and flagged; the error of the
    bridge shifts all samples behind it.
    """

    declared = Declared()

    def __init__(
        self, source: str, target: str, starts_at: str | None = None, keeps_source: bool = False
    ) -> None:
        """Integrate ``source`` into ``target``."""
        super().__init__()
        self.source, self.target, self.starts_at = source, target, starts_at
        self.keeps_source = keeps_source
        self._half_step = 0.0

    def open(self, header: Header) -> Header:
        """Ask for the source, and for the time step on the distance axis."""
        self._over_distance = header.axis is Axis.DISTANCE
        self._half_step = header.step / 2.0
        if self._over_distance:
            header.require(self.name, ChannelId(TIME_STEP))
        for name in filter(None, (self.source, self.starts_at)):
            header.require(self.name, *(ChannelId(name, t) for t in header.tracks))
        self.memory = {track: new_record(INTEGRATOR) for track in header.tracks}
        if self.keeps_source:
            return header.adding(*(ChannelId(self.target, track) for track in header.tracks))
        return header.replacing(self.source, self.target)

    def advance(self, block: Block) -> Block:
        """Integrate every track."""
        values, flags = {}, {}
        for track, memory in self.memory.items():
            source, target = ChannelId(self.source, track), ChannelId(self.target, track)
            self._begin(block, track, memory)
            values[target] = self._integral(block, block[source], memory)
            marks = flags_of(block, source)
            if marks is not None:
                flags[target] = marks
        made = block.setting(values, flags)
        return made if self.keeps_source else made.without(self.source)

    def _begin(self, block: Block, track: str, memory: np.record) -> None:
        if self.starts_at is None or memory.started or len(block) == 0:
            return
        first = block[ChannelId(self.starts_at, track)][0]
        memory.total = 0.0 if np.isnan(first) else first

    def _integral(self, block: Block, x: FloatArray, memory: np.record) -> FloatArray:
        from floatref.kernels import motion

        y = np.empty(x.size)
        if self._over_distance:
            motion.integrate_steps(x, y, memory, block[ChannelId(TIME_STEP)])
        else:
            motion.integrate(x, y, memory, self._half_step)
        return y


class Combine(Stage):
    """Adds `elevation` = `floating_reference_height` - `height` (1.2) and drops the two."""

    def open(self, header: Header) -> Header:
        """Ask for both heights of every track."""
        self._tracks = header.tracks
        for name in (REFERENCE_HEIGHT, HEIGHT):
            header.require(self.name, *(ChannelId(name, t) for t in header.tracks))
        return header.replacing(REFERENCE_HEIGHT, ELEVATION).without(HEIGHT)

    def advance(self, block: Block) -> Block:
        """Subtract; a flag of either is a flag of the elevation."""
        values, flags = {}, {}
        for track in self._tracks:
            reference, height = ChannelId(REFERENCE_HEIGHT, track), ChannelId(HEIGHT, track)
            target = ChannelId(ELEVATION, track)
            values[target] = block[reference] - block[height]
            marks = flags_of(block, reference, height)
            if marks is not None:
                flags[target] = marks
        return block.setting(values, flags).without(REFERENCE_HEIGHT, HEIGHT)


class RemoveMean(Stage):
    """Subtracts from ``channel`` of every track its mean over the run.

    The mean is that of the samples that are not missing; it needs the whole run before the first
    output, so the engine surveys the run first. Missing samples stay missing.
    """

    surveys = True
    declared = Declared(shift_invariant=False)

    def __init__(self, channel: str) -> None:
        """Remove the mean of ``channel``."""
        super().__init__()
        self.channel = channel

    def open(self, header: Header) -> Header:
        """Ask for the channel of every track."""
        header.require(self.name, *(ChannelId(self.channel, t) for t in header.tracks))
        self.memory = {track: new_record(SUM) for track in header.tracks}
        return header

    def survey(self, block: Block) -> None:
        """Add the block to the sums."""
        from floatref.kernels import motion

        for track, memory in self.memory.items():
            motion.add_up(block[ChannelId(self.channel, track)], memory)

    def advance(self, block: Block) -> Block:
        """Subtract the mean."""
        values = {}
        for track, found in self.memory.items():
            channel = ChannelId(self.channel, track)
            mean = (found.total + found.rest) / max(found.count, 1)
            values[channel] = block[channel] - mean
        return block.setting(values)
