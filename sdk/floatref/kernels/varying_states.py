"""High-pass stages with a varying cut-off in trapezoidal state-variable form.

The states are the band-pass and low-pass outputs of the analog prototype, bp' = w hp and
lp' = w bp, so a change of the cut-off does not change the removed part. The direct
recursion (A.9) keeps the slope of its output instead, and a backward pass that comes from a
stop, where the cut-off falls from one sample to the next, amplifies a step by that. At a
constant cut-off both are the same filter, see `state_variable`.

Each kernel reads ``x`` and ``c`` (A.11) and writes ``y``, from the last sample down if
``backward``. A missing (NaN) input or c is bridged by the one before it, and gives 0 before the
first of both.
"""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray


@compiled
def high_pass_1(
    x: FloatArray, y: FloatArray, c: FloatArray, memory: np.record, backward: bool
) -> None:
    """HPF_B3S1: (A.2), started by (A.14) or, backward, (A.18)."""
    started, held, ck, s = memory.started, memory.held, memory.c, memory.s1
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        there = x[i] == x[i] and c[i] == c[i]
        if not (started or there):
            y[i] = 0.0
            continue
        held = x[i] if x[i] == x[i] else held
        ck = c[i] if c[i] == c[i] else ck
        if not started:
            started, s = True, ck * held
        high = (held - s) / (1.0 + ck)
        s += 2.0 * ck * high
        y[i] = high
    memory.started, memory.held, memory.c, memory.s1 = started, held, ck, s


@compiled
def high_pass_2(
    x: FloatArray, y: FloatArray, c: FloatArray, memory: np.record, backward: bool
) -> None:
    """HPF_B3S2: (A.3), started by (A.15) or, backward, by its mirror image (A.19)."""
    started, held, ck = memory.started, memory.held, memory.c
    s1, s2 = memory.s1, memory.s2
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        there = x[i] == x[i] and c[i] == c[i]
        if not (started or there):
            y[i] = 0.0
            continue
        held = x[i] if x[i] == x[i] else held
        ck = c[i] if c[i] == c[i] else ck
        d = 1.0 / (1.0 + ck + ck * ck)
        if not started:
            started = True
            high = (1.0 + ck - 3.0 * ck * ck) * d * held
            # The second sample of (A.15) sees (x1, y1) twice; these two states are that past.
            s1 = (2.0 * ck - 1.0) * high
            s2 = held + (ck * ck - 2.0 * ck) * high
        else:
            high = ((held - s2) - (1.0 + ck) * s1) * d
            band = s1 + ck * high
            s1 += 2.0 * ck * high
            s2 += 2.0 * ck * band
        y[i] = high
    memory.started, memory.held, memory.c = started, held, ck
    memory.s1, memory.s2 = s1, s2
