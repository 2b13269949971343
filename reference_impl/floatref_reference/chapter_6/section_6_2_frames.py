"""6.2 Coordinate Reference Frames."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import Matrix, Vector, abbreviations


def direction_cosines(psi: float, theta: float, phi: float) -> Matrix:
    """Compute the matrix that resolves a vector of the body frame in the navigation frame.

    Equation:
        (6.23) a^n = C^nb a^b; rotations in the order yaw, pitch, roll.

    Args:
        psi: yaw ψ, rad.
        theta: pitch θ, rad, positive nose down.
        phi: roll φ, rad, positive left side up.

    Returns:
        C^nb, shape (3, 3).
    """
    s_theta, c_theta, s_phi, c_phi = abbreviations(theta, phi)
    s_psi, c_psi = float(np.sin(psi)), float(np.cos(psi))
    return np.array(
        [
            [
                c_psi * c_theta,
                c_psi * s_theta * s_phi - s_psi * c_phi,
                c_psi * s_theta * c_phi + s_psi * s_phi,
            ],
            [
                s_psi * c_theta,
                s_psi * s_theta * s_phi + c_psi * c_phi,
                s_psi * s_theta * c_phi - c_psi * s_phi,
            ],
            [-s_theta, c_theta * s_phi, c_theta * c_phi],
        ]
    )


def in_body_frame(a_n: npt.ArrayLike, C_nb: Matrix) -> Vector:
    """Resolve a vector of the navigation frame in the body frame.

    Equation:
        (6.24) a^b = (C^nb)ᵀ a^n

    Args:
        a_n: vector in the navigation frame, shape (3,).
        C_nb: direction cosines C^nb, shape (3, 3).

    Returns:
        a^b, shape (3,).
    """
    return C_nb.T @ np.asarray(a_n, np.float64)


def direction_cosine_rates(C_nb: Matrix, omega: npt.ArrayLike) -> Matrix:
    """Compute how fast the direction cosines change.

    Equation:
        (6.26) dC^nb/dt = C^nb Ω, with the skew symmetric Ω of the rates in (6.25)

    Args:
        C_nb: direction cosines C^nb, shape (3, 3).
        omega: ω_x, ω_y, ω_z of the body, rad/s, shape (3,).

    Returns:
        dC^nb/dt, 1/s, shape (3, 3).
    """
    omega_x, omega_y, omega_z = np.asarray(omega, np.float64)
    skew = [[0, -omega_z, omega_y], [omega_z, 0, -omega_x], [-omega_y, omega_x, 0]]
    return C_nb @ np.array(skew)


def pitch_rate(phi: float, omega_y: float, omega_z: float) -> float:
    """Compute how fast the pitch angle changes.

    Equation:
        (6.27) dθ/dt = c_φ ω_y - s_φ ω_z

    Args:
        phi: roll φ, rad.
        omega_y: rate about the body's Y, rad/s.
        omega_z: rate about the body's Z, rad/s.

    Returns:
        dθ/dt, rad/s.
    """
    return float(np.cos(phi) * omega_y - np.sin(phi) * omega_z)


def roll_rate(theta: float, phi: float, omega: npt.ArrayLike) -> float:
    """Compute how fast the roll angle changes.

    Equation:
        (6.28) dφ/dt = ω_x + s_θ (s_φ ω_y + c_φ ω_z) / c_θ

    Args:
        theta: pitch θ, rad.
        phi: roll φ, rad.
        omega: ω_x, ω_y, ω_z of the body, rad/s, shape (3,).

    Returns:
        dφ/dt, rad/s.
    """
    s_theta, c_theta, s_phi, c_phi = abbreviations(theta, phi)
    omega_x, omega_y, omega_z = np.asarray(omega, np.float64)
    return float(omega_x + s_theta * (s_phi * omega_y + c_phi * omega_z) / c_theta)
