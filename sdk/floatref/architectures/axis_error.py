"""What the encoder's scale error, and a tyre's contact, add to the 1-σ of an elevation.

A profile is told along the encoder's distance. If that is off by dx, the elevation is that of a
place dx away: off by the road's slope times dx, which grows from the start of the run on. What a
tyre feels is the mean of the road over its contact: off by the short waves that it levels.
"""

from math import sqrt

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


def add_contact_error(
    sigma: FloatArray, elevation: FloatArray, interval_m: float, contact_m: float
) -> None:
    """Add to ``sigma`` in m, shape (N,), what a tyre levels over ``contact_m``; in place.

    Of a road whose spectrum falls as C/n², the mean over L leaves out
    ∫ C/n² (1 - sin(πnL)/(πnL))² dn = π²CL/6 of the variance. Two points L apart on the road so
    levelled differ by 2 ∫ C/n² (sin(πnL)/(πnL))² (1 - cos 2πnL) dn = 4π²CL/3 in the mean square,
    eight times as much.
    """
    beside = round((AROUND_M / 2 + contact_m) / interval_m) + 1
    lag_m = max(1, round(contact_m / interval_m)) * interval_m
    for begin in range(0, sigma.size, PIECE):
        end = min(begin + PIECE, sigma.size)
        low = max(begin - beside, 0)
        slopes = slope(elevation[low : end + beside], interval_m, lag_m)[begin - low : end - low]
        np.hypot(sigma[begin:end], slopes * sqrt(lag_m * contact_m / 8.0), out=sigma[begin:end])


def slope(elevation: FloatArray, interval_m: float, lag_m: float = LAG_M) -> FloatArray:
    """Return the root mean square of the slopes around every point, shape (N,).

    A slope is that over ``lag_m``. Missing elevations are left out; it is 0 where there are no
    others, or one.
    """
    lag = max(1, round(lag_m / interval_m))
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
