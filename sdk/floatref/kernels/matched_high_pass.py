"""The high-pass filter as an observer of the road: one loop over acceleration and height."""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray


@compiled
def observe(
    acceleration: FloatArray,
    height: FloatArray,
    c: FloatArray,
    reference: FloatArray,
    memory: np.record,
    step: float,
) -> None:
    """Write the floating reference height r that follows ``height`` below the cut-off.

    The observer r' = v + 2w (h - r), v' = a + b + 2w^2 (h - r), b' = w^3 (h - r) by the trapezoidal
    rule with w dt/2 = c_k of (A.11) inside the integrals, so that r - h is the filter (A.1) of the
    profile. v and b are kept in metres, as v dt/2 and b dt^2/4; the contribution of each sample is
    solved for e = r - h in closed form. Missing (NaN) values are bridged by those before them, by
    zero acceleration and c at the start; r is 0 before the first height.
    """
    scale = 0.25 * step * step
    started, pushed, held, rate = memory.started, memory.pushed, memory.held, memory.c
    e, v, b, r = memory.e, memory.v, memory.b, memory.r
    for i in range(height.size):
        push = scale * acceleration[i]
        push = push if push == push else pushed
        rate_1 = rate
        rate = c[i] if c[i] == c[i] else rate
        held = height[i] if height[i] == height[i] else held
        if not started:
            pushed = push
            if height[i] == height[i]:
                started, r = True, held
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
    memory.started, memory.pushed, memory.held, memory.c = started, pushed, held, rate
    memory.e, memory.v, memory.b, memory.r = e, v, b, r
