"""Encoder samples that tell no travel: behind where it has been, leaps, silence, lost counts."""

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
    silent, unexplained = found.silences()
    lost, behind = found.lost(), _spans(found.behind)
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
    """A distance, its stretches without counts, and its usual step in m.

    ``leaps`` are the samples that were reached faster than any vehicle, ``behind`` those that lie
    behind one before them.
    """

    channel: Channel
    holds: Runs
    usual_m: float
    leaps: IndexArray
    behind: IndexArray

    @classmethod
    def of(cls, channel: Channel) -> "_Encoder":
        usual_m, _, _ = _followed(channel.values, np.inf)
        _, steps, behind = _followed(channel.values, LEAP * usual_m)
        index, front = steps.T
        gained = channel.values[index] - channel.values[front]
        elapsed = _times(channel, index) - _times(channel, front)
        leaps = index[gained > LEAP * usual_m + FASTEST_MPS * elapsed]
        shortest = max(2, int(SHORTEST_S * min(channel.mean_rate_hz, 1e6)))
        return cls(channel, Runs.of(channel.values, shortest), usual_m, leaps, behind)

    def silences(self) -> tuple[IndexArray, IndexArray]:
        """Return what was silent before leaps that make up for it, and the other leaps."""
        leaps = self.leaps
        ends = self.holds.first + self.holds.length
        which = np.searchsorted(ends, leaps)
        held = which < ends.size
        held[held] = ends[which[held]] == leaps[held]
        first = self.holds.first[which[held]]
        meanwhile = self._speed_before(first) * (
            _times(self.channel, leaps[held]) - _times(self.channel, first)
        )
        made_up = self.channel.values[leaps[held]] - self.channel.values[first]
        fits = (made_up > meanwhile / LATE) & (made_up < meanwhile * LATE)
        silent = np.stack([first[fits] + 1, leaps[held][fits]], axis=1)
        return silent, np.sort(np.concatenate((leaps[~held], leaps[held][~fits])))

    def lost(self) -> IndexArray:
        """Return where counts are lost: no progress out of full speed, and none made up for."""
        first, ends = self.holds.first, self.holds.first + self.holds.length
        open_ended = ends >= self.channel.values.size
        lasted = _times(self.channel, np.minimum(ends, self.channel.values.size - 1)) - _times(
            self.channel, first
        )
        speed = self._speed_before(first)
        lost = (lasted >= LOST_S) & (lasted < STANDING_S) & ~open_ended & ~np.isin(ends, self.leaps)
        lost &= (speed >= MOVING_MPS) & (speed * LOST_S >= COUNTS * self.usual_m)
        return np.stack([first[lost] + 1, ends[lost]], axis=1)

    def _speed_before(self, index: IndexArray) -> FloatArray:
        """Return the mean speed over `LOST_S` before each of ``index``; NaN where not known."""
        count = max(1, round(LOST_S * min(self.channel.mean_rate_hz, 1e6)))
        earlier = np.maximum(index - count, 0)
        values = self.channel.values
        elapsed = _times(self.channel, index) - _times(self.channel, earlier)
        gained = values[index] - values[earlier]
        speed = np.full(index.size, np.nan)
        np.divide(gained, elapsed, out=speed, where=elapsed > 0)
        return speed


def _times(channel: Channel, index: IndexArray) -> FloatArray:
    clock = channel.clock
    if isinstance(clock, StampedClock):
        return clock.times_s[index]
    return np.asarray(clock.start_s + index / float(clock.rate))


def _followed(values: FloatArray, longer: float) -> tuple[float, IndexArray, IndexArray]:
    """Return the usual step of a distance, its steps above ``longer``, and what lies behind.

    The usual step is the mean over the distance, not over the steps. Of the others, shape (k, 2),
    the index is given, and that of the last sample before that was as far as any.
    """
    from floatref.kernels import progress

    memory = np.zeros(progress.PROGRESS)
    memory[0] = -np.inf
    far, back = [NONE], [NONE[:, 0]]
    for first, chunk in chunks(values):
        steps, behind = np.empty((chunk.size, 2), np.int64), np.empty(chunk.size, np.int64)
        counts = progress.progress(chunk, first, memory, longer, steps, behind)
        far.append(steps[: counts[0]].copy())
        back.append(behind[: counts[1]].copy())
    total, squares = memory[3:].tolist()
    return squares / total if total > 0 else 0.0, np.concatenate(far), np.concatenate(back)


def _spans(index: IndexArray) -> IndexArray:
    """Return indices that follow each other as stretches, shape (k, 2)."""
    if not index.size:
        return NONE
    apart: BoolArray = np.diff(index) > 1
    return np.stack([index[np.append(True, apart)], index[np.append(apart, True)] + 1], axis=1)


def _ordered(*spans: IndexArray) -> IndexArray:
    """Return stretches that do not overlap, in order."""
    joined = np.concatenate(spans)
    return joined[np.argsort(joined[:, 0])]
