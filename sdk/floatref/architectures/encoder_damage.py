"""Encoder samples that tell no travel: behind where it has been, leaps, silence, lost counts."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from floatref.architectures.damage import NONE, Damage, Runs, told
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.clock import StampedClock
from floatref.values.encoder import FASTEST_MPS
from floatref.values.recording import Channel
from floatref.values.scanning import chunks

LEAP = 5.0
"""A step beyond so many usual ones, and beyond `FASTEST_MPS`, was not travelled in its time."""
SHORTEST_S = 0.02
"""An encoder that holds so long may be silent."""
LATE = 2.5
"""What comes at once after a silence is what was travelled meanwhile, within this factor."""
LOST_S = 0.05
"""No vehicle stops within this time from `MOVING_MPS`: an encoder that does has lost counts."""
MOVING_MPS = 2.5
COUNTS = 5.0
"""A speed is known from so many usual steps: a coarse encoder holds between its counts."""
STANDING_S = 2.0
"""After such a time without counts the vehicle is taken to stand."""


def encoder_damage(channel: Channel) -> Damage:
    """Return which samples of a distance ``channel`` tell no travel.

    Samples behind where the encoder has been, and a silence that it makes up for afterwards, are
    bridged. A leap and lost counts are void, since no line is what was travelled, and lasting:
    engines that are triggered by the encoder integrate over them.
    """
    found = _Encoder.of(channel)
    leaps = found.leaps()
    silent, unexplained = found.silences(leaps)
    lost = found.lost(leaps)
    behind = _spans(found.behind())
    leapt = np.stack([unexplained, unexplained + 1], axis=1)
    void = _ordered(leapt, lost)
    kinds = (
        (behind, "goes back"),
        (silent, "silent and made up for"),
        (leapt, "leaps"),
        (lost, "loses counts"),
    )
    lines = tuple(told(channel, spans, what) for spans, what in kinds if spans.size)
    return Damage(_ordered(behind, silent), void, void, lines)


@dataclass(frozen=True, eq=False)
class _Encoder:
    """A distance, its stretches without counts, and its usual step in m."""

    channel: Channel
    holds: Runs
    usual_m: float

    @classmethod
    def of(cls, channel: Channel) -> "_Encoder":
        total = squares = 0.0
        for _, steps, _ in _progress(channel.values):
            made = steps[steps > 0]
            total += float(made.sum())
            squares += float((made**2).sum())
        shortest = max(2, int(SHORTEST_S * min(channel.mean_rate_hz, 1e6)))
        holds = Runs.of(channel.values, shortest)
        return cls(channel, holds, squares / total if total > 0 else 0.0)

    def behind(self) -> Iterator[IndexArray]:
        """Yield the samples that lie behind one before them."""
        for first, chunk, reached in _reached(self.channel.values):
            yield first + np.flatnonzero(chunk < reached[1:])

    def leaps(self) -> IndexArray:
        """Return the samples that were reached faster than any vehicle."""
        found = [NONE[:, 0]]
        for first, steps, fronts in _progress(self.channel.values):
            candidates = np.flatnonzero(steps > LEAP * self.usual_m)
            index = first + candidates
            elapsed = self._times(index) - self._times(fronts[candidates])
            far = steps[candidates] > LEAP * self.usual_m + FASTEST_MPS * elapsed
            found.append(index[far])
        return np.concatenate(found)

    def silences(self, leaps: IndexArray) -> tuple[IndexArray, IndexArray]:
        """Return what was silent before leaps that make up for it, and the other leaps."""
        ends = self.holds.first + self.holds.length
        which = np.searchsorted(ends, leaps)
        held = which < ends.size
        held[held] = ends[which[held]] == leaps[held]
        first = self.holds.first[which[held]]
        meanwhile = self._speed_before(first) * (self._times(leaps[held]) - self._times(first))
        made_up = self.channel.values[leaps[held]] - self.channel.values[first]
        fits = (made_up > meanwhile / LATE) & (made_up < meanwhile * LATE)
        silent = np.stack([first[fits] + 1, leaps[held][fits]], axis=1)
        return silent, np.sort(np.concatenate((leaps[~held], leaps[held][~fits])))

    def lost(self, leaps: IndexArray) -> IndexArray:
        """Return where counts are lost: no progress out of full speed, and none made up for."""
        first, ends = self.holds.first, self.holds.first + self.holds.length
        open_ended = ends >= self.channel.values.size
        lasted = self._times(np.minimum(ends, self.channel.values.size - 1)) - self._times(first)
        speed = self._speed_before(first)
        lost = (lasted >= LOST_S) & (lasted < STANDING_S) & ~open_ended & ~np.isin(ends, leaps)
        lost &= (speed >= MOVING_MPS) & (speed * LOST_S >= COUNTS * self.usual_m)
        return np.stack([first[lost] + 1, ends[lost]], axis=1)

    def _speed_before(self, index: IndexArray) -> FloatArray:
        """Return the mean speed over `LOST_S` before each of ``index``; NaN where not known."""
        count = max(1, round(LOST_S * min(self.channel.mean_rate_hz, 1e6)))
        earlier = np.maximum(index - count, 0)
        values = self.channel.values
        elapsed = self._times(index) - self._times(earlier)
        gained = values[index] - values[earlier]
        speed = np.full(index.size, np.nan)
        np.divide(gained, elapsed, out=speed, where=elapsed > 0)
        return speed

    def _times(self, index: IndexArray) -> FloatArray:
        clock = self.channel.clock
        if isinstance(clock, StampedClock):
            return clock.times_s[index]
        return np.asarray(clock.start_s + index / float(clock.rate))


def _reached(values: FloatArray) -> Iterator[tuple[int, FloatArray, FloatArray]]:
    """Yield stretches of a distance with their first index and how far the encoder has been.

    The latter begins one sample earlier, with NaN at the very first.
    """
    before = np.nan
    for first, chunk in chunks(values):
        reached = np.fmax.accumulate(np.append(before, chunk))
        yield first, chunk, reached
        before = float(reached[-1])


def _progress(values: FloatArray) -> Iterator[tuple[int, FloatArray, IndexArray]]:
    """Yield, with the first sample's index, by how much each is farther than all before.

    NaN next to a missing sample, whose neighbours are bridged. The last array holds the index of
    the sample before that was as far as any.
    """
    last, front = np.nan, 0
    for first, chunk, reached in _reached(values):
        steps = np.diff(reached)
        steps[np.isnan(np.append(last, chunk[:-1])) | np.isnan(chunk)] = np.nan
        leading = np.where(chunk >= reached[1:], first + np.arange(chunk.size), 0)
        fronts = np.maximum.accumulate(np.append(front, leading))
        last, front = float(chunk[-1]), int(fronts[-1])
        yield first, steps, fronts[:-1]


def _spans(parts: Iterator[IndexArray]) -> IndexArray:
    """Return indices that follow each other as stretches, shape (k, 2)."""
    index = np.concatenate([NONE[:, 0], *parts])
    if not index.size:
        return NONE
    apart: BoolArray = np.diff(index) > 1
    return np.stack([index[np.append(True, apart)], index[np.append(apart, True)] + 1], axis=1)


def _ordered(*spans: IndexArray) -> IndexArray:
    """Return stretches that do not overlap, in order."""
    joined = np.concatenate(spans)
    return joined[np.argsort(joined[:, 0])]
