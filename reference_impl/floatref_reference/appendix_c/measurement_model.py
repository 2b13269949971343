"""C.7 to C.10: linearized measurement model."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import Inputs, Matrix, State, abbreviations


class LeverArm(NamedTuple):
    """Where the GPS antenna is, seen from the profiler reference point.

    Equation:
        (6.39) has l_y and l_z; l_x goes beyond the print, which leaves it out.

    Attributes:
        l_x: m, forward.
        l_y: m, to the left.
        l_z: m, upward.
    """

    l_x: float
    l_y: float
    l_z: float


def matrix_h(x: npt.ArrayLike, u: npt.ArrayLike, lever: npt.ArrayLike) -> Matrix:
    """Differentiate the measurement model with respect to the state.

    Equation:
        (C.8) with (C.9): H of (6.14), that is ∂h/∂x of (6.48), as printed if l_x = 0. Beyond the
        print, l_x adds -c_φ c_θ l_x to H[2,7].

    Args:
        x: state of (C.2), shape (7,).
        u: inputs u_ax, u_ay, u_az in m/s² and u_ω1, u_ω2, u_ω3 in rad/s, shape (6,).
        lever: lever arm l_x, l_y, l_z of the antenna, m, shape (3,).

    Returns:
        H, shape (4, 7), its rows in the order of (C.7).
    """
    state, u_k = State(*np.asarray(x, np.float64)), Inputs(*np.asarray(u, np.float64))
    l_x, l_y, l_z = arm = LeverArm(*np.asarray(lever, np.float64))
    s_theta, c_theta, s_phi, c_phi = abbreviations(state.theta, state.phi)
    h_13, h_14, h_23, h_24 = elements_of_h(state, u_k, arm)
    h_26 = c_theta * (c_phi * l_y - s_phi * l_z)
    h_27 = -s_theta * l_z - c_phi * c_theta * l_x
    root = float(np.sqrt(1 - (c_theta * s_phi) ** 2))
    return np.array(
        [
            [1, 0, h_13, h_14, 0, 0, 0],
            [0, 1, h_23, h_24, 0, h_26, h_27],
            [0, 0, 1, 0, 0, 0, 0],
            [0, 0, -s_theta * s_phi / root, c_theta * c_phi / root, 0, 0, 0],
        ]
    )


def elements_of_h(x: State, u: Inputs, lever: LeverArm) -> tuple[float, float, float, float]:
    """Compute those elements of H by which the attitude moves the antenna.

    Equation:
        (C.9) H[1,3] = -s_θ (s_φ l_y + c_φ l_z), H[1,4] = c_θ (c_φ l_y - s_φ l_z),
        H[2,3] = -c_θ ((u_ω2 + δ_ω2) l_z - u_ω3 l_y) - s_θ (u_ω1 + δ_ω1) (c_φ l_y - s_φ l_z),
        H[2,4] = -c_θ (u_ω1 + δ_ω1) (s_φ l_y + c_φ l_z). Beyond the print, with
        θ̇ = c_φ (u_ω2 + δ_ω2) - s_φ u_ω3, l_x adds -c_θ l_x to H[1,3], s_θ θ̇ l_x to H[2,3] and
        c_θ (s_φ (u_ω2 + δ_ω2) + c_φ u_ω3) l_x to H[2,4].

    Args:
        x: state of (C.2).
        u: inputs.
        lever: lever arm of the antenna.

    Returns:
        H[1,3], H[1,4], H[2,3], H[2,4].
    """
    l_x, l_y, l_z = lever
    s_theta, c_theta, s_phi, c_phi = abbreviations(x.theta, x.phi)
    omega_1, omega_2 = u.u_1 + x.delta_1, u.u_2 + x.delta_2
    rise, rolled = s_phi * l_y + c_phi * l_z, c_phi * l_y - s_phi * l_z
    theta_dot = c_phi * omega_2 - s_phi * u.u_3
    h_23 = -c_theta * (omega_2 * l_z - u.u_3 * l_y) - s_theta * omega_1 * rolled
    h_24 = -c_theta * omega_1 * rise
    return (
        -s_theta * rise - c_theta * l_x,
        c_theta * rolled,
        h_23 + s_theta * theta_dot * l_x,
        h_24 + c_theta * (s_phi * omega_2 + c_phi * u.u_3) * l_x,
    )


def matrix_r(sigma: npt.ArrayLike) -> Matrix:
    """Compute the covariance of the measurement noise.

    Equation:
        (C.10) R = diag(σ_rz², σ_vz², σ_θ², σ_φ²) in the order of (C.7); V of (6.15) is I.

    Args:
        sigma: standard deviations, m, m/s, rad, rad, shape (4,).

    Returns:
        R, shape (4, 4).
    """
    return np.diag(np.asarray(sigma, np.float64) ** 2)
