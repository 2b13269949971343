"""4.4 Signal Flow: the internal clock of each sensor and the common clock.

The section has no equations; a common pulse "provides a way to reconcile the internal clocks from
each line laser with the common clock". What is computed here is the simplest that does so: the
shift at which most pulses meet, then the straight line through those that do.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.signals import ZERO, Real, Samples, Signal, samples, signal


class Line(NamedTuple):
    """t_base = offset + (1 + drift) t_own.

    Args:
        offset: s.
        drift: ratio.
        sigma: standard deviation of the drift.
        residual: root mean square of what is left, s.
    """

    offset: np.longdouble
    drift: np.longdouble
    sigma: np.longdouble
    residual: np.longdouble


def common_clock(t_own: npt.ArrayLike, offset: Real, drift: Real) -> Signal:
    """Convert times of an internal clock to the common clock.

    Equation:
        Section 4.4: t_base = offset + (1 + drift) t_own.

    Args:
        t_own: s, shape (N,).
        offset: s.
        drift: ratio.

    Returns:
        t_base, s, shape (N,).
    """
    return signal([offset + (1 + np.longdouble(drift)) * t for t in samples(t_own)])


def shift_of_most(
    t_own: npt.ArrayLike, t_base: npt.ArrayLike, tolerance: Real, near: Real = 0.0
) -> np.longdouble:
    """Find the shift at which most pulses of one train lie on pulses of the other.

    Equation:
        Section 4.4, "a common pulse": of all t_base,j − t_own,i the one with most pulses k for
        which some |t_own,k + shift − t_base,l| ≤ tolerance; of equals the nearest to ``near``.

    Args:
        t_own: pulses by the internal clock, s, shape (N,).
        t_base: pulses by the common clock, s, shape (M,).
        tolerance: s; the drift over the whole train and the jitter have to lie within it.
        near: s.

    Returns:
        The shift, s.
    """
    own, base = samples(t_own), samples(t_base)
    best, most = ZERO, -1
    for t_i in own:
        for t_j in base:
            shift = t_j - t_i
            count = 0
            for t_k in own:
                if min(abs(t_k + shift - t_l) for t_l in base) <= tolerance:
                    count += 1
            if count > most or (count == most and abs(shift - near) < abs(best - near)):
                best, most = shift, count
    return best


def pairs(
    t_own: npt.ArrayLike, t_base: npt.ArrayLike, offset: Real, drift: Real, tolerance: Real
) -> tuple[Signal, Signal]:
    """List the pulses that both clocks saw, given roughly how they go together.

    Equation:
        Section 4.4: each t_own,i with the t_base,j nearest to offset + (1 + drift) t_own,i, if
        that is within the tolerance.

    Args:
        t_own: s, shape (N,).
        t_base: s, shape (M,).
        offset: s.
        drift: ratio.
        tolerance: s, less than half the shortest interval.

    Returns:
        Times by the internal and by the common clock, s, each of shape (pairs,).
    """
    own, base = samples(t_own), samples(t_base)
    by_own, by_base = [], []
    for t_i, expected in zip(own, common_clock(t_own, offset, drift), strict=True):
        nearest = base[0]
        for t_j in base:
            if abs(t_j - expected) < abs(nearest - expected):
                nearest = t_j
        if abs(nearest - expected) <= tolerance:
            by_own.append(t_i)
            by_base.append(nearest)
    return signal(by_own), signal(by_base)


def line(t_own: npt.ArrayLike, t_base: npt.ArrayLike) -> Line:
    """Fit a straight line by least squares.

    Equation:
        Section 4.4, to reconcile two clocks: the normal equations of
        t_base − t_own = offset + drift t_own, with sigma² = Σ r² / (N − 2) / Σ (t_own − mean)².

    Args:
        t_own: s, shape (N,), N > 2.
        t_base: the same pulses, s, shape (N,).

    Returns:
        The line.
    """
    x = samples(t_own)
    y = [b - a for a, b in zip(x, samples(t_base), strict=True)]
    n = len(x)
    mean_x, mean_y = _sum(x) / n, _sum(y) / n
    s_xx = _sum([(a - mean_x) ** 2 for a in x])
    drift = _sum([(a - mean_x) * (b - mean_y) for a, b in zip(x, y, strict=True)]) / s_xx
    offset = mean_y - drift * mean_x
    squares = _sum([(b - offset - drift * a) ** 2 for a, b in zip(x, y, strict=True)])
    sigma = np.sqrt(squares / (n - 2) / s_xx)
    return Line(offset, drift, sigma, np.sqrt(squares / n))


def earliest_line(t_gnss: npt.ArrayLike, t_base: npt.ArrayLike) -> Line:
    """Fit the line above or on which all readings of a reference time lie.

    Equation:
        Section 4.4, "records a reference time": a reading may be recorded late but never early.
        So of all lines through two readings, with no reading below the line, it is the one with the
        least sum of the distances of the readings above it.

    Args:
        t_gnss: reference time that was read, s, shape (N,), N > 1.
        t_base: when it was, by the common clock, s, shape (N,).

    Returns:
        The line of t_base over t_gnss; sigma is 0.
    """
    x = samples(t_gnss)
    y = [b - a for a, b in zip(x, samples(t_base), strict=True)]
    best, least = None, np.longdouble(np.inf)
    for i in range(len(x)):
        for j in range(i):
            drift = (y[i] - y[j]) / (x[i] - x[j])
            offset = y[i] - drift * x[i]
            above = [b - offset - drift * a for a, b in zip(x, y, strict=True)]
            tiny = 1e-15 * max(abs(b) for b in y)
            if min(above) >= -tiny and _sum(above) < least:
                least = _sum(above)
                rms = np.sqrt(_sum([r**2 for r in above]) / len(x))
                best = Line(offset, drift, ZERO, rms)
    if best is None:
        raise ValueError("two readings at least, at different times")
    return best


def _sum(values: Samples) -> np.longdouble:
    total = ZERO
    for value in values:
        total += value
    return total
