"""One road from tyres that follow each other in one wheel path, (8) of Zhu.

The rear tyre meets the road of the front tyre a wheelbase later.
"""

from collections.abc import Sequence
from math import ceil, floor, isfinite

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, IndexArray

POINTS = 6
"""Number of samples around a value that its interpolating polynomial goes through."""
EVEN = 1e-6
"""Share of the step by which steps of a distance may differ."""


def join_roads(
    roads: Sequence[ArrayLike],
    sigmas: Sequence[ArrayLike],
    x_m: Sequence[float],
    distance_m: ArrayLike,
) -> tuple[FloatArray, FloatArray]:
    """Return the road over distance that several tyres have estimated, and its sigma, in m.

    Args:
        roads: for every tyre the elevation under it in m, when the model's own point is at
            ``distance_m``; NaN where it is missing.
        sigmas: their standard deviations, in m.
        x_m: position of every tyre ahead of the model's own point, in m.
        distance_m: of the model's own point, in even steps, shape (n,).

    Returns:
        Elevation at ``distance_m`` and its standard deviation, each of shape (n,). Weights are one
        over the variances; the standard deviation is the weighted mean of those joined, since a
        drift is common to all tyres. NaN where no tyre gives a value.

    Raises:
        InputError: If lengths differ, a position is not finite, or the steps are not even and
            above zero.
    """
    distance = np.asarray(distance_m, dtype=np.float64)
    step = _even_step(distance)
    if not len(roads) == len(sigmas) == len(x_m) or not len(roads):
        raise InputError(
            f"{len(roads)} roads, {len(sigmas)} sigmas and {len(x_m)} positions; "
            "give one of each for every tyre"
        )
    if not np.isfinite(x_m).all():
        raise InputError(f"tyres at {', '.join(f'{x:g}' for x in x_m)} m; give finite numbers")
    over, spread = np.zeros(distance.size), np.zeros(distance.size)
    weights = np.zeros(distance.size)
    for road, sigma, ahead in zip(roads, sigmas, x_m, strict=True):
        height, deviation, weight = _read_earlier(road, sigma, ahead / step, distance.size)
        over += weight * height
        spread += weight * deviation
        weights += weight
    total = np.where(weights > 0, weights, np.nan)
    return over / total, spread / total


def join_at_speed(
    roads: Sequence[ArrayLike],
    sigmas: Sequence[ArrayLike],
    x_m: Sequence[float],
    speed_m_per_s: float,
    step_s: float,
) -> tuple[FloatArray, FloatArray]:
    """Return the same as `join_roads`, for samples ``step_s`` apart at constant ``speed_m_per_s``.

    The delay of (8) of Zhu, the wheelbase over the speed, can be any number of samples.
    Raises InputError as `join_roads`, and for a speed or a step that is not above zero.
    """
    for name, value, unit in (("speed", speed_m_per_s, "m/s"), ("time step", step_s, "s")):
        if not (isfinite(value) and value > 0):
            raise InputError(
                f"joining of tyres: a {name} of {value:g} {unit}; give a number above zero"
            )
    distance = speed_m_per_s * step_s * np.arange(np.size(roads[0]) if len(roads) else 0)
    return join_roads(roads, sigmas, x_m, distance)


def shift(values: ArrayLike, samples: float) -> FloatArray:
    """Return ``values``, shape (n,), as they are ``samples`` later, by a polynomial through six.

    NaN where one of the six is missing or NaN; exact copies for a whole number of samples. Raises
    InputError for another shape, and for a shift that is not finite.
    """
    series = np.asarray(values, dtype=np.float64)
    if series.ndim != 1 or not isfinite(samples):
        raise InputError(
            f"values of the shape {series.shape} to shift by {samples:g} samples; give one channel "
            "and a finite number"
        )
    whole = round(samples)
    if abs(samples - whole) < EVEN:
        return _move(series, whole)
    whole = floor(samples)
    nodes = np.arange(POINTS) - (POINTS // 2 - 1)
    weights = _weights(nodes, samples - whole)
    moved = [_move(series, whole + int(node)) for node in nodes]
    return np.asarray(weights @ np.stack(moved))


def _weights(nodes: IndexArray, at: float) -> FloatArray:
    """Return the weight of every node in the polynomial's value (Lagrange's) at ``at``."""
    apart = nodes[:, None] - nodes
    factors = np.where(apart == 0, 1.0, (at - nodes) / np.where(apart == 0, 1, apart))
    return np.asarray(factors.prod(axis=1))


def _move(series: FloatArray, by: int) -> FloatArray:
    """Return ``series`` as it is ``by`` whole samples later, NaN beyond its ends."""
    result = np.full(series.size, np.nan)
    begin, end = max(0, -by), min(series.size, series.size - by)
    if begin < end:
        result[begin:end] = series[begin + by : end + by]
    return result


def _read_earlier(
    road: ArrayLike, sigma: ArrayLike, samples: float, size: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return elevation, sigma and weight ``samples`` earlier; all are zero where unknown."""
    height, deviation = np.asarray(road, np.float64), np.asarray(sigma, np.float64)
    if height.shape != (size,) or deviation.shape != (size,):
        raise InputError(
            f"a road of shape {height.shape} with sigmas of {deviation.shape} over {size} "
            "distances; all must have one length"
        )
    if (deviation <= 0).any():
        raise InputError(f"a sigma of {np.nanmin(deviation):g} m; give numbers above zero, or NaN")
    # The road under a tyre x ahead of the point is under the point x later.
    height = shift(height, -samples)
    deviation = np.maximum(_move(deviation, floor(-samples)), _move(deviation, ceil(-samples)))
    known = np.isfinite(height) & np.isfinite(deviation)
    weight = known / np.where(known, deviation, 1.0) ** 2
    return np.where(known, height, 0.0), np.where(known, deviation, 0.0), weight


def _even_step(distance: FloatArray) -> float:
    steps = np.diff(distance)
    step = float(np.mean(steps)) if steps.size else 0.0
    if not step > 0 or np.abs(steps - step).max() > EVEN * step:
        raise InputError(
            "distances to join roads over are not in even steps above zero; resample them"
        )
    return step
