"""What the encoder's scale error adds to the 1-σ of an elevation.

A profile is told along the encoder's distance. If that is off by dx, the elevation is that of a
place dx away: off by the road's slope times dx, which grows from the start of the run on.
"""

import numpy as np

from floatref.values.arrays import FloatArray

LAG_M = 0.05
"""Slopes are those over so far: what an encoder is off by after a few hundred metres."""
PIECE = 1 << 18
"""Points looked at together, so that memory stays bounded on a long profile."""
AROUND_M = 50.0
"""The slope is the root mean square within half of this to either side."""


def add_axis_error(
    sigma: FloatArray, elevation: FloatArray, interval_m: float, scale: float
) -> None:
    """Add to ``sigma`` in m, shape (N,), what a relative error ``scale`` of distance makes.

    It is changed in place: of a long run another array would count.
    """
    beside = round((AROUND_M / 2 + LAG_M) / interval_m) + 1
    for begin in range(0, sigma.size, PIECE):
        end = min(begin + PIECE, sigma.size)
        low = max(begin - beside, 0)
        slopes = slope(elevation[low : end + beside], interval_m)[begin - low : end - low]
        off = scale * interval_m * np.arange(begin, end)
        np.hypot(sigma[begin:end], off * slopes, out=sigma[begin:end])


def slope(elevation: FloatArray, interval_m: float) -> FloatArray:
    """Return the root mean square of the slopes around every point, shape (N,).

    Missing elevations are left out; it is 0 where there are no others, or one.
    """
    lag = max(1, round(LAG_M / interval_m))
    if elevation.size <= lag:
        return np.zeros(elevation.size)
    steps = (elevation[lag:] - elevation[:-lag]) / (lag * interval_m)
    there = np.isfinite(steps)
    squares = np.cumsum(np.append(0.0, np.where(there, steps, 0.0) ** 2))
    counts = np.cumsum(np.append(0, there))
    half = max(1, round(AROUND_M / 2 / interval_m))
    place = np.arange(elevation.size)
    low, high = np.clip(place - half, 0, steps.size), np.clip(place + half, 0, steps.size)
    low = np.minimum(low, steps.size - 1)
    number = np.maximum(counts[high] - counts[low], 1)
    mean: FloatArray = np.sqrt((squares[high] - squares[low]) / number)
    return mean
