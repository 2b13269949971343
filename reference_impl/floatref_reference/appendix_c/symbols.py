"""C.1 and C.2: abbreviations, and the vectors that the extended Kalman filter works on."""

from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

Vector: TypeAlias = npt.NDArray[np.float64]
Matrix: TypeAlias = npt.NDArray[np.float64]


class State(NamedTuple):
    """The state of the profiler reference point.

    Equation:
        (C.2) x = {r_zp, v_zp, θ, φ, δ_a, δ_ω1, δ_ω2}ᵀ. As (6.30) and (6.37) have it, each δ is
        what has to be added to a sensor's output, that is minus its bias.

    Attributes:
        r_zp: height, m, upward.
        v_zp: vertical velocity, m/s.
        theta: pitch θ, rad, positive nose down.
        phi: roll φ, rad, positive left side up.
        delta_a: δ_a, m/s², in the vertical acceleration.
        delta_1: δ_ω1, rad/s, in the roll rate.
        delta_2: δ_ω2, rad/s, in the pitch rate.
    """

    r_zp: float
    v_zp: float
    theta: float
    phi: float
    delta_a: float
    delta_1: float
    delta_2: float


class Inputs(NamedTuple):
    """What the inertial sensors read.

    Equation:
        u of (6.8) as (6.47) uses it: u = (u_ax, u_ay, u_az, u_ω1, u_ω2, u_ω3).

    Attributes:
        u_ax: specific force forward, m/s².
        u_ay: specific force to the left, m/s².
        u_az: specific force upward, m/s², about +g at rest and level.
        u_1: roll rate u_ω1, rad/s.
        u_2: pitch rate u_ω2, rad/s.
        u_3: yaw rate u_ω3, rad/s.
    """

    u_ax: float
    u_ay: float
    u_az: float
    u_1: float
    u_2: float
    u_3: float


def abbreviations(theta: float, phi: float) -> tuple[float, float, float, float]:
    """Abbreviate the sines and cosines.

    Equation:
        (C.1) s_θ = sin θ, c_θ = cos θ, s_φ = sin φ, c_φ = cos φ

    Args:
        theta: pitch θ, rad.
        phi: roll φ, rad.

    Returns:
        s_θ, c_θ, s_φ, c_φ.
    """
    return float(np.sin(theta)), float(np.cos(theta)), float(np.sin(phi)), float(np.cos(phi))
