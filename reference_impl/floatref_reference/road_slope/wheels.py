"""The road's points, and slope and height of the line through both axles."""

from math import ceil, floor
from typing import NamedTuple

import numpy as np

from floatref_reference.road_slope.symbols import Places, Stretch, Values, has_both_sides, is_cut

MARGIN = 1.0
"""Metres of road before the first and behind the last place that is needed."""


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
    x, d = stretch.readings.place, stretch.constants.spacing
    ahead = [0.0, stretch.places.front, stretch.places.rear]
    first = float(np.min(x)) + min(ahead) - MARGIN
    last = float(np.max(x)) + max(ahead) + MARGIN
    return Points(first, d, ceil((last - first) / d) + 2)


def road_at(elevation: Values, points: Points, place: float) -> Values:
    """Return the road's elevation at a place.

    Equation:
        z(x) = (1 - w) z_j + w z_{j+1}, j = ⌊(x - x_0)/d⌋, w = (x - x_0)/d - j

    Args:
        elevation: z_j, m, shape (N,).
        points: where they are.
        place: x, m, between the first and the last point.

    Returns:
        z(x), m, shape ().
    """
    along = (place - points.first) / points.spacing
    j = floor(along)
    w = along - j
    between: Values = (1 - w) * elevation[j] + w * elevation[j + 1]
    return between


def slope_under_wheels(elevation: Values, points: Points, place: float, at: Places) -> Values:
    """Return the slope of the line through both axles.

    Equation:
        β = (z(x + x_f) - z(x + x_r))/L

    Args:
        elevation: z_j, m, shape (N,).
        points: where they are.
        place: x of the laser, m.
        at: places of the axles.

    Returns:
        β, shape ().
    """
    front = road_at(elevation, points, place + at.front)
    rear = road_at(elevation, points, place + at.rear)
    return (front - rear) / (at.front - at.rear)


def height_over_wheels(elevation: Values, points: Points, place: float, at: Places) -> Values:
    """Return the height of the line through both axles at the accelerometer.

    Equation:
        p = (1 + (l + x_r)/L) z(x + x_r) - ((l + x_r)/L) z(x + x_f)

    Args:
        elevation: z_j, m, shape (N,).
        points: where they are.
        place: x of the laser, m.
        at: places of the axles and of the accelerometer.

    Returns:
        p, m, shape ().
    """
    front = road_at(elevation, points, place + at.front)
    rear = road_at(elevation, points, place + at.rear)
    share = (at.lever + at.rear) / (at.front - at.rear)
    return (1 + share) * rear - share * front


def slope_rate(slopes: list[Values], stretch: Stretch, k: int) -> Values:
    """Return how fast the slope under the wheels changes, from nodes of one piece.

    Equation:
        β̇_k = (β_{k+1} - β_{k-1})/(2Δ), or of the piece's two last nodes over Δ where it ends

    Args:
        slopes: β at all K nodes.
        stretch: what is known.
        k: node, of a piece of two nodes at least.

    Returns:
        β̇_k, 1/s, shape ().

    Raises:
        ValueError: if the node is alone between two cuts.
    """
    interval, last = stretch.constants.interval, len(slopes) - 1
    if has_both_sides(stretch, k):
        return (slopes[k + 1] - slopes[k - 1]) / (2 * interval)
    if k > 0 and not is_cut(stretch, k):
        return (slopes[k] - slopes[k - 1]) / interval
    if k < last and not is_cut(stretch, k + 1):
        return (slopes[k + 1] - slopes[k]) / interval
    raise ValueError(f"node {k} is alone, it has no rate")
