"""Encoder samples that tell no travel: behind where it has been, leaps, silence, lost counts."""

import numpy as np

from floatref.architectures.damage import NONE, Damage, told
from floatref.architectures.encoder_path import (
    AFTER_GAP,
    BEFORE_STEP,
    FRONT,
    GAP,
    STEP,
    EncoderPath,
)
from floatref.values.arrays import IndexArray
from floatref.values.recording import Channel

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
    from floatref.kernels import travelled

    path = EncoderPath.of(channel)
    kinds = _kinds(path)
    silent = path.between(kinds == travelled.SILENT, FRONT, STEP)
    leapt = path.between(kinds == travelled.LEAPT, BEFORE_STEP, STEP)
    leapt[:, 1] = path.knots[kinds == travelled.LEAPT, STEP] + 1
    fast = path.ways(kinds == travelled.FAST)
    stalled = path.between(kinds == travelled.STALLED, GAP, AFTER_GAP)
    lost = merged(stalled, path.ways(kinds == travelled.SLOW))
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
    from floatref.kernels import travelled

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
    travelled.judge(table, before, off_m, path.usual_m, kinds)
    return kinds


def merged(*spans: IndexArray) -> IndexArray:
    """Return stretches, shape (k, 2), in order; those that overlap or touch become one."""
    joined = np.concatenate([NONE, *spans])
    joined = joined[np.argsort(joined[:, 0], kind="stable")]
    ends = np.maximum.accumulate(joined[:, 1])
    starts = np.append(True, joined[1:, 0] > ends[:-1])[: len(joined)]
    return np.stack([joined[starts, 0], ends[np.append(starts[1:], True)[: len(joined)]]], axis=1)
