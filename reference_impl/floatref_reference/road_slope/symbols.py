"""Symbols of the slope under the wheels: readings, places, and which nodes are in one piece."""

from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from floatref_reference.road_slope.constants import Constants

Vector: TypeAlias = npt.NDArray[np.float64]
Matrix: TypeAlias = npt.NDArray[np.float64]
Values: TypeAlias = npt.NDArray[Any]
"""Real or complex, by the unknowns; with m vectors of them at once it has a last axis of m."""


class Places(NamedTuple):
    """Where axles and accelerometer are, as seen from the laser.

    Equation:
        L = x_f - x_r

    Attributes:
        front: x_f of the front axle, ahead of the laser, m.
        rear: x_r of the rear axle, ahead of the laser, m.
        lever: l, the laser ahead of its accelerometer, m.
    """

    front: float
    rear: float
    lever: float


class Readings(NamedTuple):
    """What was read at the K nodes of a stretch.

    Equation:
        h_k, F_k, x_k, V_k and a_k, each the mean over one box of Δ

    Attributes:
        height: h_k, m, NaN where a reading is missing, shape (K,).
        force: F_k, vertical specific force less 1 g, m/s², shape (K,); those of the first and the
            last node and beside a cut are not used.
        place: x_k of the laser, m, shape (K,).
        speed: V_k, m/s, shape (K,).
        along: a_k, acceleration along the road, m/s², shape (K,).
        missing: share of the accelerometer's samples that are missing, 0 to 1, shape (K,).
        pause: time from node k-1 to node k, s, shape (K,): Δ, or longer where a standstill was
            cut; the first is not used.
    """

    height: Vector
    force: Vector
    place: Vector
    speed: Vector
    along: Vector
    missing: Vector
    pause: Vector


class Stretch(NamedTuple):
    """Everything that is known of a stretch."""

    readings: Readings
    places: Places
    constants: Constants


def is_cut(stretch: Stretch, k: int) -> bool:
    """Tell whether a standstill was cut between the nodes k-1 and k.

    Equation:
        pause_k > 3Δ/2: it is Δ or, by whole nodes, longer; so rounding decides nothing

    Args:
        stretch: what is known.
        k: node, 1 to K-1.
    """
    return bool(stretch.readings.pause[k] > 1.5 * stretch.constants.interval_s)


def has_both_sides(stretch: Stretch, k: int) -> bool:
    """Tell whether the nodes k-1, k and k+1 are there, and in one piece.

    Args:
        stretch: what is known.
        k: node, 0 to K-1.
    """
    inside = 0 < k < len(stretch.readings.place) - 1
    return inside and not is_cut(stretch, k) and not is_cut(stretch, k + 1)
