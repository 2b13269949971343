"""The high-pass stages of appendix A with a cut-off of its own at every sample.

They are the recursions (A.9) and (A.10) with the coefficients of Table A.1 taken from
c_k = tan(pi f_c dt) of the sample being computed and applied to the inputs and outputs before
it. What is carried on is not the past input but what has been removed from it, e = x - y,
which changes slowly and by small amounts, so nothing cancels at a low cut-off. With D the
difference to the sample before,

    S1:  D e = c_k (y_k + y_{k-1})
    S2:  D^2 e = c_k (y_k - y_{k-2}) + c_k^2 (y_k + 2 y_{k-1} + y_{k-2})

are solved for y_k. Each kernel reads ``x`` and ``c`` and writes ``y`` (it may be ``x``), from the
last sample down if ``backward``. `memory` is float64: how far it is started (3 is fully), the
last input, the last c, then the states. A missing (NaN) input or c is bridged by the one
before it; the output is 0 as long as there is none of either.
"""

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray

MEMORY = 8
"""Length of the memory of one stage."""


@compiled
def _lead(x: FloatArray, y: FloatArray, c: FloatArray, memory: FloatArray, backward: bool) -> int:
    """Write 0 up to the first sample of which all is known, keep it and return its number."""
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        seen_x = memory[0] == 1.0 or x[i] == x[i]
        seen_c = memory[0] == 2.0 or c[i] == c[i]
        if x[i] == x[i]:
            memory[1] = x[i]
        if c[i] == c[i]:
            memory[2] = c[i]
        memory[0] = (1.0 if seen_x else 0.0) + (2.0 if seen_c else 0.0)
        if seen_x and seen_c:
            return j
        y[i] = 0.0
    return int(x.size)


@compiled
def high_pass_1(
    x: FloatArray, y: FloatArray, c: FloatArray, memory: FloatArray, backward: bool
) -> None:
    """HPF_B3S1: (A.2), started by (A.14) or, backward, (A.18)."""
    begin = 0
    if memory[0] != 3.0:
        begin = _lead(x, y, c, memory, backward)
        if begin == x.size:
            return
        memory[4] = (1.0 - memory[2]) / (1.0 + memory[2]) * memory[1]
        memory[3] = memory[1] - memory[4]
        y[x.size - 1 - begin if backward else begin] = memory[4]
        begin += 1
    held, rate, e, y1 = memory[1], memory[2], memory[3], memory[4]
    for j in range(begin, x.size):
        i = x.size - 1 - j if backward else j
        held = x[i] if x[i] == x[i] else held
        rate = c[i] if c[i] == c[i] else rate
        value = ((held - e) - rate * y1) / (1.0 + rate)
        e += rate * (value + y1)
        y1 = value
        y[i] = value
    memory[1], memory[2], memory[3], memory[4] = held, rate, e, y1


@compiled
def high_pass_2(
    x: FloatArray, y: FloatArray, c: FloatArray, memory: FloatArray, backward: bool
) -> None:
    """HPF_B3S2: (A.3), started by (A.15) or, backward, by its mirror image (A.19)."""
    begin = 0
    if memory[0] != 3.0:
        begin = _lead(x, y, c, memory, backward)
        if begin == x.size:
            return
        square = memory[2] * memory[2]
        started = (1.0 + memory[2] - 3.0 * square) / (1.0 + memory[2] + square) * memory[1]
        # The second sample of (A.15) sees (x1, y1) twice, so nothing has changed before it.
        memory[3], memory[4] = memory[1] - started, 0.0
        memory[5], memory[6] = started, started
        y[x.size - 1 - begin if backward else begin] = started
        begin += 1
    held, rate, e, slope = memory[1], memory[2], memory[3], memory[4]
    y1, y2 = memory[5], memory[6]
    for j in range(begin, x.size):
        i = x.size - 1 - j if backward else j
        held = x[i] if x[i] == x[i] else held
        rate = c[i] if c[i] == c[i] else rate
        square = rate * rate
        past = square * (2.0 * y1 + y2) - rate * y2
        value = (((held - e) - slope) - past) / (1.0 + rate + square)
        slope += (rate + square) * value + past
        e += slope
        y2 = y1
        y1 = value
        y[i] = value
    memory[1], memory[2], memory[3], memory[4] = held, rate, e, slope
    memory[5], memory[6] = y1, y2
