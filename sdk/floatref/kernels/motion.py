"""Integration, compensated sums, and the search for profile points along the encoder."""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FlagArray, FloatArray, IndexArray

TIE = 1e-6
"""A distance within this fraction of the interval of a point counts as having reached it.

Encoder counts and points often fall on the same decimal; without it the rounding of either
would decide which sample is taken.
"""


@compiled
def integrate(x: FloatArray, y: FloatArray, memory: np.record, half_step: float) -> None:
    """Trapezoidal integral of ``x`` in ``y`` at a constant step; ``half_step`` is half of it.

    A missing (NaN) input is bridged by the one before it. The integral starts at
    ``memory.total``, which is its value at the first sample.
    """
    started, last, total = memory.started, memory.last, memory.total
    for i in range(x.size):
        value = x[i] if x[i] == x[i] else last
        if started:
            total = total + half_step * (value + last)
        started, last = True, value
        y[i] = total
    memory.started, memory.last, memory.total = started, last, total


@compiled
def integrate_steps(x: FloatArray, y: FloatArray, memory: np.record, steps: FloatArray) -> None:
    """Trapezoidal integral of ``x`` in ``y``; ``steps[i]`` leads to sample i, see (5.5)."""
    started, last, total = memory.started, memory.last, memory.total
    for i in range(x.size):
        value = x[i] if x[i] == x[i] else last
        if started:
            total = total + 0.5 * steps[i] * (value + last)
        started, last = True, value
        y[i] = total
    memory.started, memory.last, memory.total = started, last, total


@compiled
def add_up(x: FloatArray, memory: np.record) -> None:
    """Add ``x`` to the compensated (Neumaier) sum of ``memory``, and count its samples.

    Missing (NaN) samples are skipped. The result does not depend on how x was split.
    """
    total, rest, count = memory.total, memory.rest, memory.count
    for i in range(x.size):
        value = x[i]
        if value == value:
            grown = total + value
            if abs(total) >= abs(value):
                rest += (total - grown) + value
            else:
                rest += (value - grown) + total
            total = grown
            count += 1
    memory.total, memory.rest, memory.count = total, rest, count


@compiled
def find_points(
    distance: FloatArray,
    origin: float,
    interval: float,
    first: int,
    sample: IndexArray,
    part: FloatArray,
) -> int:
    """Find points ``first``, ``first + 1``, … among the samples; return how many there are.

    Point k lies at ``origin + k * interval``. ``sample`` gets the first sample that has reached
    it, ``part`` 1; between samples more than an interval apart ``part`` is the fraction of the
    way to it, linear in distance. ``distance[0]`` is the last sample of the stretch before,
    already searched. (The two are kept apart: their sum would round after the split.) No more
    points are found than ``sample`` has room for.
    """
    found = 0
    slack = TIE * interval
    for i in range(1, distance.size):
        step = distance[i] - distance[i - 1]
        while found < sample.size and origin + (first + found) * interval <= distance[i] + slack:
            point = origin + (first + found) * interval
            sample[found] = i
            part[found] = 1.0
            if step > interval + slack and point < distance[i] - slack:
                part[found] = (point - distance[i - 1]) / step
            found += 1
    return found


@compiled
def read_at(
    before: float, x: FloatArray, sample: IndexArray, part: FloatArray, y: FloatArray
) -> None:
    """Write the values at each ``sample``, or ``part`` of the way to it, to ``y``.

    Sample 0 is ``before``, and those behind it are ``x``: the last of a stretch and the next one.
    """
    for k in range(sample.size):
        i = sample[k]
        here = x[i - 1] if i > 0 else before
        if part[k] < 1.0:
            last = x[i - 2] if i > 1 else before
            y[k] = last + part[k] * (here - last)
        else:
            y[k] = here


@compiled
def go_farther(before: float, distance: FloatArray, farthest: FloatArray) -> None:
    """Write the farthest ``distance`` so far to ``farthest``, which begins with the one ``before``.

    A missing (NaN) distance is as far as the one before it.
    """
    farthest[0] = before
    for i in range(distance.size):
        if not (before >= distance[i] or distance[i] != distance[i]):
            before = distance[i]
        farthest[i + 1] = before


@compiled
def gather_flags(
    flags: FlagArray,
    sample: IndexArray,
    part: FloatArray,
    lasting: int,
    pending: int,
    gathered: FlagArray,
) -> int:
    """Write to ``gathered`` the flags of each point; return those still pending.

    A point has the flags of the samples it is read from, and the ``lasting`` bits of all
    samples since the point before: what happens between two points moves all that follow.
    ``flags[0]`` is the last sample of the stretch before, whose lasting bits are ``pending``.
    """
    at = 1
    for k in range(sample.size):
        while at <= sample[k]:
            pending |= flags[at] & lasting
            at += 1
        mark = flags[sample[k]] | pending
        if part[k] < 1.0:
            mark |= flags[sample[k] - 1]
        gathered[k] = mark
        pending = 0
    for i in range(at, flags.size):
        pending |= flags[i] & lasting
    return pending


@compiled
def integrate_reflecting(
    x: FloatArray,
    height: FloatArray,
    y: FloatArray,
    memory: np.record,
    steps: FloatArray,
    true_steps: FloatArray,
) -> None:
    """Trapezoidal integral of ``x`` with reflected ``height`` in ``y``: (5.9).

    ``steps[i]`` is the adjusted step to sample i, ``true_steps[i]`` the real one. Missing
    (NaN) values are bridged by those before them.
    """
    started, last, total, before = memory.started, memory.last, memory.total, memory.height
    for i in range(x.size):
        value = x[i] if x[i] == x[i] else last
        reading = height[i] if height[i] == height[i] else before
        if started:
            total = total + 0.5 * steps[i] * (value + last)
            if true_steps[i] > 0.0:
                ratio = steps[i] / true_steps[i]
                total += (1.0 - ratio * ratio) * (reading - before)
        started, last, before = True, value, reading
        y[i] = total
    memory.started, memory.last, memory.total, memory.height = started, last, total, before


@compiled
def mark_drive(
    distance: FloatArray,
    window: int,
    slow: float,
    stopping: float,
    marks: tuple[int, int],
    flags: FlagArray,
) -> None:
    """Write to ``flags`` the first of ``marks`` for slow travel, the second for braking.

    ``distance`` holds two windows of ``window`` samples before the first flag. Travel is slow if
    the progress over both windows is below ``slow``; a brake counts if, at more than that, it is
    below ``stopping`` times the loss of progress from the window before to the last one. If the
    distance is held between counts, in most samples, that loss must be more than two counts. Where
    a distance is missing (NaN), so is the mark.
    """
    steps = 0
    for i in range(1, 2 * window):
        steps += int(distance[i] > distance[i - 1])
    for i in range(flags.size):
        last = distance[i + 2 * window] - distance[i + window]
        before = distance[i + window] - distance[i]
        steps += int(distance[i + 2 * window] > distance[i + 2 * window - 1])
        steps -= int(i > 0 and distance[i] > distance[i - 1])
        mark = 0
        if last + before < slow:
            mark = marks[0]
        elif last + before < stopping * (before - last):
            known = steps > window or (before - last) * steps > 2.0 * (before + last)
            mark = marks[1] if known else 0
        flags[i] = mark
