"""Points that were not measured, on the line between their neighbours, a stretch at a time."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Gaps = NDArray[np.int64]


def gaps_of(values: Floats) -> Gaps:
    """Return first and end index of every run of NaN in ``values``, shape (gaps, 2)."""
    missing = np.isnan(values)
    edges = np.flatnonzero(np.diff(missing, prepend=False, append=False))
    return edges.reshape(-1, 2)


def bridged(values: Floats, gaps: Gaps, first: int, last: int) -> Floats:
    """Return ``values[first:last]`` with its gaps filled; at either end the nearest value stays.

    ``gaps`` are those of ``values``, shape (n,), of which one at least is not NaN.
    """
    stretch = values[first:last]
    missing = np.flatnonzero(np.isnan(stretch))
    if missing.size == 0:
        return stretch
    begin, end = gaps[np.searchsorted(gaps[:, 0], missing + first, "right") - 1].T
    before = np.where(begin > 0, begin - 1, end)
    after = np.where(end < values.size, end, before)
    before = np.where(begin > 0, before, after)
    part = (missing + first - before) / np.maximum(after - before, 1)
    filled = stretch.copy()
    filled[missing] = values[before] + part * (values[after] - values[before])
    return filled
