"""Samples of an accelerometer at the end of its range: the true value there is unknown."""

import numpy as np

from floatref.screening.damage.damaged_samples import Damage, Runs, Usual, describe_damage
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Channel

SHORTEST = 3
"""Fewest identical samples at the smallest or largest value that are the end of the range."""
OUTERMOST = 0.75 * STANDARD_GRAVITY
"""Smallest distance of the end of a range from rest, in m/s²."""
HELD = 3.0
"""A run of identical samples is longer than a hold beyond this number of usual lengths."""
STAIR = 1.5
"""A hold ends with a step above this number of smallest steps; else the sensor is coarse."""
AROUND = 5.0
FARTHEST = 1000
"""The swing beside the run is examined over as many samples as the run has: at least the first
number of usual holds, at most the second number of samples."""
STEEP = 2.0
"""The swing falls this number of times farther than a smooth peak that is flat by rounding."""
LONG = 6.0
NOISY = 8.0
"""The run lasts the first number of holds, or the swing falls by the second number of usual swings
beside it: noise alone sometimes makes identical samples on a peak, but neither of these."""
BESIDE = 250
"""Number of holds on either side that give the usual swing."""


def find_saturation(channel: Channel) -> Damage:
    """Return the stretches in which an accelerometer is at the end of its range."""
    least, greatest = channel.scan.extremes
    low = least if least <= STANDARD_GRAVITY - OUTERMOST else -np.inf
    high = greatest if greatest >= STANDARD_GRAVITY + OUTERMOST else np.inf
    if low == -high:
        return Damage()
    spans = _find_cut_off(channel.values, Runs.of(channel.values, SHORTEST, (low, high)).spans)
    if not spans.size:
        return Damage()
    return Damage(
        spans, spans, warnings=(describe_damage(channel, spans, "at the end of its range"),)
    )


def _find_cut_off(values: FloatArray, spans: IndexArray) -> IndexArray:
    """Return those of ``spans``, of identical samples, that cut off a swing."""
    if not spans.size:
        return spans
    usual = Usual.of(values)
    quantum = usual.quantum
    hold = min(usual.hold, Usual.of(values, STAIR * quantum).hold)
    spans = spans[spans[:, 1] - spans[:, 0] >= HELD * hold]
    kept: list[bool] = [_goes_on(values, a, b, int(hold), quantum) for a, b in spans]
    return np.asarray(spans[np.array(kept, dtype=np.bool_)])


def _goes_on(values: FloatArray, first: int, behind: int, hold: int, quantum: float) -> bool:
    """Return whether the swing would continue beyond samples ``first`` to ``behind - 1``."""
    length = behind - first
    reach = int(max(min(length, FARTHEST), AROUND * hold))
    drops = []
    for beside in (values[max(first - reach, 0) : first], values[behind : behind + reach]):
        drop = float(np.fmax.reduce(np.abs(beside - values[first]), initial=-np.inf))
        if drop < 0.0:
            continue
        # A parabola within one quantum over the run has fallen by this amount beside it.
        rounded = quantum * (1.0 + 2.0 * beside.size / (length - hold)) ** 2
        if drop < STEEP * rounded:
            return False
        drops.append(drop)
    if length >= LONG * hold or not drops:
        return True
    return min(drops) >= NOISY * _swing(values, first, behind, hold, reach)


def _swing(values: FloatArray, first: int, behind: int, hold: int, reach: int) -> float:
    """Return the usual deviation of the samples from the line between those ``reach`` away."""
    far = BESIDE * hold + 2 * reach
    around = (values[max(first - far, 0) : first], values[behind : behind + far])
    bends = [np.abs(v[: -2 * reach] - 2 * v[reach:-reach] + v[2 * reach :]) for v in around]
    known = np.concatenate(bends)
    known = known[np.isfinite(known)]
    return float(np.median(known)) if known.size else 0.0
