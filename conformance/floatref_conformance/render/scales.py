"""From numbers to places in a picture: scales, round ticks, and as few points as needed."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor, log10

import numpy as np
from numpy.typing import NDArray

from floatref.values.arrays import FloatArray

MARGIN = 0.06
"""Share of the range that is empty above and below the lines."""
FARTHEST = 1e300
"""Values beyond this are drawn at it, so that differences stay finite."""
NARROWEST = 1e-9
"""Smallest range that is shown, as a share of the largest value."""
NEGLIGIBLE = 1e-200
"""A range below this is that of a line at 0."""


@dataclass(frozen=True)
class Scale:
    """The straight map of ``low`` to the coordinate ``first`` and of ``high`` to ``last``."""

    low: float
    high: float
    first: float
    last: float

    def __call__(self, value: float) -> float:
        """Return the coordinate of ``value``."""
        share = (value - self.low) / (self.high - self.low)
        return float(self.first + share * (self.last - self.first))


def scale_of(
    values: Sequence[FloatArray], first: float, last: float, from_zero: bool = False
) -> Scale:
    """Return a scale that shows all finite ``values`` with a margin; 0 to 1 without any."""
    finite = [v[np.isfinite(v)] for v in values]
    present = np.concatenate([*finite, np.empty(0)])
    if not present.size:
        return Scale(0.0, 1.0, first, last)
    low, high = np.clip([present.min(), present.max()], -FARTHEST, FARTHEST).tolist()
    low = min(low, 0.0) if from_zero else low
    largest = max(abs(low), abs(high))
    spread = max(high - low, NARROWEST * largest)
    spread = spread if spread > NEGLIGIBLE else 1.0
    bottom = 0.0 if from_zero and low == 0 else low - MARGIN * spread
    return Scale(bottom, high + MARGIN * spread, first, last)


def ticks(low: float, high: float, most: int) -> list[float]:
    """Return round values from ``low`` to ``high``, ``most`` intervals apart at most.

    They are multiples of 1, 2 or 5 times a power of ten.
    """
    if not high > low:
        return [low]
    power = 10.0 ** floor(log10((high - low) / most))
    step = next(s * power for s in (1, 2, 5, 10) if (high - low) / (s * power) <= most)
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    # Numbers that differ by their last digits alone are rounded to more steps than lie between.
    return [k * step for k in range(first, min(last, first + most) + 1)]


def label(value: float) -> str:
    """Return a tick's number with a proper minus sign."""
    text = f"{value:.6g}"
    return "0" if float(text) == 0 else text.replace("-", "−")


def decimate(values: FloatArray, most: int) -> list[NDArray[np.int64]]:
    """Return indices that keep the envelope of ``values``, one array for each stroke of the pen.

    Of every stretch of equally many points the lowest and the highest are kept, ``most`` points
    in all; a value that is not finite between two of them lifts the pen.
    """
    finite = np.flatnonzero(np.isfinite(values))
    if not finite.size:
        return []
    if finite.size > most:
        size = ceil(values.size / (most // 2))
        bins = finite // size
        edges = np.concatenate([[0], np.flatnonzero(np.diff(bins)) + 1, [finite.size]])
        kept: set[int] = set()
        for start, end in pairwise(edges.tolist()):
            part = finite[start:end]
            kept |= {int(part[np.argmin(values[part])]), int(part[np.argmax(values[part])])}
        finite = np.array(sorted(kept), dtype=np.int64)
    missing = np.cumsum(~np.isfinite(values))
    lifted = np.flatnonzero(np.diff(missing[finite])) + 1
    return np.split(finite.astype(np.int64), lifted)
