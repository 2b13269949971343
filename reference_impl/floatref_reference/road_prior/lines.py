"""Means over bins of samples, smooth local lines through them, and back to the samples.

The lines are least squares with Gaussian weights. They are symmetric in time, so they shift no
phase, and a ramp passes them as it is, at the ends of a run as well.
"""

import math

import numpy as np

from floatref_reference.road_prior.symbols import Vector

REACH = 4.0


def bins(x: Vector, every: int) -> Vector:
    """Average a signal over each bin.

    Equation:
        Mean of what is there; NaN where that is less than half, and of a bin that is cut short.

    Args:
        x: signal, shape (N,).
        every: samples of a bin.

    Returns:
        Means, shape (ceil(N/every),).
    """
    means = []
    for k in range(0, len(x), every):
        there = [value for value in x[k : k + every] if not np.isnan(value)]
        known = k + every <= len(x) and 2 * len(there) >= every
        means.append(sum(there) / len(there) if known else math.nan)
    return np.array(means)


def local_line(y: Vector, b: int, sigma: float, silent: Vector, patience: float) -> float:
    """Find the value at b of a line through y.

    Equation:
        min Σ w_j (y_{b+j} - α - β j)², w_j = exp(-j²/(2σ²)), |j| ≤ 4σ; the mean alone if the places
        there are off b, on average, by more than twice their deviation. No bin counts that
        ``patience`` silent ones in a row part from b.

    Args:
        y: values, NaN where unknown.
        b: place.
        sigma: σ in bins.
        silent: whether there is no rate in each bin.
        patience: as above.

    Returns:
        α, or NaN if nothing is known.
    """
    places = []
    for way in (1, -1):
        run, reach = 0, round(REACH * sigma)
        for j in range(reach + 1):
            if not 0 <= b + way * j < len(y):
                break
            run = run + 1 if silent[b + way * j] else 0
            if run >= patience:
                break
            if not np.isnan(y[b + way * j]) and (j > 0 or way > 0):
                places.append(way * j)
    if not places:
        return math.nan
    w = [math.exp(-0.5 * (j / sigma) ** 2) for j in places]
    centre = sum(w_j * j for w_j, j in zip(w, places, strict=True)) / sum(w)
    spread = sum(w_j * (j - centre) ** 2 for w_j, j in zip(w, places, strict=True)) / sum(w)
    mean = sum(w_j * y[b + j] for w_j, j in zip(w, places, strict=True)) / sum(w)
    if centre**2 > 4 * spread or spread < 1e-9:
        return float(mean)
    moment = sum(w_j * (j - centre) * y[b + j] for w_j, j in zip(w, places, strict=True)) / sum(w)
    return float(mean - moment / spread * centre)


def whole_bins(x: Vector, every: int) -> list[float]:
    """Average a signal that is never missing over each bin.

    Equation:
        Mean of a bin, that of the last over as much as there is of it

    Args:
        x: signal, shape (N,).
        every: samples of a bin.

    Returns:
        Means.
    """
    return [float(np.mean(x[k : k + every])) for k in range(0, len(x), every)]


def between(values: list[float], k: int, every: int) -> float:
    """Interpolate between the centres of the bins.

    Equation:
        linear; constant before the first centre and behind the last

    Args:
        values: one for each bin.
        k: sample.
        every: samples of a bin.

    Returns:
        The value at k.
    """
    centres = [b * every + (every - 1) / 2 for b in range(len(values))]
    return float(np.interp(k, centres, values))
