"""A distance at knots: samples where the encoder is farther than before, with the steps to them."""

from dataclasses import dataclass

import numpy as np

from floatref.screening.damage.damaged_samples import NONE
from floatref.values.arrays import (
    BoolArray,
    FloatArray,
    IndexArray,
    Records,
    new_records,
    read_only,
)
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel
from floatref.values.scanning import CHUNK, chunks, take

KNOT_S = 0.025
"""Shortest time in s between knots, if the counts are that frequent."""
WAY = np.dtype(
    [
        *((name, np.float64) for name in ("t", "far", "steps")),
        *((name, np.float64) for name in ("step", "step_s", "since_s", "held_s")),
        *((name, np.float64) for name in ("gap_t", "gap_s", "gap")),
        ("hidden", np.float64),
    ]
)
"""The way to a knot: the time in s, the distance in m and the number of steps since the last one;
of the largest step its height, its time, the time since the first sample as far, and the time that
the encoder was held; of the longest interval its beginning, its time and its height; and how much
farther the vehicle may be than the counts."""


@dataclass(frozen=True, eq=False)
class EncoderPath:
    """The knots of a distance channel.

    Attributes:
        channel: The distance.
        knots: Samples of every knot, of type `encoder_progress.KNOT`; the last is the end.
        distance: Farthest distance of the encoder up to each, in m.
        behind: Stretches of samples that lie behind, or are spikes, shape (b, 2).
        depths: How far these lie behind, in m.
        usual_m: The usual step in m.
    """

    channel: Channel
    knots: Records
    distance: FloatArray
    behind: IndexArray
    depths: FloatArray
    usual_m: float

    @classmethod
    def of(cls, channel: Channel) -> "EncoderPath":
        """Follow ``channel``; a channel of missing samples has no knots."""
        knots, far, behind, depths = _follow(channel)
        distance = take(channel.values, knots["at"])
        steps = distance[1:-1] - take(channel.values, knots["since"][1:-1])
        distance[-1:] = far
        usual_m = float(np.median(steps)) if steps.size else 0.0
        return cls(channel, knots, distance, behind, depths, usual_m)

    def ways(self) -> Records:
        """Return the way to every knot, shape (k,), of type `WAY`."""
        knots = self.knots
        timed = "at", "step", "before_step", "front", "gap", "after_gap"
        t = {name: times_at(self.channel, knots[name]) for name in timed}
        ways = new_records(len(knots), WAY)
        ways["t"], ways["far"], ways["steps"] = t["at"], self.distance, knots["steps"]
        ways["step"] = self._between("front", "step")
        ways["step_s"] = t["step"] - t["before_step"]
        ways["since_s"] = t["step"] - t["front"]
        ways["held_s"] = t["before_step"] - t["front"]
        ways["gap_t"], ways["gap_s"] = t["gap"], t["after_gap"] - t["gap"]
        ways["gap"] = np.maximum(self._between("gap", "after_gap"), 0.0)
        ways["hidden"][-1:] = self.usual_m
        return ways

    def _between(self, first: str, behind: str) -> FloatArray:
        """Return the distance in m from one field of every knot to another."""
        values = self.channel.values
        return take(values, self.knots[behind]) - take(values, self.knots[first])

    def between(self, chosen: BoolArray, before: str, behind: str) -> IndexArray:
        """Return the samples between two fields of the ``chosen`` knots, shape (k, 2).

        If no sample lies between them, the later field is returned, since the line between two
        counts depends on it.
        """
        first, end = self.knots[before][chosen], self.knots[behind][chosen]
        return np.stack([first + 1, np.maximum(end, first + 2)], axis=1)

    def up_to(self, chosen: BoolArray) -> IndexArray:
        """Return the samples from the knots before the ``chosen`` ones up to them."""
        at = self.knots["at"]
        return np.stack([np.roll(at, 1)[chosen] + 1, at[chosen] + 1], axis=1)


def times_at(channel: Channel, index: IndexArray) -> FloatArray:
    """Return the times in s of samples ``index`` of ``channel``."""
    clock = channel.clock
    if isinstance(clock, StampedClock):
        return take(clock.times_s, index)
    return np.asarray(clock.start_s + index / float(clock.rate))


def _follow(channel: Channel) -> tuple[Records, float, IndexArray, FloatArray]:
    """Return the knots, the farthest distance, the stretches behind, and their depths in m."""
    from floatref.screening.damage import encoder_progress

    clock, values = channel.clock, channel.values
    stamps = clock.times_s if isinstance(clock, StampedClock) else np.empty(0)
    apart = KNOT_S if stamps.size else KNOT_S * channel.mean_rate_hz
    progress = encoder_progress.new_progress()
    knots, spans, depths = [new_records(0, encoder_progress.KNOT)], [NONE], [np.empty(0)]
    for first, chunk in chunks(values, overlap=1):
        count = min(chunk.size, CHUNK)
        # Read-only, whatever they come as: so the kernel is compiled once.
        chunk, times = read_only(chunk), read_only(stamps[first : first + count])
        rows = new_records(count, encoder_progress.KNOT)
        back, deep = np.empty((count, 2), np.int64), np.empty(count)
        found, behind = encoder_progress.follow(
            chunk, count, first, times, apart, progress, rows, back, deep
        )
        knots.append(rows[:found].copy())
        spans.append(back[:behind].copy())
        depths.append(deep[:behind].copy())
    every = np.concatenate(knots)
    if every.size and every["at"][-1] < progress.known:
        every = np.append(every, _end(channel, progress))
    return every, float(progress.far), np.concatenate(spans), np.concatenate(depths)


def _end(channel: Channel, progress: np.record) -> Records:
    """Return the last known sample as a knot; the encoder may have been constant before it."""
    front, last = progress.coming.since, progress.known
    end = np.array([progress.coming])
    end["at"] = last
    if progress.coming.steps == 0:
        end["step"] = end["before_step"] = end["front"] = front
    now, since = times_at(channel, np.array([last, front]))
    rate = 1.0 if isinstance(channel.clock, StampedClock) else channel.mean_rate_hz
    if progress.coming.steps == 0 or (now - since) * rate > progress.longest:
        end["gap"], end["after_gap"] = front, last
    return end
