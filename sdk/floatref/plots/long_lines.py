"""Lines of any length on axes of matplotlib: reduced to what a picture can show, read in pieces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.plots.figure import BINS, Places
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.clock import Clock, StampedClock
from floatref.values.parts.extremes import Extremes, samples_per_bin

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Even:
    """Point k has the place ``start + step * k``."""

    start: float
    step: float

    def __getitem__(self, index: IndexArray, /) -> FloatArray:
        """Return the places of the points ``index``."""
        return np.asarray(self.start + self.step * index)


@dataclass(frozen=True, eq=False)
class Times:
    """Point k has the time in s, after ``origin_s``, of sample k on ``clock``."""

    clock: Clock
    origin_s: float = 0.0

    def __getitem__(self, index: IndexArray, /) -> FloatArray:
        """Return the times of the samples ``index``."""
        clock = self.clock
        if isinstance(clock, StampedClock):
            return np.asarray(clock.times_s[index] - self.origin_s)
        times = clock.start_s + index * clock.rate.denominator / clock.rate.numerator
        return np.asarray(times - self.origin_s)


@dataclass(frozen=True, eq=False)
class Reduced:
    """What is drawn of a line: its points, or the lowest and the highest value of every bin.

    Attributes:
        x, y: the points of the line, shape (n,).
        places: the middle of every bin, shape (m,).
        missing: whether any sample of a bin has no value, shape (m,).
    """

    x: FloatArray
    y: FloatArray
    places: FloatArray
    missing: BoolArray

    @classmethod
    def of(cls, x: Places, y: FloatArray, used: BoolArray | None = None) -> Reduced:
        """Return ``y``, shape (N,), over ``x``; what is not ``used`` is a gap."""
        found = Extremes.of(y, samples_per_bin(y.size, 2 * BINS), used)
        firsts = np.arange(0, y.size, found.samples)
        lasts = np.minimum(firsts + found.samples, y.size) - 1
        places = (x[firsts] + x[lasts]) / 2.0
        if found.samples == 1:
            return cls(x[firsts], found.low, x[firsts], found.missing)
        both = np.stack([found.low, found.high], axis=1).ravel()
        return cls(np.repeat(places, 2), both, places, found.missing)

    def draw(self, ax: Axes, factor: float = 1.0, **style: Any) -> None:
        """Draw the line on ``ax``, with values multiplied by ``factor``."""
        ax.plot(self.x, factor * self.y, **{"linewidth": 0.9, **style})

    @property
    def span(self) -> tuple[float, float] | None:
        """Lowest and highest value; None without any."""
        known = self.y[np.isfinite(self.y)]
        return (float(known.min()), float(known.max())) if known.size else None
