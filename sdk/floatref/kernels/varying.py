"""The high-pass stages of appendix A with a cut-off of its own at every sample.

They are the recursions (A.9) and (A.10) with the coefficients of Table A.1 taken from
c_k = tan(pi f_c dt) of the sample being computed and applied to the inputs and outputs before
it. The state is not the past input but the part removed from it, e = x - y,
which changes slowly and by small amounts, so nothing cancels at a low cut-off. With D the
difference to the sample before,

    S1:  D e = c_k (y_k + y_{k-1})
    S2:  D^2 e = c_k (y_k - y_{k-2}) + c_k^2 (y_k + 2 y_{k-1} + y_{k-2})

Without the share of y_k itself, e_k is known before y_k and called r for S1 and t for S2; g is
the step that t is about to take. With a_k = c_k + c_k^2:

    S1:  r += (c_{k-1} + c_k) y_{k-1},  y_k = (x_k - r) / (1 + c_k)
    S2:  g += (c_k^2 - c_k) y_{k-2},  b = a_{k-1} + c_k^2,
         t += g + 2 b y_{k-1},  g += (b + c_k^2) y_{k-1},  y_k = (x_k - t) / (1 + a_k)

Each kernel reads ``x`` and ``c`` and writes ``y`` (it may be ``x``), from the last sample down if
``backward``. A missing (NaN) input or c is bridged by the one before it; the output is 0 before the
first of both.
"""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray


@compiled
def _lead(x: FloatArray, c: FloatArray, memory: np.record, backward: bool) -> int:
    """Return the number of the first sample up to which an input and a c have occurred."""
    has_x, has_c = memory.has_x, memory.has_c
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        has_x = has_x or x[i] == x[i]
        has_c = has_c or c[i] == c[i]
        if has_x and has_c:
            return j
    return int(x.size)


@compiled
def _begin(x: FloatArray, y: FloatArray, c: FloatArray, memory: np.record, backward: bool) -> int:
    """Write 0 up to that sample, keep the input and c there and return its number."""
    lead = _lead(x, c, memory, backward)
    for j in range(min(lead + 1, x.size)):
        i = x.size - 1 - j if backward else j
        if x[i] == x[i]:
            memory.has_x, memory.x = True, x[i]
        if c[i] == c[i]:
            memory.has_c, memory.c = True, c[i]
        if j < lead:
            y[i] = 0.0
    return lead


@compiled
def _bridge(x: FloatArray, last: float, backward: bool) -> tuple[FloatArray, float]:
    """Return ``x`` with missing samples bridged, from the ``last`` before it on, and its last."""
    missing = 0
    for i in range(x.size):
        missing += 0 if x[i] == x[i] else 1
    if missing == 0:
        if x.size > 0:
            last = x[0 if backward else x.size - 1]
        return x, last
    whole = np.empty(x.size)
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        if x[i] == x[i]:
            last = x[i]
        whole[i] = last
    return whole, last


@compiled
def high_pass_1(
    x: FloatArray, y: FloatArray, c: FloatArray, memory: np.record, backward: bool
) -> None:
    """HPF_B3S1: (A.2), started by (A.14) or, backward, (A.18)."""
    begin = 0
    if not (memory.has_x and memory.has_c):
        begin = _begin(x, y, c, memory, backward)
        memory.r, memory.y1 = memory.c * memory.x, 0.0
    r, y1 = memory.r, memory.y1
    rest = slice(0, x.size - begin) if backward else slice(begin, x.size)
    rate, y = memory.c, y[rest]
    x, memory.x = _bridge(x[rest], memory.x, backward)
    c, memory.c = _bridge(c[rest], memory.c, backward)
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        before = rate
        rate = c[i]
        r = r + (before + rate) * y1
        y1 = (x[i] - r) * (1.0 / (1.0 + rate))
        y[i] = y1
    memory.r, memory.y1 = r, y1


@compiled
def _start_2(memory: np.record) -> float:
    """Set the states of HPF_B3S2 to those of (A.15) and return its first output.

    The second sample of (A.15) sees (x1, y1) twice; these states are that past.
    """
    x1, c = memory.x, memory.c
    a = c + c * c
    y1: float = x1 * (1.0 + c - 3.0 * c * c) * (1.0 / (1.0 + a))
    memory.t, memory.g = x1 * (3.0 * c * c - c), -a * y1
    memory.y1, memory.y2, memory.a = y1, y1, a
    return y1


@compiled
def high_pass_2(
    x: FloatArray, y: FloatArray, c: FloatArray, memory: np.record, backward: bool
) -> None:
    """HPF_B3S2: (A.3), started by (A.15) or, backward, by its mirror image (A.19)."""
    begin = 0
    if not (memory.has_x and memory.has_c):
        begin = _begin(x, y, c, memory, backward)
        if begin == x.size:
            return
        y[x.size - 1 - begin if backward else begin] = _start_2(memory)
        begin += 1
    t, g, y1, y2, a = memory.t, memory.g, memory.y1, memory.y2, memory.a
    rest = slice(0, x.size - begin) if backward else slice(begin, x.size)
    y = y[rest]
    x, memory.x = _bridge(x[rest], memory.x, backward)
    c, memory.c = _bridge(c[rest], memory.c, backward)
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        rate = c[i]
        square = rate * rate
        g = g + (square - rate) * y2
        b = a + square
        t = (t + g) + (b + b) * y1
        g = g + (b + square) * y1
        a = rate + square
        y2 = y1
        y1 = (x[i] - t) * (1.0 / (1.0 + a))
        y[i] = y1
    memory.t, memory.g, memory.y1, memory.y2, memory.a = t, g, y1, y2, a


@compiled
def high_pass_12(
    x: FloatArray,
    y: FloatArray,
    c: FloatArray,
    first: np.record,
    second: np.record,
    backward: bool,
) -> None:
    """HPF_B3S1 then HPF_B3S2 in one loop, in which the two recursions overlap."""
    begin = 0
    if not (first.has_x and first.has_c and second.has_x and second.has_c):
        begin = min(_lead(x, c, first, backward) + 1, x.size)
        part = slice(x.size - begin, x.size) if backward else slice(0, begin)
        high_pass_1(x[part], y[part], c[part], first, backward)
        high_pass_2(y[part], y[part], c[part], second, backward)
    r, z1 = first.r, first.y1
    t, g, y1, y2, a = second.t, second.g, second.y1, second.y2, second.a
    rest = slice(0, x.size - begin) if backward else slice(begin, x.size)
    rate, y = first.c, y[rest]
    x, first.x = _bridge(x[rest], first.x, backward)
    c, first.c = _bridge(c[rest], first.c, backward)
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        before = rate
        rate = c[i]
        square = rate * rate
        one = 1.0 + rate
        two = one + square
        both = 1.0 / (one * two)
        r = r + (before + rate) * z1
        z1 = (x[i] - r) * (two * both)
        g = g + (square - rate) * y2
        b = a + square
        t = (t + g) + (b + b) * y1
        g = g + (b + square) * y1
        a = rate + square
        y2 = y1
        y1 = (z1 - t) * (one * both)
        y[i] = y1
    first.r, first.y1 = r, z1
    second.x, second.c = z1, first.c
    second.t, second.g, second.y1, second.y2, second.a = t, g, y1, y2, a


@compiled
def high_pass_21(
    x: FloatArray,
    y: FloatArray,
    c: FloatArray,
    second: np.record,
    first: np.record,
    backward: bool,
) -> None:
    """HPF_B3S2 then HPF_B3S1 in one loop, in which the two recursions overlap."""
    begin = 0
    if not (first.has_x and first.has_c and second.has_x and second.has_c):
        begin = min(_lead(x, c, second, backward) + 1, x.size)
        part = slice(x.size - begin, x.size) if backward else slice(0, begin)
        high_pass_2(x[part], y[part], c[part], second, backward)
        high_pass_1(y[part], y[part], c[part], first, backward)
    r, z1 = first.r, first.y1
    t, g, y1, y2, a = second.t, second.g, second.y1, second.y2, second.a
    rest = slice(0, x.size - begin) if backward else slice(begin, x.size)
    rate, y = second.c, y[rest]
    x, second.x = _bridge(x[rest], second.x, backward)
    c, second.c = _bridge(c[rest], second.c, backward)
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        before = rate
        rate = c[i]
        square = rate * rate
        one = 1.0 + rate
        two = one + square
        both = 1.0 / (one * two)
        g = g + (square - rate) * y2
        b = a + square
        t = (t + g) + (b + b) * y1
        g = g + (b + square) * y1
        a = rate + square
        y2 = y1
        y1 = (x[i] - t) * (one * both)
        r = r + (before + rate) * z1
        z1 = (y1 - r) * (two * both)
        y[i] = z1
    second.t, second.g, second.y1, second.y2, second.a = t, g, y1, y2, a
    first.x, first.c, first.r, first.y1 = y1, second.c, r, z1
