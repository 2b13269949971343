"""Symbols of the slope under the wheels: readings, places, and constants with their units."""

from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

Vector: TypeAlias = npt.NDArray[np.float64]
Matrix: TypeAlias = npt.NDArray[np.float64]
Values: TypeAlias = npt.NDArray[Any]
"""Real or complex, by the unknowns; with m vectors of them at once it has a last axis of m."""


class Prior(NamedTuple):
    """What is known of a constant before the readings: its mean and its 1-σ."""

    mean: float
    sigma: float


class Constants(NamedTuple):
    """Constants of the model; noise as densities, but for heights.

    Equation:
        As named on the page

    Attributes:
        interval: Δ, between nodes, s.
        spacing: d, between points of the road, m.
        g: gravity, m/s².
        read: σ_h, of a height, m.
        road: q, intensity of the road's elevation, m²/m.
        bend: g_0, intensity of the slope of a plain road, 1/m.
        bend_weight: ν, degrees of freedom of g_0.
        most_bend: largest intensity over g_0.
        first_bend: intensity at the start over g_0.
        segment: length of road with one intensity, m.
        acceleration: σ_a, m/s²/√Hz.
        force_share: ε, the part of F that is not sure.
        missing_acceleration: its place where a sample is missing, m/s²/√Hz.
        bias: σ_b0, of the first bias, m/s².
        walk: σ_b, m/s²/√s.
        swing: σ_s0, rad/s²/√Hz.
        swing_speed: σ_s1, what a speed adds to it, the same per m/s.
        even: σ_e0, m.
        even_speed: σ_e1, what a speed adds to it, m per m/s.
        slope: σ_s, of the road's slope as the mean over slope_reach.
        slope_reach: ℓ, m.
        gain: κ_0 and σ_κ, rad per m/s².
        lean: λ_0 and σ_λ, rad.
        centre: H.
        offset: 1-σ of h_0 about 0, m.
        hz: f_0 in Hz, and the 1-σ of ln f.
        damping: ζ_0, and the 1-σ of ln ζ.
        start_height: 1-σ of z_0 about 0, m.
    """

    interval: float = 0.03
    spacing: float = 0.25
    g: float = 9.80665
    read: float = 2e-4
    road: float = 4e-6
    bend: float = 2e-7
    bend_weight: float = 1.0
    most_bend: float = 4000.0
    first_bend: float = 30.0
    segment: float = 10.0
    acceleration: float = 1.5e-4
    force_share: float = 0.003
    missing_acceleration: float = 0.3
    bias: float = 0.03
    walk: float = 1e-4
    swing: float = 5e-4
    swing_speed: float = 1e-3
    even: float = 2e-4
    even_speed: float = 3e-4
    slope: float = 0.01
    slope_reach: float = 60.0
    gain: Prior = Prior(0.005, 0.004)
    lean: Prior = Prior(0.0, 0.02)
    centre: Prior = Prior(0.5, 0.2)
    offset: float = 1.0
    hz: Prior = Prior(1.6, 0.3)
    damping: Prior = Prior(0.3, 0.5)
    start_height: float = 1.0


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
        h_k, F_k, x_k, V_k and a_k

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
    return bool(stretch.readings.pause[k] > 1.5 * stretch.constants.interval)


def has_both_sides(stretch: Stretch, k: int) -> bool:
    """Tell whether the nodes k-1, k and k+1 are there, and in one piece.

    Args:
        stretch: what is known.
        k: node, 0 to K-1.
    """
    inside = 0 < k < len(stretch.readings.place) - 1
    return inside and not is_cut(stretch, k) and not is_cut(stretch, k + 1)
