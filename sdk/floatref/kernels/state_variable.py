"""Butterworth stages in trapezoidal state-variable form, after appendix A of Karamihas (2021).

The transfer functions are those of (A.1)-(A.8), the outputs those of the recursions (A.9) and
(A.10) with Table A.1; the states are the integrators of the analog prototype, so nothing cancels
at a cut-off a million times below the sampling rate. With
c = tan(pi f_c dt) (A.11), a first-order stage has one state s and a second-order stage two:

    S1:  hp = (x - s) / (1 + c),  lp = x - hp,  s += 2 c hp
    S2:  hp = (x - s2 - (1 + c) s1) / (1 + c + c^2),  bp = s1 + c hp,  lp = s2 + c bp,
         s1 += 2 c hp,  s2 += 2 c bp

Each kernel reads ``x`` and writes ``y`` (they may be one array), from the last sample down if
``backward``. A missing (NaN) input is bridged by the one before it, and gives 0 before the first
input. The states are advanced by small products of themselves, the newest last, because the loop
waits for nothing else.
"""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray


@compiled
def _missing_lead(x: FloatArray, backward: bool) -> int:
    for j in range(x.size):
        i = x.size - 1 - j if backward else j
        if x[i] == x[i]:
            return j
    return int(x.size)


@compiled
def _begin(x: FloatArray, y: FloatArray, memory: np.record, backward: bool) -> int:
    """Write 0 up to the first sample that is not missing and store it; return its number."""
    lead = _missing_lead(x, backward)
    for j in range(lead):
        y[x.size - 1 - j if backward else j] = 0.0
    if lead < x.size:
        memory.started, memory.held = True, x[x.size - 1 - lead if backward else lead]
    return lead


@compiled
def high_pass_1(x: FloatArray, y: FloatArray, memory: np.record, c: float, backward: bool) -> None:
    """HPF_B3S1: (A.2), started by (A.14) or, backward, (A.18).

    Digitized by (A.6) to (A.8); runs as (A.9) or (A.10) with its row of Table A.1 would.
    """
    begin = 0
    if not memory.started:
        begin = _begin(x, y, memory, backward)
        memory.s1 = c * memory.held
    held, s = memory.held, memory.s1
    gain = 1.0 / (1.0 + c)
    k = 2.0 * c * gain
    for j in range(begin, x.size):
        i = x.size - 1 - j if backward else j
        value = x[i]
        if value != value:
            value = held
        held = value
        y[i] = (value - s) * gain
        s = (s - k * s) + k * value
    memory.held, memory.s1 = held, s


@compiled
def low_pass_1(x: FloatArray, y: FloatArray, memory: np.record, c: float, backward: bool) -> None:
    """LPF_B3S1: (A.4), started by (A.12) or, backward, (A.16).

    Digitized by (A.6) to (A.8); runs as (A.9) or (A.10) with its row of Table A.1 would.
    """
    begin = 0
    if not memory.started:
        begin = _begin(x, y, memory, backward)
        memory.s1 = memory.held
    held, s = memory.held, memory.s1
    gain = c / (1.0 + c)
    k = 2.0 * gain
    for j in range(begin, x.size):
        i = x.size - 1 - j if backward else j
        value = x[i]
        if value != value:
            value = held
        held = value
        y[i] = s + gain * (value - s)
        s = (s - k * s) + k * value
    memory.held, memory.s1 = held, s


@compiled
def high_pass_2(x: FloatArray, y: FloatArray, memory: np.record, c: float, backward: bool) -> None:
    """HPF_B3S2: (A.3), started by (A.15) or, backward, by its mirror image (A.19).

    Digitized by (A.6) to (A.8); runs as (A.9) or (A.10) with its row of Table A.1 would.
    """
    d = 1.0 / (1.0 + c + c * c)
    begin = 0
    if not memory.started:
        begin = _begin(x, y, memory, backward)
        started = (1.0 + c - 3.0 * c * c) * d * memory.held
        # The second sample of (A.15) sees (x1, y1) twice; these two states are that past.
        memory.s1 = (2.0 * c - 1.0) * started
        memory.s2 = memory.held + (c * c - 2.0 * c) * started
        if begin < x.size:
            y[x.size - 1 - begin if backward else begin] = started
            begin += 1
    held, s1, s2 = memory.held, memory.s1, memory.s2
    p = 1.0 + c
    k1 = 2.0 * c * d
    k2, k3 = k1 * p, k1 * c
    for j in range(begin, x.size):
        i = x.size - 1 - j if backward else j
        value = x[i]
        if value != value:
            value = held
        held = value
        y[i] = ((value - s2) - p * s1) * d
        s1_next = (s1 - k2 * s1) + (k1 * value - k1 * s2)
        s2 = (s2 - k3 * s2) + (k1 * s1 + k3 * value)
        s1 = s1_next
    memory.held, memory.s1, memory.s2 = held, s1, s2


@compiled
def low_pass_2(x: FloatArray, y: FloatArray, memory: np.record, c: float, backward: bool) -> None:
    """LPF_B3S2: (A.5), started by (A.13) or, backward, (A.17).

    Digitized by (A.6) to (A.8); runs as (A.9) or (A.10) with its row of Table A.1 would.
    """
    begin = 0
    if not memory.started:
        begin = _begin(x, y, memory, backward)
        memory.s1, memory.s2 = 0.0, memory.held
    held, s1, s2 = memory.held, memory.s1, memory.s2
    d = 1.0 / (1.0 + c + c * c)
    p = 1.0 + c
    k1 = 2.0 * c * d
    k2, k3 = k1 * p, k1 * c
    for j in range(begin, x.size):
        i = x.size - 1 - j if backward else j
        value = x[i]
        if value != value:
            value = held
        held = value
        y[i] = s2 + c * d * (s1 + c * (value - s2))
        s1_next = (s1 - k2 * s1) + (k1 * value - k1 * s2)
        s2 = (s2 - k3 * s2) + (k1 * s1 + k3 * value)
        s1 = s1_next
    memory.held, memory.s1, memory.s2 = held, s1, s2


@compiled
def low_pass_12(
    x: FloatArray, y: FloatArray, first: np.record, second: np.record, c: float
) -> None:
    """LPF_B3S1 then LPF_B3S2 in one loop, forward, with the bits of one after the other.

    What the first one hands on is a sum, so no product of it is fused into the second.
    """
    begin = 0
    if not first.started:
        begin = _missing_lead(x, False)
        if begin > 0:
            # The second stage sees the zeros that the first gives before its start.
            second.started, second.held, second.s1, second.s2 = True, 0.0, 0.0, 0.0
            y[:begin] = 0.0
        if begin < x.size:
            first.started, first.held, first.s1 = True, x[begin], x[begin]
            if not second.started:
                second.started, second.s1, second.s2 = True, 0.0, x[begin]
    held, s, low, s1, s2 = first.held, first.s1, second.held, second.s1, second.s2
    gain = c / (1.0 + c)
    k = 2.0 * gain
    d = 1.0 / (1.0 + c + c * c)
    p = 1.0 + c
    k1 = 2.0 * c * d
    k2, k3 = k1 * p, k1 * c
    for i in range(begin, x.size):
        value = x[i]
        if value != value:
            value = held
        held = value
        low = s + gain * (value - s)
        s = (s - k * s) + k * value
        y[i] = s2 + c * d * (s1 + c * (low - s2))
        s1_next = (s1 - k2 * s1) + (k1 * low - k1 * s2)
        s2 = (s2 - k3 * s2) + (k1 * s1 + k3 * low)
        s1 = s1_next
    first.held, first.s1, second.held, second.s1, second.s2 = held, s, low, s1, s2


@compiled
def high_pass_21(
    x: FloatArray, y: FloatArray, second: np.record, first: np.record, c: float, backward: bool
) -> None:
    """HPF_B3S2 then HPF_B3S1 in one loop, in which the two recursions overlap."""
    n = x.size
    if n == 0:
        return
    begin = 0
    if not second.started:
        begin = min(_missing_lead(x, backward) + 1, n)
        start = n - begin if backward else 0
        high_pass_2(x[start : start + begin], y[start : start + begin], second, c, backward)
        high_pass_1(y[start : start + begin], y[start : start + begin], first, c, backward)
    held, s1, s2, s = second.held, second.s1, second.s2, first.s1
    d = 1.0 / (1.0 + c + c * c)
    p = 1.0 + c
    k1 = 2.0 * c * d
    k2, k3 = k1 * p, k1 * c
    gain = 1.0 / (1.0 + c)
    k = 2.0 * c * gain
    for j in range(begin, n):
        i = n - 1 - j if backward else j
        value = x[i]
        if value != value:
            value = held
        held = value
        high = ((value - s2) - p * s1) * d
        s1_next = (s1 - k2 * s1) + (k1 * value - k1 * s2)
        s2 = (s2 - k3 * s2) + (k1 * s1 + k3 * value)
        s1 = s1_next
        y[i] = (high - s) * gain
        s = (s - k * s) + k * high
    second.held, second.s1, second.s2, first.s1 = held, s1, s2, s
