"""Clocks: when each sample of a channel was taken.

Time is an integer sample index with a rational rate, so it never accumulates float error.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, frozen
from floatref.values.scanning import first_step_where, first_where

LOWEST_RATE_HZ = Fraction(1, 1000)
HIGHEST_RATE_HZ = Fraction(10_000_000)
LATEST_S = 1e12
"""Largest distance of a time from zero, in s: 32000 years, enough for every epoch."""

_ADVICE = f"give times in s, within {LATEST_S:g} s of zero"


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
        """Refuse a rate that no sensor has and a start that no epoch explains."""
        if not LOWEST_RATE_HZ <= self.rate <= HIGHEST_RATE_HZ:
            raise InputError(
                f"rate_hz is {float(self.rate):g}; "
                "give the sampling rate in Hz, between 0.001 and 10000000"
            )
        if not np.isfinite(self.start_s):
            raise InputError(f"start_s is {self.start_s}; it must be finite")
        if abs(self.start_s) > LATEST_S:
            raise InputError(f"start_s is {self.start_s:g}; {_ADVICE}")

    @classmethod
    def of(cls, rate_hz: float, start_s: float = 0.0) -> "UniformClock":
        """Return the clock of ``rate_hz`` in Hz, starting at ``start_s`` seconds."""
        if not np.isfinite(rate_hz):
            raise InputError(f"rate_hz is {rate_hz}; it must be a finite number above zero")
        return cls(rational(rate_hz), float(start_s))

    def times(self, count: int, first: int = 0, step: int = 1) -> FloatArray:
        """Return the times in s of ``count`` samples, every ``step``-th from ``first`` on."""
        # In place, and nothing for a 1 or a 0: channels of millions of samples ask for their times.
        times = np.arange(count, dtype=np.float64)
        if step != 1:
            times *= step
        if first != 0:
            times += first
        if self.rate.denominator != 1:
            times *= self.rate.denominator
        times /= self.rate.numerator
        if self.start_s != 0.0:
            times += self.start_s
        return times


@dataclass(frozen=True, eq=False)
class StampedClock:
    """Every sample has its own time in s, strictly increasing."""

    times_s: FloatArray

    @classmethod
    def of(cls, times_s: ArrayLike) -> "StampedClock":
        """Return the clock of ``times_s``; InputError unless finite and increasing."""
        return cls(frozen(times_s))

    def __post_init__(self) -> None:
        """Refuse times that are missing, that no epoch explains, or that do not increase."""
        bad = first_where(lambda times: ~np.isfinite(times), self.times_s)
        if bad is not None:
            raise InputError(f"time stamp {bad} is {self.times_s[bad]}; every sample needs a time")
        bad = first_where(lambda times: np.abs(times) > LATEST_S, self.times_s)
        if bad is not None:
            raise InputError(f"time stamp {bad} is {self.times_s[bad]:g} s; {_ADVICE}")
        bad = first_step_where(lambda steps: steps <= 0, self.times_s)
        if bad is not None:
            raise InputError(
                f"time stamp {bad} is {self.times_s[bad]:.9g} s, not after "
                f"{self.times_s[bad - 1]:.9g} s; "
                "times must increase, so sort the samples or drop the repeated ones"
            )

    def times(self, count: int, first: int = 0, step: int = 1) -> FloatArray:
        """Return the times in s of ``count`` samples, every ``step``-th from ``first`` on."""
        return self.times_s[first::step][:count]


Clock = UniformClock | StampedClock
