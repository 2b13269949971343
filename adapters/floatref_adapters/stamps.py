"""Time stamps as text: the clock that they were rounded from."""

import numpy as np
from numpy.typing import NDArray

from floatref import StampedClock, UniformClock

MOST_DIGITS = 12
"""Significant digits of a rate or a step that is looked for."""
SHORTEST_S = 1e-8
"""A step below this is no clock's, in s."""
MOST_EXPONENT = 300


def decimals_of(text: str) -> int:
    """Return with how many decimals the number ``text`` is written, its exponent included."""
    mantissa, _, exponent = text.strip().lower().partition("e")
    return len(mantissa.partition(".")[2]) - _whole(exponent)


def _whole(exponent: str) -> int:
    """Return ``exponent``, at most as large as one of float64 counts."""
    return int(min(max(float(exponent or 0), -MOST_EXPONENT), MOST_EXPONENT))


def clock_of(times_s: NDArray[np.float64], decimals: int) -> UniformClock | StampedClock:
    """Return the clock of ``times_s`` in s, which were rounded to ``decimals`` decimals.

    A constant rate within one unit of the last decimal of every stamp is a uniform clock: the
    line through the first and the last stamp of one is never farther off. Of all such rates
    the roundest, in Hz or as a step in s, is taken. Other stamps are kept as they are;
    InputError if they do not increase. Stamps that leave one out, by their longest step, are
    kept too; where the step is nearly the unit of the last decimal, rounding looks the same.
    """
    span = float(times_s[-1] - times_s[0])
    step = span / max(times_s.size - 1, 1)
    if not step > SHORTEST_S or _broken(times_s, step, 10.0**-decimals):
        return StampedClock.of(times_s)
    unit = 10.0**-decimals + 4 * float(np.spacing(np.abs(times_s).max()))
    for digits in range(1, MOST_DIGITS + 1):
        for candidate in (1 / _rounded(1 / step, digits), _rounded(step, digits)):
            if _keeps(times_s, candidate, unit):
                return UniformClock.of(1 / candidate, float(times_s[0]))
    if _keeps(times_s, step, unit):
        return UniformClock.of(1 / step, float(times_s[0]))
    return StampedClock.of(times_s)


def _broken(times_s: NDArray[np.float64], step: float, unit: float) -> bool:
    """Tell whether stamps go back, repeat or leave one out, which rounding cannot explain."""
    steps = np.diff(times_s)
    if (steps < 0).any():
        return True
    # Several samples within one unit of the last decimal have equal stamps; others have not.
    return step >= 0.99 * unit and bool(steps.min() == 0 or steps.max() > 1.75 * step)


def _rounded(value: float, digits: int) -> float:
    return float(f"{value:.{digits - 1}e}")


def _keeps(times_s: NDArray[np.float64], step: float, unit: float) -> bool:
    if abs(times_s[-1] - times_s[0] - step * (times_s.size - 1)) > unit:
        return False
    off = times_s - times_s[0] - step * np.arange(times_s.size)
    return bool(np.abs(off).max() <= unit)
