"""How much the road's slope may change: one intensity for each 10 m, from the slopes found."""

import numpy as np

from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.symbols import Values, Vector


def first_intensity(points: int, c: Constants) -> Vector:
    """Return the intensities of the first pass.

    Equation:
        30 g_0

    Args:
        points: N of the road.
        c: constants.

    Returns:
        g_j, 1/m, shape (N-1,).
    """
    return np.full(points - 1, c.first_bend * c.bends)


def segment_of(j: int, c: Constants) -> int:
    """Return the segment that the step from point j to j + 1 belongs to.

    Equation:
        ⌊j/round(10 m/d)⌋
    """
    return j // round(c.segment_m / c.spacing_m)


def intensity_by_slopes(slope: Values, c: Constants) -> Vector:
    """Return the intensities after a pass.

    Equation:
        g = (ν g_0 + Σ (s_{j+1} - s_j)²/d)/(ν + 1) over the steps of a segment,
        g_0 ≤ g ≤ 4000 g_0

    Args:
        slope: s_j, real, shape (N,).
        c: constants.

    Returns:
        g_j, 1/m, shape (N-1,).
    """
    steps = range(len(slope) - 1)
    squares = [0.0] * (segment_of(len(slope) - 2, c) + 1)
    for j in steps:
        squares[segment_of(j, c)] += float(slope[j + 1] - slope[j]) ** 2 / c.spacing_m
    found = [(c.bend_weight * c.bends + total) / (c.bend_weight + 1) for total in squares]
    bounded = [min(max(g, c.bends), c.most_bend * c.bends) for g in found]
    return np.array([bounded[segment_of(j, c)] for j in steps])
