"""Time stamps of a stream: which are used, and the uniform clock that they were rounded from."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.clock import HIGHEST_RATE_HZ, LOWEST_RATE_HZ, UniformClock
from floatref.values.native import Ticks
from floatref.values.scanning import chunks, longest_step

MOST_DIGITS = 12
"""Significant digits of a rate or a step that are tried."""
TURNS_BACK = 0.01
"""Largest share of rows whose time lies before that of an earlier row."""
FEW = 3
"""Number of such rows that are always accepted."""
LEAP_S = 3600.0
"""Longest step in s; a longer one means that the clock was set."""


def as_ticks(ticks: NDArray[Any]) -> Ticks:
    """Return ``ticks``, shape (n,), as int64 or float64; ValueError if they are neither."""
    if ticks.ndim != 1:
        raise ValueError(f"ticks of shape {ticks.shape} do not fit; give one for each row")
    if ticks.dtype.kind == "f":
        return ticks.astype(np.float64, copy=False)
    if ticks.dtype.kind not in "iu" or (ticks.dtype.kind == "u" and (ticks >= 1 << 63).any()):
        raise ValueError(f"ticks of type {ticks.dtype} do not fit into int64 or float64")
    return ticks.astype(np.int64, copy=False)


class Advancing:
    """Which rows of a stream come no earlier than all before; the others are dropped and counted.

    Rows of one time are kept: stamps may be coarser than the rate.
    """

    def __init__(self) -> None:
        """Begin before the first row."""
        self.rows = self.back = self.untimed = 0
        self._last: float | int | None = None
        self._turn = ""

    def __call__(self, ticks: Ticks) -> BoolArray:
        """Return which of the next rows, with ``ticks`` of shape (n,), are kept."""
        known = np.isfinite(ticks)
        low = np.iinfo(np.int64).min if ticks.dtype.kind == "i" else -np.inf
        usable = np.where(known, ticks, np.asarray(low, ticks.dtype))
        before = np.maximum.accumulate(np.append(usable.dtype.type(low), usable[:-1]))
        if self._last is not None:
            before = np.maximum(before, usable.dtype.type(self._last))
        back = known & (usable < before)
        self._count(ticks, before, known, back)
        if usable.size:
            self._last = max(before[-1], usable[-1]).item()
        return known & ~back

    def warnings(self) -> Iterator[str]:
        """Yield one line for each kind of dropped row; InputError if too many went back."""
        if self.back > max(FEW, TURNS_BACK * self.rows):
            raise InputError(
                f"time goes back in {self.back} of {self.rows} rows, first {self._turn}; the clock "
                "was set or started again, so split the file there"
            )
        if self.back:
            yield f"time goes back in {self.back} rows, first {self._turn}; they are dropped"
        if self.untimed:
            yield f"{self.untimed} rows have no time; they are dropped"

    def _count(self, ticks: Ticks, before: Ticks, known: BoolArray, back: BoolArray) -> None:
        if back.any() and not self.back:
            at = int(np.argmax(back))
            self._turn = f"at row {self.rows + at}, from {before[at]:.12g} to {ticks[at]:.12g}"
        self.rows += ticks.size
        self.back += int(back.sum())
        self.untimed += int((~known).sum())


def warn_of_leap(times_s: FloatArray) -> str | None:
    """Return a warning if the longest step of ``times_s``, shape (N,), is longer than a pause."""
    if times_s.size < 2:
        return None
    row, step_s = longest_step(times_s)
    if step_s <= LEAP_S:
        return None
    return (
        f"no rows for {step_s:.6g} s after row {row}; "
        "if the clock was set there, or came to another epoch, split the file there"
    )


def uniform_clock(times_s: FloatArray, unit_s: float) -> UniformClock | None:
    """Return the uniform clock of ``times_s`` in s, shape (n,), which are rounded to ``unit_s``.

    The stamps do not decrease. None if there is no such clock.

    A constant rate within one unit of every stamp is a uniform clock: the line through the first
    and the last stamp of such a clock is never farther off. Of all such rates the roundest, in Hz
    or as a step in s, is taken. The result is None for stamps with a missing one, by their longest
    step; where the step is nearly the unit, rounding looks the same.
    """
    step = float(times_s[-1] - times_s[0]) / max(times_s.size - 1, 1)
    # float64 rounds each stamp, and a sum of steps once more.
    unit = unit_s + 4 * float(np.spacing(max(abs(times_s[0]), abs(times_s[-1]))))
    if step <= 0 or not LOWEST_RATE_HZ <= 1 / step <= HIGHEST_RATE_HZ:
        return None
    if _broken(times_s, step, unit):
        return None
    for candidate in _candidates(step):
        if _keeps(times_s, candidate, unit):
            return UniformClock.of(1 / candidate, float(times_s[0]))
    return None


def _candidates(step: float) -> Iterator[float]:
    for digits in range(1, MOST_DIGITS + 1):
        yield 1 / float(f"{1 / step:.{digits - 1}e}")
        yield float(f"{step:.{digits - 1}e}")
    yield step


def _broken(times_s: FloatArray, step: float, unit: float) -> bool:
    """Tell whether stamps repeat or miss one in a way that rounding cannot explain."""
    # Only samples within one unit of the last decimal have equal stamps.
    if step < 0.99 * unit:
        return False
    for _, part in chunks(times_s, overlap=1):
        steps = np.diff(part)
        if steps.size and (steps.min() == 0 or steps.max() > 1.75 * step):
            return True
    return False


def _keeps(times_s: FloatArray, step: float, unit: float) -> bool:
    if abs(times_s[-1] - times_s[0] - step * (times_s.size - 1)) > unit:
        return False
    for first, part in chunks(times_s):
        off = part - times_s[0] - step * np.arange(first, first + part.size)
        if np.abs(off).max() > unit:
            return False
    return True
