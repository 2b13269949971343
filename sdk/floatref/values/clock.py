"""Clocks: when each sample of a channel was taken.

Time is an integer sample index with a rational rate, so it never accumulates float error.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, frozen


def rational(rate: float | Fraction) -> Fraction:
    """Return ``rate`` as the simplest fraction that rounds to the same float64."""
    if isinstance(rate, Fraction):
        return rate
    simple = Fraction(rate).limit_denominator(1_000_000)
    return simple if float(simple) == rate else Fraction(rate)


@dataclass(frozen=True)
class UniformClock:
    """Sample k was taken at ``start_s + k / rate`` seconds; ``rate`` in Hz."""

    rate: Fraction
    start_s: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a rate or start that is not a positive, finite number."""
        if self.rate <= 0:
            raise InputError(f"rate_hz is {float(self.rate):g}; it must be above zero")
        if not np.isfinite(self.start_s):
            raise InputError(f"start_s is {self.start_s}; it must be finite")

    @classmethod
    def of(cls, rate_hz: float, start_s: float = 0.0) -> "UniformClock":
        """Return the clock of ``rate_hz`` in Hz, starting at ``start_s`` seconds."""
        if not np.isfinite(rate_hz):
            raise InputError(f"rate_hz is {rate_hz}; it must be a finite number above zero")
        return cls(rational(rate_hz), float(start_s))

    def times(self, count: int, first: int = 0) -> FloatArray:
        """Return the times in s of samples ``first`` to ``first + count - 1``."""
        index = np.arange(first, first + count, dtype=np.float64)
        return self.start_s + index * self.rate.denominator / self.rate.numerator


@dataclass(frozen=True, eq=False)
class StampedClock:
    """Every sample has its own time in s, strictly increasing."""

    times_s: FloatArray

    @classmethod
    def of(cls, times_s: ArrayLike) -> "StampedClock":
        """Return the clock of ``times_s``; InputError unless finite and increasing."""
        return cls(frozen(times_s))

    def __post_init__(self) -> None:
        """Refuse times that are missing or do not increase."""
        if not np.isfinite(self.times_s).all():
            bad = int(np.flatnonzero(~np.isfinite(self.times_s))[0])
            raise InputError(f"time stamp {bad} is {self.times_s[bad]}; every sample needs a time")
        steps = np.diff(self.times_s)
        if (steps <= 0).any():
            bad = int(np.flatnonzero(steps <= 0)[0]) + 1
            raise InputError(
                f"time stamp {bad} is {self.times_s[bad]:.9g} s, not after "
                f"{self.times_s[bad - 1]:.9g} s; "
                "times must increase, so sort the samples or drop the repeated ones"
            )

    def times(self, count: int, first: int = 0) -> FloatArray:
        """Return the times in s of samples ``first`` to ``first + count - 1``."""
        return self.times_s[first : first + count]


Clock = UniformClock | StampedClock
