"""A distance at knots: samples where the encoder is farther than before, with the steps to them."""

from dataclasses import dataclass

import numpy as np

from floatref.screening.damage.damaged_samples import NONE
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel
from floatref.values.scanning import CHUNK, chunks

KNOT_S = 0.025
"""Shortest time in s between knots, if the counts are that frequent."""
KNOT, STEPS, STEP, BEFORE_STEP, FRONT, GAP, AFTER_GAP, FROM, LAST = range(9)
"""Columns of the knots: their sample and the number of steps to it; of the largest of these the
sample, the last known one before it and the first as far as that; the samples that the longest
interval lies between; the sample before the knot's own step; the last known one."""


@dataclass(frozen=True, eq=False)
class EncoderPath:
    """The knots of a distance channel.

    Attributes:
        channel: The distance.
        knots: Samples of every knot, shape (k, 8), columns as above; the last is the end.
        distance: Farthest distance of the encoder up to each, in m.
        behind: Stretches of samples that lie behind, or are spikes, shape (b, 2).
        depths: How far these lie behind, in m.
        usual_m: The usual step in m.
    """

    channel: Channel
    knots: IndexArray
    distance: FloatArray
    behind: IndexArray
    depths: FloatArray
    usual_m: float

    @classmethod
    def of(cls, channel: Channel) -> "EncoderPath":
        """Follow ``channel``; a channel of missing samples has no knots."""
        knots, far, behind, depths = _follow(channel)
        distance = channel.values[knots[:, KNOT]]
        steps = distance[1:-1] - channel.values[knots[1:-1, FROM]]
        distance[-1:] = far
        usual_m = float(np.median(steps)) if steps.size else 0.0
        return cls(channel, knots, distance, behind, depths, usual_m)

    def table(self) -> FloatArray:
        """Return the table for `judge`, shape (k, 11)."""
        values, knots = self.channel.values, self.knots
        t = times_at(self.channel, knots[:, : AFTER_GAP + 1])
        step = values[knots[:, STEP]] - values[knots[:, FRONT]]
        gap = np.maximum(values[knots[:, AFTER_GAP]] - values[knots[:, GAP]], 0.0)
        hidden = np.zeros(len(knots))
        hidden[-1:] = self.usual_m
        columns = (
            t[:, KNOT],
            self.distance,
            knots[:, STEPS],
            step,
            t[:, STEP] - t[:, BEFORE_STEP],
            t[:, STEP] - t[:, FRONT],
            t[:, BEFORE_STEP] - t[:, FRONT],
            t[:, GAP],
            t[:, AFTER_GAP] - t[:, GAP],
            gap,
            hidden,
        )
        return np.stack([np.asarray(c, np.float64) for c in columns], axis=1)

    def between(self, chosen: BoolArray, before: int, behind: int) -> IndexArray:
        """Return the samples between two columns of the ``chosen`` knots, shape (k, 2).

        If no sample lies between them, the later column is returned, since the line between two
        counts depends on it.
        """
        first, end = self.knots[chosen][:, [before, behind]].T
        return np.stack([first + 1, np.maximum(end, first + 2)], axis=1)

    def ways(self, chosen: BoolArray) -> IndexArray:
        """Return the samples from the knots before the ``chosen`` ones up to them."""
        first, end = np.roll(self.knots[:, KNOT], 1)[chosen], self.knots[chosen, KNOT]
        return np.stack([first + 1, end + 1], axis=1)


def times_at(channel: Channel, index: IndexArray) -> FloatArray:
    """Return the times in s of samples ``index`` of ``channel``."""
    clock = channel.clock
    if isinstance(clock, StampedClock):
        return clock.times_s[index]
    return np.asarray(clock.start_s + index / float(clock.rate))


def _follow(channel: Channel) -> tuple[IndexArray, float, IndexArray, FloatArray]:
    """Return the knots, the distance at each, the stretches behind, and how far behind they are."""
    from floatref.screening.damage import encoder_progress

    clock, values = channel.clock, channel.values
    stamps = clock.times_s if isinstance(clock, StampedClock) else np.empty(0)
    apart = KNOT_S if stamps.size else KNOT_S * channel.mean_rate_hz
    levels, knot = (
        np.zeros(encoder_progress.USUAL + 1),
        np.zeros(encoder_progress.KNOWN + 1, np.int64),
    )
    levels[
        [
            encoder_progress.FAR,
            encoder_progress.BEFORE,
            encoder_progress.KNOT_T,
            encoder_progress.KNOT_X,
        ]
    ] = -np.inf
    levels[encoder_progress.USUAL] = np.inf
    knots, spans, depths = [np.empty((0, encoder_progress.KNOT), np.int64)], [NONE], [np.empty(0)]
    for first, chunk in chunks(values, overlap=1):
        count = min(chunk.size, CHUNK)
        times = stamps[first : first + count]
        rows = np.empty((count, encoder_progress.KNOT), np.int64)
        back, deep = np.empty((count, 2), np.int64), np.empty(count)
        found, behind = encoder_progress.follow(
            chunk, count, first, times, apart, levels, knot, rows, back, deep
        )
        knots.append(rows[:found].copy())
        spans.append(back[:behind].copy())
        depths.append(deep[:behind].copy())
    joined = np.concatenate(knots)
    if joined.size and joined[-1, KNOT] < knot[LAST]:
        joined = np.append(joined, _end(channel, knot, levels), axis=0)
    return (
        joined,
        float(levels[encoder_progress.FAR]),
        np.concatenate(spans),
        np.concatenate(depths),
    )


def _end(channel: Channel, knot: IndexArray, levels: FloatArray) -> IndexArray:
    """Return the last known sample as a knot; the encoder may have been constant before it."""
    from floatref.screening.damage import encoder_progress

    front, last = knot[FROM], knot[LAST]
    end = knot[None, : FROM + 1].copy()
    end[0, KNOT] = last
    if knot[STEPS] == 0:
        end[0, [STEP, BEFORE_STEP, FRONT]] = front
    now, since = times_at(channel, np.array([last, front]))
    rate = 1.0 if isinstance(channel.clock, StampedClock) else channel.mean_rate_hz
    if knot[STEPS] == 0 or (now - since) * rate > levels[encoder_progress.LONGEST]:
        end[0, [GAP, AFTER_GAP]] = front, last
    return end
