"""The line between two clocks, through moments that both have timed."""

from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray

LOCAL = 9
"""Pulses in a row whose median gives the local offset; a pulse far from it is false."""
SIDE = 4
"""Pulses on one side that give the local line, where drift or time itself leaps."""
OUTLIER = 6.0
"""Standard deviations from which on a pulse is far from the line."""
LEAST_OFF_S = 2e-6
"""Distance in s up to which a pulse is never far."""
CURVED_S = 1e-4
"""Residual in s beyond jitter from which on drift is not constant."""
QUIET_S = 5e-5
"""Largest jitter of a knot in s; a knot is the mean of enough pulses for it."""
SURE = 5.0
"""Standard deviations by which a curve must differ from the line: with three, one pair of clocks in
750 that have jitter alone would be bent."""
ROUNDS = 3


class ClockLine(NamedTuple):
    """base − ``base_s`` = (1 + ``drift``)·(own − ``own_s``), its accuracy and accepted pairs.

    Args:
        own_s: a time of the own clock within its pulses, in s.
        base_s: the time of the base clock at that moment, in s.
        drift: of the own clock against the base clock, as a ratio.
        drift_sigma: its standard deviation; NaN for fewer than three pairs.
        residual_s: root mean square of the residuals, in s; NaN for a single pair.
        kept: which pairs it goes through, shape (pairs,).
    """

    own_s: float
    base_s: float
    drift: float
    drift_sigma: float
    residual_s: float
    kept: BoolArray


def clock_line(own_s: FloatArray, base_s: FloatArray) -> ClockLine:
    """Return the line of least squares through the pairs, shape (n,), n > 0, without outliers.

    A pair is an outlier if it is far from its neighbours and from the lines through those before
    and those behind it. Both times increase.
    """
    kept = np.ones(own_s.size, dtype=np.bool_)
    line = _least_squares(own_s, base_s, kept)
    for _ in range(ROUNDS):
        rest = _residual(line, own_s, base_s)
        off = np.abs(rest - _local(own_s, rest, kept))
        far = max(OUTLIER * _spread(off[kept]), LEAST_OFF_S)
        before, kept = kept, (off <= far) | (_from_a_side(own_s, rest, kept) <= far)
        line = _least_squares(own_s, base_s, kept)
        if (kept == before).all():
            break
    return line


def curve(line: ClockLine, own_s: FloatArray, base_s: FloatArray) -> FloatArray | None:
    """Return base times at ``own_s`` on a curve, or None if ``line`` has only jitter left."""
    rest = _residual(line, own_s, base_s)
    if rest.size < LOCAL:
        return None
    jitter, all_of_it = float(np.mean(np.diff(rest) ** 2) / 2), float(np.mean(rest**2))
    # Of n pairs that jitter alone, the two differ by 1/sqrt(n) of it.
    if all_of_it - jitter <= max(CURVED_S**2, SURE * all_of_it / rest.size**0.5):
        return None
    half = min(int(_jitter(own_s, rest) / QUIET_S**2 / 2 + 0.5), rest.size // 6)
    bent = _smooth(own_s, rest, half)
    found = line.base_s + (own_s - line.own_s) * (1 + line.drift) + bent
    return found if (np.diff(found) > 0).all() else None


def lower_line(own_s: FloatArray, base_s: FloatArray) -> tuple[float, float]:
    """Return base time and drift at the mean of ``own_s`` on the line below all pairs.

    No pair lies below it, and of all such lines it is the nearest to the pairs: the side of their
    convex hull under their middle. It needs two pairs or more.
    """
    middle = float(np.mean(own_s))
    hull: list[int] = []
    x, y = (own_s - middle).tolist(), (base_s - own_s).tolist()
    for k in range(len(x)):
        while len(hull) > 1 and _right_turn(x, y, hull[-2], hull[-1], k):
            hull.pop()
        hull.append(k)
    after = next((n for n in range(1, len(hull)) if x[hull[n]] >= 0.0), len(hull) - 1)
    i, j = hull[after - 1], hull[after]
    drift = (y[j] - y[i]) / (x[j] - x[i])
    return middle + y[i] - drift * x[i], drift


def _right_turn(x: list[float], y: list[float], i: int, j: int, k: int) -> bool:
    """Return whether the lower hull does not turn left from i over j to k."""
    return (x[j] - x[i]) * (y[k] - y[i]) <= (y[j] - y[i]) * (x[k] - x[i])


def _least_squares(own_s: FloatArray, base_s: FloatArray, kept: BoolArray) -> ClockLine:
    if not kept.any():
        raise InputError("no two pulses agree on the clocks; check the channels of pulses")
    own, shift = own_s[kept], base_s[kept] - own_s[kept]
    middle, mean = float(own.mean()), float(shift.mean())
    x, y = own - middle, shift - mean
    squares = float(x @ x)
    if squares == 0.0:
        return ClockLine(middle, middle + mean, 0.0, np.nan, np.nan, kept)
    drift = float(x @ y) / squares
    rest = y - drift * x
    sigma = float(np.sqrt(rest @ rest / (own.size - 2) / squares)) if own.size > 2 else np.nan
    return ClockLine(middle, middle + mean, drift, sigma, float(np.sqrt(np.mean(rest**2))), kept)


def _residual(line: ClockLine, own_s: FloatArray, base_s: FloatArray) -> FloatArray:
    shift = base_s - own_s - (line.base_s - line.own_s)
    return np.asarray(shift - line.drift * (own_s - line.own_s))


def _spread(off: FloatArray) -> float:
    """Return the standard deviation estimated from the smaller four fifths of ``off``."""
    some = np.sort(off)[: max(1, off.size * 4 // 5)]
    return max(1.4826 * float(np.median(off)), 1.5 * float(np.sqrt(np.mean(some**2))))


def _local(own_s: FloatArray, rest: FloatArray, kept: BoolArray) -> FloatArray:
    """Return ``rest`` at every pair as estimated from its accepted neighbours.

    The estimate is on the line between the median of those before and the median of those behind: a
    slope does not bias it, and one outlier does not move it.
    """
    at, some = own_s[kept], rest[kept]
    if some.size < LOCAL:
        return np.full(rest.size, np.median(some))
    half = LOCAL // 2
    sides = []
    for series in (at, some):
        wide = np.pad(series, half, mode="reflect", reflect_type="odd")
        windows = np.lib.stride_tricks.sliding_window_view(wide, LOCAL)
        sides += [np.median(windows[:, :half], axis=1), np.median(windows[:, -half:], axis=1)]
    before_s, behind_s, before, behind = sides
    there = before + (at - before_s) / (behind_s - before_s) * (behind - before)
    return np.interp(own_s, at, there)


def _from_a_side(own_s: FloatArray, rest: FloatArray, kept: BoolArray) -> FloatArray:
    """Return how far ``rest`` is from the nearer line of those before it and of those behind it."""
    at, some = own_s[kept], rest[kept]
    found = np.full(rest.size, np.inf)
    if some.size <= SIDE:
        return found
    x, y = (np.lib.stride_tricks.sliding_window_view(series, SIDE) for series in (at, some))
    i, j = np.triu_indices(SIDE, 1)
    slope = np.median((y[:, j] - y[:, i]) / (x[:, j] - x[:, i]), axis=1)
    level = np.median(y - slope[:, None] * x, axis=1)
    for first in (np.searchsorted(at, own_s) - SIDE, np.searchsorted(at, own_s, side="right")):
        there = (first >= 0) & (first < slope.size)
        k = first[there]
        off = np.abs(rest[there] - level[k] - slope[k] * own_s[there])
        found[there] = np.minimum(found[there], off)
    return found


def _jitter(own_s: FloatArray, rest: FloatArray) -> float:
    """Return the variance of ``rest`` beside the line between neighbours; leaps do not count."""
    share = (own_s[1:-1] - own_s[:-2]) / (own_s[2:] - own_s[:-2])
    off = rest[1:-1] - rest[:-2] - share * (rest[2:] - rest[:-2])
    # The median of a squared normal deviate is 0.455.
    return float(np.median(off**2 / (1.0 + share**2 + (1.0 - share) ** 2))) / 0.455


def _smooth(own_s: FloatArray, rest: FloatArray, half: int) -> FloatArray:
    """Return ``rest`` on straight lines through ``half`` neighbours on either side."""
    found = rest.copy()
    for k in range(rest.size) if half else ():
        near = slice(max(k - half, 0), k + half + 1)
        x = own_s[near] - own_s[k]
        found[k] = np.polyfit(x, rest[near], 1)[1]
    return found
