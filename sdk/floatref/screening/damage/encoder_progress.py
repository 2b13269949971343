"""The farthest distance of an encoder at knots, and the samples that lie behind it."""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray, Records, new_record

KNOT = np.dtype(
    [
        (name, np.int64)
        for name in ("at", "steps", "step", "before_step", "front", "gap", "after_gap", "since")
    ],
    align=True,
)
"""A knot: its sample and the number of steps since the last one; of the largest of these the
sample, the last known one before it, and the first as far as that; the two samples between which
it took longest; and the first sample as far as the one before the knot."""
PROGRESS = np.dtype(
    [
        ("coming", KNOT),
        ("known", np.int64),
        *((name, np.float64) for name in ("far", "last", "knot_t", "far_t")),
        *((name, np.float64) for name in ("longest", "largest", "knot_x", "usual")),
    ],
    align=True,
)
"""What is known of the next knot, whose ``since`` is the first sample at the farthest distance; the
last known sample; the farthest distance, and that of the last known sample; the times of the last
knot and of the first sample as far; the longest interval and the largest step since the knot; its
distance; and the usual step."""
SPIKE = 5.0
"""A spike is higher than this number of recent steps, and returns by at least half."""


def new_progress() -> np.record:
    """Return the memory of `follow` before any sample."""
    progress = new_record(PROGRESS)
    progress.far = progress.last = progress.knot_t = progress.knot_x = -np.inf
    progress.usual = np.inf
    return progress


@compiled
def follow(
    x: FloatArray,
    count: int,
    first: int,
    times: FloatArray,
    apart: float,
    progress: np.record,
    knots: Records,
    behind: IndexArray,
    depths: FloatArray,
) -> tuple[int, int]:
    """Follow ``x[:count]``; return the numbers of rows written to ``knots`` and ``behind``.

    ``x[0]`` is sample ``first`` of the channel; samples beyond ``count`` show whether the last one
    returns at once. ``times`` are those of ``x``; if empty, time counts in samples. A knot is a
    sample farther than all before it, ``apart`` or more after the last knot. A row of ``behind`` is
    a stretch of samples behind the farthest, by up to its entry of ``depths``, or a spike, whose
    depth is its height. Missing (NaN) samples are skipped.
    """
    rows, back, coming = 0, 0, progress.coming
    far, last, far_t = progress.far, progress.last, progress.far_t
    longest, largest = progress.longest, progress.largest
    known, front, steps = progress.known, coming.since, coming.steps
    for i in range(count):
        value, now = x[i], first + i
        if value != value:
            continue
        after = x[i + 1] if i + 1 < x.size else value
        if value < far or (after < value and _is_spike(value, after, far, last, progress.usual)):
            back = _extend(behind, depths, back, now, abs(far - value))
            last, known = (value, now) if value < far else (last, known)
            continue
        if value > far:
            t = times[i] if times.size > 0 else float(now)
            steps += 1
            if value - far > largest:
                largest = value - far
                coming.step, coming.before_step, coming.front = now, known, front
            if t - far_t > longest:
                longest = t - far_t
                coming.gap, coming.after_gap = front, now
            if t - progress.knot_t >= apart:
                coming.at, coming.steps, coming.since = now, steps, front
                rows = _tie(value, t, progress, knots, rows)
                longest, largest, steps = 0.0, 0.0, 0
            far, far_t, front = value, t, now
        last, known = value, now
    progress.far, progress.last, progress.far_t = far, last, far_t
    progress.longest, progress.largest = longest, largest
    progress.known, coming.since, coming.steps = known, front, steps
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
def _tie(value: float, t: float, progress: np.record, knots: Records, rows: int) -> int:
    """Write the new knot; return the number of knots."""
    knots[rows] = progress.coming
    progress.usual = (value - progress.knot_x) / progress.coming.steps
    progress.knot_t, progress.knot_x = t, value
    return rows + 1
