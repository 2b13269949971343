"""The exactly matched high-pass: an observer in place of both integrations."""

import numpy as np

from floatref.errors import InputError
from floatref.kernels.memories import OBSERVER
from floatref.stages.filters.varying import tangents
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ACCELERATION, CUTOFF, HEIGHT, REFERENCE_HEIGHT
from floatref.values.arrays import new_record
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId


class MatchedHighPass(Stage):
    """Adds `floating_reference_height`, drawn to `height` below `high_pass_cutoff`.

    r' = v + 2w (h - r), v' = a + b + 2w^2 (h - r), b' = w^3 (h - r): at a constant cut-off
    r - h is exactly the third-order filter (A.1) of the profile, and the vehicle's own motion
    cancels under any schedule of it. It is discretized by the trapezoidal rule with
    w dt/2 = tan(pi f_c dt) of (A.7), and started at the first height without velocity.
    `vertical_acceleration` is dropped. A missing value is bridged by the one before it and
    flagged. The stage removes content below the cut-off from every point, and the points within
    about a wavelength of the cut-off from the start are its run-in.
    """

    declared = Declared()

    def __init__(self) -> None:
        """Wait for `start`."""
        super().__init__()
        self._step = 1.0

    def open(self, header: Header) -> Header:
        """Ask for both sensors of every track and the cut-off, in time."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        header.require(self.name, ChannelId(CUTOFF))
        for name in (ACCELERATION, HEIGHT):
            header.require(self.name, *(ChannelId(name, t) for t in header.tracks))
        self._step = header.step
        self.memory = {track: new_record(OBSERVER) for track in header.tracks}
        return header.replacing(ACCELERATION, REFERENCE_HEIGHT)

    def advance(self, block: Block) -> Block:
        """Observe every track."""
        from floatref.kernels import matched_high_pass

        values, flags = {}, {}
        cutoff = ChannelId(CUTOFF)
        c = tangents(block[cutoff], self._step, self.name)
        for track, memory in self.memory.items():
            source, height = ChannelId(ACCELERATION, track), ChannelId(HEIGHT, track)
            target = ChannelId(REFERENCE_HEIGHT, track)
            r = np.empty(len(block))
            matched_high_pass.observe(block[source], block[height], c, r, memory, self._step)
            values[target] = r
            marks = flags_of(block, source, height, cutoff)
            if marks is not None:
                flags[target] = marks
        return block.setting(values, flags).without(ACCELERATION)
