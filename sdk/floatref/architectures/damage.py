"""Samples of a sensor that are there and yet measure nothing: stuck, or at the end of its range.

What identical samples mean is judged by the channel itself, so that a coarse or a slow sensor,
which repeats itself anyway, is not suspected.
"""

from dataclasses import dataclass, field

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel
from floatref.values.scanning import chunks

SATURATED = 3
"""So many identical samples at the greatest or least of all are the end of the range."""
OUTERMOST = 0.75 * STANDARD_GRAVITY
"""An accelerometer's range ends this far from rest, in m/s², or farther."""
HELD = 3.0
"""They are more than a hold, which so many times the usual number are."""
STEEP = 3.0
"""A range's end is met, and left, in a step of so many of the channel's smallest; a smooth peak
is not."""
CUT_OFF = 20.0
"""What is cut off is known from the swing around it: the smaller of both steps times the number of
samples is so many times what the steps beside it differ by."""
BESIDE = 250
"""So many samples to either side tell what steps differ by."""
PINNED_S = 0.002
PINNED = 5.0
"""A laser out of its range stays there for so long, and so many times its usual hold."""
LEAP_M = 0.005
"""It gets there, or back, by a step of this height."""
STUCK_S = 0.05
STUCK = 20.0
ALIVE = 0.1
"""A laser is stuck if it repeats itself for so long, so many times its usual hold, while the
accelerometer's readings spread over so many m/s²."""
NONE = np.empty((0, 2), dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Damage:
    """Stretches of a channel to be left out; shape (k, 2): first index and the one behind.

    Attributes:
        gone: not measured, to be bridged.
        lasting: of these or others, what disturbs the samples that follow, however short.
        void: not measured, and no line between the neighbours is what it was.
        warnings: one line for each kind.
    """

    gone: IndexArray = field(default_factory=lambda: NONE)
    lasting: IndexArray = field(default_factory=lambda: NONE)
    void: IndexArray = field(default_factory=lambda: NONE)
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Runs:
    """Runs of identical samples of a channel, and what is usual in it.

    Attributes:
        first, length, value, step: of every run, shape (k,): ``step`` is the larger of those into
            it and out of it.
        usual: length of the runs in which the samples in the middle lie.
        quantum: smallest step between different samples.
        least, greatest: of all samples.
    """

    first: IndexArray
    length: IndexArray
    value: FloatArray
    step: FloatArray
    usual: float
    quantum: float
    least: float
    greatest: float

    @classmethod
    def of(cls, values: FloatArray, shortest: int) -> "Runs":
        """Return the runs of ``shortest`` or more samples in ``values``, shape (N,)."""
        from floatref.kernels import holds

        memory = np.array([0.0, np.nan, 0.0, 0.0, np.inf, np.inf, -np.inf])
        held, found = np.zeros(holds.LONGEST, np.int64), []
        end = np.array([np.nan])
        for first, chunk in (*chunks(values), (values.size, end)):
            runs = np.empty((chunk.size // shortest + 1, 4))
            count = holds.find_runs(chunk, first, shortest, memory, held, runs)
            found.append(runs[:count].copy())
        first, length, value, step = np.concatenate(found).T
        middle = float(np.searchsorted(np.cumsum(held), held.sum() / 2))
        usual = middle if middle < holds.LONGEST - 1 else np.inf
        quantum, least, greatest = memory[4:].tolist()
        whole = first.astype(np.int64), length.astype(np.int64)
        return cls(*whole, value, step, usual, quantum, least, greatest)

    @property
    def extreme(self) -> BoolArray:
        """Which runs lie at the least or the greatest of all samples."""
        extreme: BoolArray = np.isin(self.value, (self.least, self.greatest))
        return extreme

    def spans(self, chosen: BoolArray) -> IndexArray:
        """Return the ``chosen`` ones, shape (k, 2)."""
        first = self.first[chosen]
        return np.stack([first, first + self.length[chosen]], axis=1)


def damaged_force(channel: Channel) -> Damage:
    """Return where an accelerometer is at the end of its range: what it missed is not known."""
    runs = Runs.of(channel.values, SATURATED)
    far = np.abs(runs.value - STANDARD_GRAVITY) >= OUTERMOST
    cut = runs.extreme & far & (runs.length >= HELD * runs.usual)
    cut[cut] = [_goes_on(channel.values, a, b, runs.quantum) for a, b in runs.spans(cut)]
    spans = runs.spans(cut)
    return Damage(spans, spans, warnings=_told(channel, spans, "at the end of its range"))


def _goes_on(values: FloatArray, first: int, behind: int, quantum: float) -> bool:
    """Return whether the swing would go on beyond samples ``first`` to ``behind - 1``."""
    before, after = values[max(first - BESIDE, 0) : first], values[behind : behind + BESIDE]
    steps = np.abs(np.concatenate([before[-1:], after[:1]]) - values[first])
    step = float(np.min(steps[np.isfinite(steps)], initial=np.inf))
    bends = np.abs(np.concatenate([np.diff(before, 2), np.diff(after, 2)]))
    bends = bends[np.isfinite(bends)]
    uneven = max(quantum, float(np.median(bends)) if bends.size else 0.0)
    return bool(step >= STEEP * quantum and step * (behind - first) >= CUT_OFF * uneven)


def damaged_height(channel: Channel, force: Channel) -> Damage:
    """Return where a height sensor repeats itself though ``force``, beside it, does not."""
    rate = channel.mean_rate_hz
    runs = Runs.of(channel.values, max(SATURATED, int(PINNED_S * rate)))
    stuck = runs.length >= max(STUCK_S * rate, STUCK * runs.usual)
    stuck[stuck] = _spreads(force, channel, runs.spans(stuck)) >= ALIVE
    pinned = runs.extreme & (runs.length >= PINNED * runs.usual) & (runs.step >= LEAP_M)
    spans = runs.spans(stuck | pinned)
    return Damage(spans, warnings=_told(channel, spans, "stuck or out of range"))


def _spreads(force: Channel, channel: Channel, spans: IndexArray) -> FloatArray:
    """Return over how much ``force`` spreads within each of ``spans``; NaN where it is missing."""
    spreads = np.full(len(spans), np.nan)
    for k, (first, behind) in enumerate(spans):
        times = channel.clock.times(2, int(first), int(behind - first - 1))
        values = force.values[slice(*_indices(force, times))]
        spreads[k] = np.ptp(values) if values.size else np.nan
    return spreads


def _indices(channel: Channel, times: FloatArray) -> tuple[int, int]:
    """Return the index of the first sample from ``times[0]`` on, and up to ``times[1]``."""
    clock = channel.clock
    if isinstance(clock, StampedClock):
        first, behind = np.searchsorted(clock.times_s, times)
    else:
        first, behind = np.ceil((times - clock.start_s) * float(clock.rate))
    return max(int(first), 0), max(int(behind), 0)


def _told(channel: Channel, spans: IndexArray, what: str) -> tuple[str, ...]:
    if not spans.size:
        return ()
    return (told(channel, spans, what),)


def told(channel: Channel, spans: IndexArray, what: str) -> str:
    """Return one line that says ``what`` is wrong in ``spans`` of ``channel``, and where."""
    lengths = spans[:, 1] - spans[:, 0]
    begin = float(channel.clock.times(1, int(spans[np.argmax(lengths), 0]))[0])
    return (
        f"channel {channel.id}: {what} for {lengths.sum()} samples in {len(spans)} places, most "
        f"in a row {lengths.max()} from {begin:.6g} s; flagged"
    )


def within(spans: IndexArray, low: int, high: int) -> BoolArray | None:
    """Return which of samples ``low`` to ``high - 1`` lie in ``spans``; None if none does.

    ``spans`` are in order and do not overlap.
    """
    begin, end = np.searchsorted(spans[:, 1], low, "right"), np.searchsorted(spans[:, 0], high)
    if begin >= end:
        return None
    edges = np.zeros(high - low + 1, np.int64)
    first, behind = np.clip(spans[begin:end].T - low, 0, high - low)
    np.add.at(edges, first, 1)
    np.subtract.at(edges, behind, 1)
    return np.cumsum(edges[:-1]) > 0
