"""The road's points, what a node passes over of it, and the slope under the wheels."""

from math import ceil, floor
from typing import NamedTuple

import numpy as np

from floatref_reference.road_slope.symbols import Stretch, Values

MARGIN = 1.0
"""Metres of road before the first and behind the last place that is needed, V_k Δ/3 or more."""


class Points(NamedTuple):
    """The road's points: x_0 of the first in m, d between them in m, and N."""

    first: float
    spacing: float
    number: int


def road_points(stretch: Stretch) -> Points:
    """Lay out points under the laser and both axles at all nodes.

    Equation:
        x_0 = min(x_k, x_k + x_f, x_k + x_r) - 1 m and
        N = ⌈(max(x_k, x_k + x_f, x_k + x_r) + 1 m - x_0)/d⌉ + 2

    Args:
        stretch: what is known.
    """
    x, d = stretch.readings.place, stretch.constants.spacing_m
    ahead = [0.0, stretch.places.front, stretch.places.rear]
    first = float(np.min(x)) + min(ahead) - MARGIN
    last = float(np.max(x)) + max(ahead) + MARGIN
    return Points(first, d, ceil((last - first) / d) + 2)


def road_at(values: Values, points: Points, place: float) -> Values:
    """Return elevation or slope of the road at a place.

    Equation:
        z(x) = (1 - w) z_j + w z_{j+1}, j = ⌊(x - x_0)/d⌋, w = (x - x_0)/d - j, and s(x) so

    Args:
        values: z_j in m or s_j, shape (N,) or (N, m).
        points: where they are.
        place: x, m, between the first and the last point.

    Returns:
        z(x) in m or s(x), shape () or (m,).
    """
    along = (place - points.first) / points.spacing
    j = floor(along)
    w = along - j
    between: Values = (1 - w) * values[j] + w * values[j + 1]
    return between


def passed_over(values: Values, stretch: Stretch, ahead: float) -> list[Values]:
    """Return the mean of what a node's time passes over.

    Equation:
        z̄_k(e) = (z(x_k + e - V_k Δ/3) + z(x_k + e) + z(x_k + e + V_k Δ/3))/3, and s̄_k so

    Args:
        values: z_j in m or s_j, shape (N,) or (N, m).
        stretch: what is known.
        ahead: e ahead of the laser, m.

    Returns:
        z̄_k(e) in m or s̄_k at all K nodes, of shape () or (m,) each.
    """
    run, points, means = stretch.readings, road_points(stretch), []
    for place, speed in zip(run.place, run.speed, strict=True):
        third = speed * stretch.constants.interval_s / 3
        parts = [road_at(values, points, place + ahead + i * third) for i in (-1, 0, 1)]
        means.append((parts[0] + parts[1] + parts[2]) / 3)
    return means


def slopes_under_wheels(elevation: Values, stretch: Stretch) -> list[Values]:
    """Return the slopes of the line through both axles.

    Equation:
        β_k = (z̄_k(x_f) - z̄_k(x_r))/L, L = x_f - x_r

    Args:
        elevation: z_j, m, shape (N,) or (N, m).
        stretch: what is known.

    Returns:
        β_k at all K nodes, of shape () or (m,) each.
    """
    at = stretch.places
    front = passed_over(elevation, stretch, at.front)
    rear = passed_over(elevation, stretch, at.rear)
    return [(f - r) / (at.front - at.rear) for f, r in zip(front, rear, strict=True)]
