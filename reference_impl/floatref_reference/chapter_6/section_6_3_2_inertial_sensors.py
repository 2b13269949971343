"""6.3.1 Angular Rate and 6.3.2 Linear Acceleration: what the inertial sensors read."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import Matrix, Vector, abbreviations
from floatref_reference.chapter_6.section_6_2_frames import in_body_frame
from floatref_reference.signals import STANDARD_GRAVITY

G = float(STANDARD_GRAVITY)
G_N: Vector = np.array([0.0, 0.0, -G])
"""Gravity g^n in the navigation frame, m/s²."""


def measured_rate(
    omega: npt.ArrayLike, delta: npt.ArrayLike = 0.0, e: npt.ArrayLike = 0.0
) -> Vector:
    """Compute what the gyroscopes read.

    Equation:
        (6.30) u_ω = ω - δ_ω - e_ω: δ_ω is what has to be added to a reading, that is minus the
        bias, whereas in (6.32) δ_a^b is the bias itself.

    Args:
        omega: true rate, rad/s, any shape.
        delta: δ_ω, rad/s.
        e: noise e_ω, rad/s.

    Returns:
        u_ω, rad/s.
    """
    return np.asarray(omega, np.float64) - np.asarray(delta, np.float64) - np.asarray(e, np.float64)


def specific_force(a_n: npt.ArrayLike, C_nb: Matrix) -> Vector:
    """Compute the specific force in the body frame.

    Equation:
        (6.33) f^b = C^bn (a^n - g^n), with g^n = (0, 0, -g)

    Args:
        a_n: acceleration of the reference point in the navigation frame, m/s², shape (3,).
        C_nb: direction cosines C^nb, shape (3, 3).

    Returns:
        f^b, m/s², shape (3,); (0, 0, g) at rest and level.
    """
    return in_body_frame(np.asarray(a_n, np.float64) - G_N, C_nb)


def measured_acceleration(
    a_n: npt.ArrayLike, C_nb: Matrix, delta: npt.ArrayLike = 0.0, e: npt.ArrayLike = 0.0
) -> Vector:
    """Compute what the accelerometers read.

    Equation:
        (6.34) u_a = C^bn (a^n - g^n) + δ_a^b + e_a^b, which is (6.32) with (6.33)

    Args:
        a_n: acceleration of the reference point in the navigation frame, m/s², shape (3,).
        C_nb: direction cosines C^nb, shape (3, 3).
        delta: biases δ_a^b, m/s², shape (3,).
        e: noise e_a^b, m/s², shape (3,).

    Returns:
        u_a, m/s², shape (3,).
    """
    return specific_force(a_n, C_nb) + np.asarray(delta, np.float64) + np.asarray(e, np.float64)


def acceleration(
    u_a: npt.ArrayLike, C_nb: Matrix, delta: npt.ArrayLike = 0.0, e: npt.ArrayLike = 0.0
) -> Vector:
    """Compute the acceleration from what the accelerometers read.

    Equation:
        (6.35) a^n = C^nb (u_a - δ_a^b - e_a^b) + g^n

    Args:
        u_a: readings, m/s², shape (3,).
        C_nb: direction cosines C^nb, shape (3, 3).
        delta: biases δ_a^b, m/s², shape (3,).
        e: noise e_a^b, m/s², shape (3,).

    Returns:
        a^n, m/s², shape (3,).
    """
    f_b = np.asarray(u_a, np.float64) - np.asarray(delta, np.float64) - np.asarray(e, np.float64)
    return np.add(C_nb @ f_b, G_N)


def vertical_acceleration(
    u_a: npt.ArrayLike, theta: float, phi: float, delta_a: float = 0.0, e_a: float = 0.0
) -> float:
    """Resolve the accelerometers into the vertical.

    Equation:
        (6.37) a_zp = -s_θ u_ax + c_θ s_φ u_ay + c_θ c_φ u_az + δ_a + e_a - g, which is (6.36)
        written out. With the sign of (6.35), δ_a is minus the vertical part of the biases.

    Args:
        u_a: readings u_ax, u_ay, u_az, m/s², shape (3,).
        theta: pitch θ, rad.
        phi: roll φ, rad.
        delta_a: consolidated drift δ_a, m/s².
        e_a: consolidated noise e_a, m/s².

    Returns:
        a_zp, m/s².
    """
    s_theta, c_theta, s_phi, c_phi = abbreviations(theta, phi)
    u_ax, u_ay, u_az = np.asarray(u_a, np.float64)
    resolved = -s_theta * u_ax + c_theta * s_phi * u_ay + c_theta * c_phi * u_az
    return float(resolved + delta_a + e_a - G)
