"""Encoder samples that tell no travel: behind where it has been, leaps, silence, lost counts."""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.screening.damage.damaged_samples import NONE, Damage, told
from floatref.screening.damage.encoder_path import (
    AFTER_GAP,
    BEFORE_STEP,
    FRONT,
    GAP,
    STEP,
    EncoderPath,
)
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.encoder import FASTEST_MPS
from floatref.values.recording import Channel

SOUND, SILENT, LEAPT, FAST, SLOW, STALLED = range(6)
"""What the way to a knot is: travelled, made up for at once after a silence, a leap, too many
counts, too few, none for too long."""
HARDEST = 2.0 * STANDARD_GRAVITY
"""No vehicle brakes or speeds up so hard, in m/s²."""
UNEVEN = 0.2
"""A wheel that hops or is out of round is faster or slower than the vehicle by this share."""
MOVING_MPS = 2.5
"""At a lower speed lost counts are not looked for; there all is flagged as slow."""
LEAP = 5.0
"""A step beyond so many usual ones, and beyond `FASTEST_MPS`, was not travelled in its time."""
ROUGH = 1.5
"""A way is known within so many usual steps."""
LATE = 2.5
"""A count that takes longer than so many usual intervals is late."""
SHORTEST_S, AT_ONCE = 0.02, 2.5
"""An encoder that is held so long, and then takes more than so many usual steps, was silent."""
MADE_UP = 2.5
"""What comes at once after a silence is what was travelled meanwhile, within this factor."""


@compiled
def least(speed: float, time_s: float) -> float:
    """Return how far a vehicle gets at least that has ``speed`` in m/s, in m."""
    braked_s = min(time_s, max(speed, 0.0) / HARDEST)
    return (max(speed, 0.0) - 0.5 * HARDEST * braked_s) * braked_s


@compiled
def judge(
    table: FloatArray, before: FloatArray, off_m: float, usual_m: float, kinds: IndexArray
) -> None:
    """Write to ``kinds`` what the way to every row of ``table`` is, except the first.

    Columns are the time in s, the distance in m and the number of steps since the row before; of
    the largest step its height, its time, the time since the first sample as far, and the time
    that the encoder was held; of the longest interval its beginning, its time and its height; and
    how much farther the vehicle may be than it counts. ``before`` is the distance, the time and
    the number of steps of two ways like the first; ``off_m`` how far off a knot may be, ``usual_m``
    the usual step. A way is judged by the two sound ones before it.
    """
    old_m, old_s, old_n = before
    new_m, new_s, new_n = before
    sound_t = table[0, 0]
    for k in range(1, kinds.size):
        start, way, took = table[k - 1, 0], table[k, 1] - table[k - 1, 1], table[k, 0]
        took -= start
        step, since_s, hidden = table[k, 3], table[k, 5], table[k, 10]
        speed = (old_m + new_m) / (old_s + new_s)
        local = max(usual_m, (old_m + new_m) / max(old_n + new_n, 1.0))
        unsure = off_m / (old_s + new_s) + HARDEST * (0.5 * (old_s + new_s) + start - sound_t)
        slowest = (1.0 - UNEVEN) * speed - unsure
        most = ((1.0 + UNEVEN) * speed + unsure + 0.5 * HARDEST * took) * took
        steep = step > max(FASTEST_MPS * table[k, 4] + LEAP * local, MADE_UP * speed * since_s)
        moving, at_gap = speed >= MOVING_MPS, slowest - HARDEST * (table[k, 7] - start)
        stops = table[k, 9] + hidden + off_m < least(at_gap, table[k, 8])
        held = table[k, 6] > 0.0 and since_s >= SHORTEST_S
        kind = SOUND
        if moving and stops and speed * table[k, 8] > LATE * local:
            kind = STALLED
        elif steep or way > min(most, FASTEST_MPS * took) + ROUGH * local:
            own = step - speed * table[k, 4]
            kind = LEAPT if own >= 0.5 * (way - speed * took) else FAST
        elif moving and way + hidden + ROUGH * local < least(slowest, took):
            kind = SLOW
        elif held and step > AT_ONCE * local and step * MADE_UP > speed * since_s:
            kind = SILENT
        kinds[k] = kind
        if kind in (SOUND, SILENT):
            old_m, old_s, old_n = new_m, new_s, new_n
            new_m, new_s, new_n, sound_t = way, took, table[k, 2], table[k, 0]


OFF = 3.0
"""Knots are off by up to so many times what neighbouring ways usually differ by."""
FIRST = 9
"""So many ways tell the speed at the beginning, by their middle one."""
ONE_COUNT = 1.5
"""What lies behind by one usual step trembles; up to so many is one."""


def encoder_damage(channel: Channel) -> Damage:
    """Return which samples of a distance ``channel`` tell no travel.

    Samples behind where the encoder has been, spikes, and a silence that it makes up for
    afterwards, are bridged. Leaps, and counts that are lost or too many, are void, since no line is
    what was travelled, and lasting: engines that are triggered by the encoder integrate over them.
    """
    path = EncoderPath.of(channel)
    kinds = _kinds(path)
    silent = path.between(kinds == SILENT, FRONT, STEP)
    leapt = path.between(kinds == LEAPT, BEFORE_STEP, STEP)
    leapt[:, 1] = path.knots[kinds == LEAPT, STEP] + 1
    fast = path.ways(kinds == FAST)
    stalled = path.between(kinds == STALLED, GAP, AFTER_GAP)
    lost = merged(stalled, path.ways(kinds == SLOW))
    deep = merged(path.behind[path.depths > ONE_COUNT * path.usual_m])
    void = merged(leapt, fast, lost)
    said = (
        (deep, "goes back"),
        (silent, "silent and made up for"),
        (leapt, "leaps"),
        (merged(fast), "counts too much"),
        (lost, "loses counts"),
    )
    lines = tuple(told(channel, spans, what) for spans, what in said if spans.size)
    return Damage(merged(path.behind, silent), void, void, lines)


def _kinds(path: EncoderPath) -> IndexArray:
    """Return what the way to every knot of ``path`` is, as `travelled` says."""
    kinds = np.zeros(len(path.knots), np.int64)
    if kinds.size < 3:
        return kinds
    table = path.table()
    took, ways = np.diff(table[:, :2], axis=0).T
    uneven = np.abs(ways[1:] - ways[:-1] * took[1:] / took[:-1])
    off_m = min(OFF * float(np.median(uneven)), path.usual_m)
    first_s = float(np.sum(took[:FIRST]))
    speed = float(np.median(ways[:FIRST] / took[:FIRST]))
    before = np.array([speed * first_s, first_s, float(np.sum(table[1 : FIRST + 1, 2]))]) / 2
    judge(table, before, off_m, path.usual_m, kinds)
    return kinds


def merged(*spans: IndexArray) -> IndexArray:
    """Return stretches, shape (k, 2), in order; those that overlap or touch become one."""
    joined = np.concatenate([NONE, *spans])
    joined = joined[np.argsort(joined[:, 0], kind="stable")]
    ends = np.maximum.accumulate(joined[:, 1])
    starts = np.append(True, joined[1:, 0] > ends[:-1])[: len(joined)]
    return np.stack([joined[starts, 0], ends[np.append(starts[1:], True)[: len(joined)]]], axis=1)
