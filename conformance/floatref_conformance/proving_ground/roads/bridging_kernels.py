"""Compiled kernels: the mean of a line across strings without its lowest and highest share."""

from typing import NamedTuple

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray

MOST_STEPS = 60
"""Steps of the search for a quantile: halves alone bring a relief of 1 m to rounding."""
CLOSE = 1e-7
"""Share of the line by which a quantile may be missed; the height counts it by its square."""


class Pieces(NamedTuple):
    """The line between strings: ends and share of every piece, each of shape (pieces,)."""

    low: FloatArray
    high: FloatArray
    share: FloatArray


@compiled
def bridge_strings(
    strings: FloatArray,
    begin: FloatArray,
    width: float,
    lowest: float,
    highest: float,
    heights: FloatArray,
) -> None:
    """Write the bridged height of the line at every point along the strings.

    Args:
        strings: elevation from right to left, shape (strings, n), in m.
        begin: right end of the line at every point, in strings from the first, shape (n,).
        width: of the line, in strings.
        lowest: share of the line that is left out from below, from 0 to 1.
        highest: share that is left out from above.
        heights: written, shape (n,), in m.
    """
    most = int(width) + 3
    pieces = Pieces(np.empty(most), np.empty(most), np.empty(most))
    upper = 1.0 - highest
    bottom = top = strings[0, 0]
    for k in range(begin.size):
        count = _cut_line(strings, k, begin[k], width, pieces)
        # The quantiles of the point before are near.
        bottom, left_out = _lowest_part(pieces, count, lowest, bottom)
        top, kept = _lowest_part(pieces, count, upper, top)
        heights[k] = (kept - left_out) / (upper - lowest)


@compiled
def _cut_line(strings: FloatArray, k: int, begin: float, width: float, pieces: Pieces) -> int:
    """Cut the line at point ``k`` of the strings into ``pieces``; return their number.

    A line that begins or ends beyond an outer string by rounding ends on it.
    """
    at, end = max(begin, 0.0), min(begin + width, strings.shape[0] - 1.0)
    whole = end - at
    before = _height_at(strings, k, at)
    count = 0
    while at < end:
        cut = min(np.floor(at) + 1.0, end)
        after = _height_at(strings, k, cut)
        pieces.low[count], pieces.high[count] = min(before, after), max(before, after)
        pieces.share[count] = (cut - at) / whole
        at, before = cut, after
        count += 1
    return count


@compiled
def _height_at(strings: FloatArray, k: int, position: float) -> float:
    """Return the elevation at a position in strings, linear in between."""
    index = min(int(position), strings.shape[0] - 2)
    right, left = strings[index, k], strings[index + 1, k]
    return float(right + (position - index) * (left - right))


@compiled
def _lowest_part(pieces: Pieces, count: int, part: float, level: float) -> tuple[float, float]:
    """Return the height below which ``part`` of the line lies, and what that adds to the mean.

    Newton's method from ``level`` on, between bounds: the share below a height is linear between
    ends of pieces. The part adds ``part`` times the quantile less the mean depth below the
    quantile, which is stationary in it: an error of the quantile counts by its square.
    """
    least, most = pieces.low[0], pieces.high[0]
    for j in range(1, count):
        least, most = min(least, pieces.low[j]), max(most, pieces.high[j])
    quantile, lower = most, most * part
    for _ in range(MOST_STEPS if least < most else 0):
        if not least < level < most:
            level = (least + most) / 2
        below, density, depth = _under(pieces, count, level)
        quantile, lower = level, level * part - depth
        if abs(below - part) < CLOSE:
            break
        if below < part:
            least = level
        else:
            most = level
        level = level + (part - below) / density if density > 0.0 else least
    return quantile, lower


@compiled
def _under(pieces: Pieces, count: int, level: float) -> tuple[float, float, float]:
    """Return the share of the line below ``level``, its derivative, and the mean depth below."""
    below = density = depth = 0.0
    for j in range(count):
        low, high, share = pieces.low[j], pieces.high[j], pieces.share[j]
        if level >= high:
            below += share
            depth += share * (level - (low + high) / 2)
        elif level > low:
            # The share comes first: a relief of 1e-313 m has no finite density.
            covered = share * ((level - low) / (high - low))
            below += covered
            density += share / (high - low)
            depth += covered * (level - low) / 2
    return below, density, depth
