"""The farthest distance of an encoder at knots, and the samples that lie behind it."""

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray

KNOT = 8
"""Columns of a knot: its sample and the number of steps since the last one; of the largest of these
the sample, the last known one before it, and the first as far as that; the two samples between
which it took longest; and the sample before it."""
FAR, BEFORE, KNOT_T, FAR_T, LONGEST, LARGEST, KNOT_X, USUAL = range(8)
"""Levels: the farthest distance, the last known sample, the times of the last knot and of the first
sample as far, the longest interval and the largest step since the knot, its distance, and the usual
step."""
FRONT, KNOWN = 7, 8
"""After the columns of the next knot: the first sample at the farthest distance, the last known."""
SPIKE = 5.0
"""A spike is higher than this number of recent steps, and returns by at least half."""


@compiled
def follow(
    x: FloatArray,
    count: int,
    first: int,
    times: FloatArray,
    apart: float,
    levels: FloatArray,
    coming: IndexArray,
    knots: IndexArray,
    behind: IndexArray,
    depths: FloatArray,
) -> tuple[int, int]:
    """Follow ``x[:count]``; return the numbers of rows written to ``knots`` and ``behind``.

    ``x[0]`` is sample ``first`` of the channel; samples beyond ``count`` show whether the last one
    returns at once. ``times`` are those of ``x``; if empty, time counts in samples. A knot is a
    sample farther than all before it, ``apart`` or more after the last knot. A row of ``behind`` is
    a stretch of samples behind the farthest, by up to its entry of ``depths``, or a spike, whose
    depth is its height. Missing (NaN) samples are skipped.

    Of ``levels`` the distances, and the time of the knot, start as minus infinity, the usual step
    as infinite, all others as 0.
    """
    rows, back = 0, 0
    far, last, far_t, longest, largest = levels[0], levels[1], levels[3], levels[4], levels[5]
    known, front, steps = coming[KNOWN], coming[FRONT], coming[1]
    for i in range(count):
        value, now = x[i], first + i
        if value != value:
            continue
        after = x[i + 1] if i + 1 < x.size else value
        if value < far or (after < value and _is_spike(value, after, far, last, levels[USUAL])):
            back = _extend(behind, depths, back, now, abs(far - value))
            last, known = (value, now) if value < far else (last, known)
            continue
        if value > far:
            t = times[i] if times.size > 0 else float(now)
            steps += 1
            if value - far > largest:
                largest = value - far
                coming[2], coming[3], coming[4] = now, known, front
            if t - far_t > longest:
                longest = t - far_t
                coming[5], coming[6] = front, now
            if t - levels[KNOT_T] >= apart:
                coming[0], coming[1], coming[FRONT] = now, steps, front
                rows = _tie(value, t, levels, coming, knots, rows)
                longest, largest, steps = 0.0, 0.0, 0
            far, far_t, front = value, t, now
        last, known = value, now
    levels[0], levels[1], levels[3], levels[4], levels[5] = far, last, far_t, longest, largest
    coming[KNOWN], coming[FRONT], coming[1] = known, front, steps
    return rows, back


@compiled
def _is_spike(value: float, after: float, far: float, last: float, usual: float) -> bool:
    """Return whether ``value`` is far ahead, but what comes ``after`` is not."""
    return value - far > SPIKE * usual and value - after > 0.5 * (value - last)


@compiled
def _extend(behind: IndexArray, depths: FloatArray, back: int, now: int, depth: float) -> int:
    """Add sample ``now`` to the last stretch, or begin one; return the number of stretches."""
    if back == 0 or behind[back - 1, 1] != now:
        behind[back, 0], depths[back] = now, 0.0
        back += 1
    behind[back - 1, 1], depths[back - 1] = now + 1, max(depths[back - 1], depth)
    return back


@compiled
def _tie(
    value: float, t: float, levels: FloatArray, coming: IndexArray, knots: IndexArray, rows: int
) -> int:
    """Write the new knot; return the number of knots."""
    for k in range(KNOT):
        knots[rows, k] = coming[k]
    levels[USUAL] = (value - levels[KNOT_X]) / coming[1]
    levels[KNOT_T], levels[KNOT_X] = t, value
    return rows + 1
