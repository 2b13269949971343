"""Samples of an accelerometer at the end of its range: what it missed there is not known."""

import numpy as np

from floatref.screening.damage.damaged_samples import Damage, Runs, Usual, extremes, told
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Channel

SHORTEST = 3
"""So many identical samples at the least or greatest of all are the end of the range."""
OUTERMOST = 0.75 * STANDARD_GRAVITY
"""A range ends this far from rest, in m/s², or farther."""
HELD = 3.0
"""They are more than a hold, which so many times the usual number are."""
STAIR = 1.5
"""A hold ends by more than so many smallest steps, else it is that of a coarse sensor."""
AROUND = 5.0
FARTHEST = 1000
"""How the swing goes on is looked at over as many samples as are identical: at least so many of
the usual holds, at most so many samples."""
STEEP = 2.0
"""It falls so many times farther than a smooth peak that is flat by rounding alone."""
LONG = 6.0
NOISY = 8.0
"""It lasts so many holds, or falls by so many times the usual swing beside it: noise alone makes
identical samples on a peak now and then, but neither."""
BESIDE = 250
"""So many holds to either side tell the usual swing."""


def damaged_force(channel: Channel) -> Damage:
    """Return where an accelerometer is at the end of its range."""
    least, greatest = extremes(channel.values)
    low = least if least <= STANDARD_GRAVITY - OUTERMOST else -np.inf
    high = greatest if greatest >= STANDARD_GRAVITY + OUTERMOST else np.inf
    if low == -high:
        return Damage()
    spans = _cut_off(channel.values, Runs.of(channel.values, SHORTEST, (low, high)).spans)
    if not spans.size:
        return Damage()
    return Damage(spans, spans, warnings=(told(channel, spans, "at the end of its range"),))


def _cut_off(values: FloatArray, spans: IndexArray) -> IndexArray:
    """Return those of ``spans``, of identical samples, that cut a swing off."""
    if not spans.size:
        return spans
    usual = Usual.of(values)
    quantum = usual.quantum
    hold = min(usual.hold, Usual.of(values, STAIR * quantum).hold)
    spans = spans[spans[:, 1] - spans[:, 0] >= HELD * hold]
    kept: list[bool] = [_goes_on(values, a, b, int(hold), quantum) for a, b in spans]
    return np.asarray(spans[np.array(kept, dtype=np.bool_)])


def _goes_on(values: FloatArray, first: int, behind: int, hold: int, quantum: float) -> bool:
    """Return whether the swing would go on beyond samples ``first`` to ``behind - 1``."""
    length = behind - first
    reach = int(max(min(length, FARTHEST), AROUND * hold))
    drops = []
    for beside in (values[max(first - reach, 0) : first], values[behind : behind + reach]):
        drop = float(np.fmax.reduce(np.abs(beside - values[first]), initial=-np.inf))
        if drop < 0.0:
            continue
        # A parabola that stays within one quantum over the run has fallen so far beside it.
        rounded = quantum * (1.0 + 2.0 * beside.size / (length - hold)) ** 2
        if drop < STEEP * rounded:
            return False
        drops.append(drop)
    if length >= LONG * hold or not drops:
        return True
    return min(drops) >= NOISY * _swing(values, first, behind, hold, reach)


def _swing(values: FloatArray, first: int, behind: int, hold: int, reach: int) -> float:
    """Return by how much the samples beside usually leave the line of those ``reach`` off."""
    far = BESIDE * hold + 2 * reach
    around = (values[max(first - far, 0) : first], values[behind : behind + far])
    bends = [np.abs(v[: -2 * reach] - 2 * v[reach:-reach] + v[2 * reach :]) for v in around]
    known = np.concatenate(bends)
    known = known[np.isfinite(known)]
    return float(np.median(known)) if known.size else 0.0
