"""6.3.4 GPS Position and Velocity."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import abbreviations


def antenna_offset(theta: float, phi: float, lever: npt.ArrayLike) -> float:
    """Compute how far the antenna is above the profiler reference point.

    Equation:
        (6.39) C_32 l_y + C_33 l_z, as printed if l_x = 0. Beyond the print, C_31 l_x.

    Args:
        theta: pitch θ, rad.
        phi: roll φ, rad.
        lever: lever arm l_x, l_y, l_z, m, shape (3,).

    Returns:
        Height above the reference point, m.
    """
    s_theta, c_theta, s_phi, c_phi = abbreviations(theta, phi)
    l_x, l_y, l_z = np.asarray(lever, np.float64)
    return float(-s_theta * l_x + c_theta * s_phi * l_y + c_theta * c_phi * l_z)


def antenna_velocity(theta: float, phi: float, omega: npt.ArrayLike, lever: npt.ArrayLike) -> float:
    """Compute how fast the antenna rises above the profiler reference point.

    Equation:
        (6.40) C_31 (ω_y l_z - ω_z l_y) - C_32 ω_x l_z + C_33 ω_x l_y, as printed if l_x = 0.
        Beyond the print, -c_θ θ̇ l_x with θ̇ of (6.27), which is the rate of C_31 times l_x.

    Args:
        theta: pitch θ, rad.
        phi: roll φ, rad.
        omega: ω_x, ω_y, ω_z of the body, rad/s, shape (3,).
        lever: lever arm l_x, l_y, l_z, m, shape (3,).

    Returns:
        Upward velocity relative to the reference point, m/s.
    """
    s_theta, c_theta, s_phi, c_phi = abbreviations(theta, phi)
    omega_x, omega_y, omega_z = np.asarray(omega, np.float64)
    l_x, l_y, l_z = np.asarray(lever, np.float64)
    printed = (
        -s_theta * (omega_y * l_z - omega_z * l_y)
        - c_theta * s_phi * omega_x * l_z
        + c_theta * c_phi * omega_x * l_y
    )
    return float(printed - c_theta * (c_phi * omega_y - s_phi * omega_z) * l_x)


def measured_height(
    r_zp: float, theta: float, phi: float, lever: npt.ArrayLike, e_rz: float = 0.0
) -> float:
    """Compute what GPS reads as height.

    Equation:
        (6.41) y_rz = r_zp + c_θ (s_φ l_y + c_φ l_z) + e_rz, as printed if l_x = 0; see (6.39).

    Args:
        r_zp: height of the reference point, m.
        theta: pitch θ, rad.
        phi: roll φ, rad.
        lever: lever arm l_x, l_y, l_z, m, shape (3,).
        e_rz: noise, m.

    Returns:
        y_rz, m.
    """
    return r_zp + antenna_offset(theta, phi, lever) + e_rz


def measured_velocity(
    v_zp: float,
    theta: float,
    phi: float,
    omega: npt.ArrayLike,
    lever: npt.ArrayLike,
    e_vz: float = 0.0,
) -> float:
    """Compute what GPS reads as vertical velocity.

    Equation:
        (6.42) y_vz = v_zp + s_θ (ω_z l_y - ω_y l_z) + c_θ ω_x (c_φ l_y - s_φ l_z) + e_vz, as
        printed if l_x = 0; see (6.40).

    Args:
        v_zp: vertical velocity of the reference point, m/s.
        theta: pitch θ, rad.
        phi: roll φ, rad.
        omega: ω_x, ω_y, ω_z of the body, rad/s, shape (3,).
        lever: lever arm l_x, l_y, l_z, m, shape (3,).
        e_vz: noise, m/s.

    Returns:
        y_vz, m/s.
    """
    return v_zp + antenna_velocity(theta, phi, omega, lever) + e_vz
