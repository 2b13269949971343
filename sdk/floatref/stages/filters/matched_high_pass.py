"""The exactly matched high-pass: an observer in place of both integrations."""

import numpy as np

from floatref.errors import InputError
from floatref.kernels.compiling import compiled
from floatref.stages.filters.varying import tangents
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ACCELERATION, CUTOFF, HEIGHT, REFERENCE_HEIGHT
from floatref.values.arrays import FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

MEMORY = 10
"""Length of the memory: started, the last a, h and c, then the states."""


@compiled
def observe(
    acceleration: FloatArray,
    height: FloatArray,
    c: FloatArray,
    reference: FloatArray,
    memory: FloatArray,
    step: float,
) -> None:
    """Write the floating reference height r that follows ``height`` below the cut-off.

    The observer r' = v + 2w (h - r), v' = a + b + 2w^2 (h - r), b' = w^3 (h - r) by the
    trapezoidal rule with w dt/2 = c_k of (A.11) inside the integrals, so that r - h is the
    filter (A.1) of the profile. v and b are kept in metres, as v dt/2 and b dt^2/4; what each
    sample adds is solved for e = r - h in closed form. Missing (NaN) values are bridged by those
    before them, zero acceleration and c if there are none; r is 0 before the first height.
    """
    scale = 0.25 * step * step
    started, pushed, held, rate = memory[0], memory[1], memory[2], memory[3]
    e, v, b, r = memory[4], memory[5], memory[6], memory[7]
    for i in range(height.size):
        push = scale * acceleration[i]
        push = push if push == push else pushed
        rate_1 = rate
        rate = c[i] if c[i] == c[i] else rate
        held = height[i] if height[i] == height[i] else held
        if started == 0.0:
            pushed = push
            if height[i] == height[i]:
                started, r = 1.0, held
            reference[i] = r
            continue
        square, square_1 = rate * rate, rate_1 * rate_1
        b_new = b - square_1 * rate_1 * e
        v_new = v + (push + pushed) + (b + b_new) - 2.0 * square_1 * e
        r_new = r + (v + v_new) - 2.0 * rate_1 * e
        e = (r_new - held) / ((1.0 + rate) * (1.0 + rate + square))
        b = b_new - square * rate * e
        v = v_new - (square * rate + 2.0 * square) * e
        r = held + e
        pushed = push
        reference[i] = r
    memory[0], memory[1], memory[2], memory[3] = started, pushed, held, rate
    memory[4], memory[5], memory[6], memory[7] = e, v, b, r


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
        self.memory = {track: np.zeros(10) for track in header.tracks}
        return header.replacing(ACCELERATION, REFERENCE_HEIGHT)

    def advance(self, block: Block) -> Block:
        """Observe every track."""
        from floatref.stages.filters import matched_high_pass

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
