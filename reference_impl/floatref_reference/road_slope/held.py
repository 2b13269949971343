"""What is held while the unknowns of a pass are found."""

from typing import NamedTuple

import numpy as np

from floatref_reference.road_slope.bends import first_intensity, intensity_by_slopes
from floatref_reference.road_slope.symbols import Stretch, Vector
from floatref_reference.road_slope.unknowns import by_name, start
from floatref_reference.road_slope.wheels import road_points, slopes_under_wheels

FIRST_LOOSE = 30.0
FIRST_STEP = 1e-3
"""Step of the offset in m that the first pass takes as found."""


class Held(NamedTuple):
    """What the rows of a pass take as known.

    Equation:
        g_j, β_k and o_k of the unknowns that the pass begins with, and max(1, 30 · 2⁻ⁱ)

    Attributes:
        intensity: g_j, 1/m, shape (N-1,).
        beta: β_k in the variance of the moment's steps, shape (K,).
        stepped: o_{k+1} - o_k in the variance of the offset's steps, m, shape (K-1,).
        loose: factor of the 1-σ of the rows of bounce and pitch.
    """

    intensity: Vector
    beta: Vector
    stepped: Vector
    loose: float = 1.0


def loosened(pass_: int) -> float:
    """Return the factor of the 1-σ of bounce and pitch.

    Equation:
        max(1, 30 · 2⁻ⁱ)

    Args:
        pass_: i, from 0.
    """
    return max(1.0, FIRST_LOOSE * 0.5**pass_)


def held_by(vector: Vector, stretch: Stretch, intensity: Vector, loose: float = 1.0) -> Held:
    """Hold the slopes under the wheels and the steps of the offset at some unknowns.

    Equation:
        β_k of z_j, and o_{k+1} - o_k

    Args:
        vector: unknowns, shape (M,).
        stretch: what is known.
        intensity: g_j, 1/m, shape (N-1,).
        loose: factor of the 1-σ of bounce and pitch.
    """
    x = by_name(vector, len(intensity) + 1, len(stretch.readings.place))
    beta = np.array(slopes_under_wheels(x.elevation, stretch))
    return Held(intensity, beta, np.diff(x.offset), loose)


def first_held(stretch: Stretch) -> Held:
    """Return what the first pass holds.

    Equation:
        30 g_0, β of the start, 1 mm for each step of the offset, and the factor 30

    Args:
        stretch: what is known.
    """
    intensity = first_intensity(road_points(stretch).number, stretch.constants)
    held = held_by(start(stretch), stretch, intensity, loosened(0))
    return held._replace(stepped=np.full(len(held.beta) - 1, FIRST_STEP))


def held_after(vector: Vector, stretch: Stretch, loose: float) -> Held:
    """Return what is held after a pass.

    Equation:
        g_j, β_k and the steps of o_k of its unknowns

    Args:
        vector: unknowns, shape (M,).
        stretch: what is known.
        loose: factor of the 1-σ of bounce and pitch in the next pass.
    """
    x = by_name(vector, road_points(stretch).number, len(stretch.readings.place))
    intensity = intensity_by_slopes(x.slope, stretch.constants)
    return held_by(vector, stretch, intensity, loose)
