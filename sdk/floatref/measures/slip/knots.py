"""Few points whose straight lines replace a series along the road."""

import numpy as np

from floatref.values.arrays import FloatArray, IndexArray

OFF = 1.0
"""Largest distance of the series from the lines, in its own unit: 1 m²/s² of a squared speed."""
MOST = 500


def knots_of(along: FloatArray, values: FloatArray, off: float = OFF) -> IndexArray:
    """Return which of the points to keep, shape (k,), first and last among them.

    Lines between the kept points are within ``off`` of ``values`` at all points (Douglas and
    Peucker, 1973), unless that took more than `MOST`. ``along`` does not decrease.
    """
    kept, waiting = {0, along.size - 1}, [(0, along.size - 1)]
    while waiting and len(kept) < MOST:
        first, last = waiting.pop(0)
        if last - first < 2:
            continue
        inside = slice(first + 1, last)
        line = np.interp(along[inside], along[[first, last]], values[[first, last]])
        away = np.abs(values[inside] - line)
        farthest = int(np.argmax(away))
        if away[farthest] > off:
            middle = first + 1 + farthest
            kept.add(middle)
            waiting += [(first, middle), (middle, last)]
    return np.array(sorted(kept), np.int64)
