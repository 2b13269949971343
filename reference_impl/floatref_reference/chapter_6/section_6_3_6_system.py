"""6.3.3 Sensor Drift and 6.3.6 Discrete System Equations."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.measurement_model import LeverArm
from floatref_reference.appendix_c.symbols import Inputs, State, Vector, abbreviations
from floatref_reference.chapter_6.section_6_3_2_inertial_sensors import G

NO_PROCESS_NOISE = (0.0,) * 7
NO_MEASUREMENT_NOISE = (0.0,) * 4


def random_walk(delta: npt.ArrayLike, e: npt.ArrayLike) -> Vector:
    """Let the drift of a sensor walk by one step.

    Equation:
        (6.38) δ_{k+1} = δ_k + e'_k

    Args:
        delta: δ_a, δ_ω1, δ_ω2, m/s² and rad/s, shape (3,).
        e: e_a', e_ω'1, e_ω'2 in the same units, shape (3,).

    Returns:
        The drifts one step later, shape (3,).
    """
    return np.asarray(delta, np.float64) + np.asarray(e, np.float64)


def f(x: npt.ArrayLike, u: npt.ArrayLike, dt: float, w: npt.ArrayLike = NO_PROCESS_NOISE) -> Vector:
    """Advance the process model by one time step.

    Equation:
        (6.47) with a_zp of (6.37), θ̇ and φ̇ of (6.27) and (6.28) and every rate ω = u_ω + δ_ω + e_ω
        as in (6.30), δ_ω3 being zero: r_zp,k = r_zp,k-1 + v_zp,k-1 Δt + a_zp Δt²/2,
        v_zp,k = v_zp,k-1 + a_zp Δt, θ_k = θ_{k-1} + θ̇ Δt, φ_k = φ_{k-1} + φ̇ Δt, and (6.38), all
        evaluated at k-1.

    Args:
        x: x_{k-1} of (C.2), shape (7,).
        u: u_{k-1}: u_ax, u_ay, u_az in m/s² and u_ω1, u_ω2, u_ω3 in rad/s, shape (6,).
        dt: time step Δt, s.
        w: noise e_a, e_ω1, e_ω2, e_ω3, e_a', e_ω'1, e_ω'2, shape (7,).

    Returns:
        x_k, shape (7,).
    """
    r_zp, v_zp, theta, phi, delta_a, delta_1, delta_2 = State(*np.asarray(x, np.float64))
    u_ax, u_ay, u_az, u_1, u_2, u_3 = Inputs(*np.asarray(u, np.float64))
    e_a, e_1, e_2, e_3, *e_walk = np.asarray(w, np.float64)
    s_theta, c_theta, s_phi, c_phi = abbreviations(theta, phi)
    omega_1, omega_2, omega_3 = u_1 + delta_1 + e_1, u_2 + delta_2 + e_2, u_3 + e_3
    level = -s_theta * u_ax + c_theta * s_phi * u_ay + c_theta * c_phi * u_az
    a_zp = level + delta_a + e_a - G
    t_theta = s_theta / c_theta
    return np.array(
        [
            r_zp + v_zp * dt + a_zp * dt**2 / 2,
            v_zp + a_zp * dt,
            theta + (c_phi * omega_2 - s_phi * omega_3) * dt,
            phi + omega_1 * dt + t_theta * (s_phi * omega_2 + c_phi * omega_3) * dt,
            *random_walk([delta_a, delta_1, delta_2], e_walk),
        ]
    )


def h(
    x: npt.ArrayLike,
    u: npt.ArrayLike,
    lever: npt.ArrayLike,
    v: npt.ArrayLike = NO_MEASUREMENT_NOISE,
) -> Vector:
    """Compute what GPS reads.

    Equation:
        (6.48) y_rz,k = r_zp,k + c_θ (s_φ l_y + c_φ l_z) + e_rz,k,
        y_vz,k = v_zp,k + s_θ (u_ω3 l_y - (u_ω2 + δ_ω2) l_z)
        + c_θ (u_ω1 + δ_ω1) (c_φ l_y - s_φ l_z) + e_vz,k,
        y_θ,k = θ_k + e_θ,k, y_φ,k = sin⁻¹(c_θ s_φ) + e_φ,k, all as printed if l_x = 0. Beyond the
        print, -s_θ l_x in y_rz and -c_θ θ̇ l_x in y_vz with θ̇ = c_φ (u_ω2 + δ_ω2) - s_φ u_ω3.

    Args:
        x: x_k of (C.2), shape (7,).
        u: u_k: u_ax, u_ay, u_az in m/s² and u_ω1, u_ω2, u_ω3 in rad/s, shape (6,).
        lever: lever arm l_x, l_y, l_z of the antenna, m, shape (3,).
        v: noise e_rz, e_vz, e_θ, e_φ, shape (4,).

    Returns:
        y_rz in m, y_vz in m/s, y_θ and y_φ in rad, shape (4,).
    """
    r_zp, v_zp, theta, phi, _, delta_1, delta_2 = State(*np.asarray(x, np.float64))
    _, _, _, u_1, u_2, u_3 = Inputs(*np.asarray(u, np.float64))
    l_x, l_y, l_z = LeverArm(*np.asarray(lever, np.float64))
    s_theta, c_theta, s_phi, c_phi = abbreviations(theta, phi)
    theta_dot = c_phi * (u_2 + delta_2) - s_phi * u_3
    y_rz = r_zp + c_theta * (s_phi * l_y + c_phi * l_z)
    y_vz = (
        v_zp
        + s_theta * (u_3 * l_y - (u_2 + delta_2) * l_z)
        + c_theta * (u_1 + delta_1) * (c_phi * l_y - s_phi * l_z)
    )
    forward = [-s_theta * l_x, -c_theta * theta_dot * l_x]
    y = [y_rz + forward[0], y_vz + forward[1], theta, float(np.arcsin(c_theta * s_phi))]
    return np.array(y) + np.asarray(v, np.float64)
