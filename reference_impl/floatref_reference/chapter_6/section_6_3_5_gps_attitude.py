"""6.3.5 GPS Pitch and Roll."""

import numpy as np

from floatref_reference.appendix_c.symbols import abbreviations


def pitch_inclination(theta: float) -> float:
    """Compute the inclination of the body's X-axis as GPS gives it.

    Equation:
        (6.43) θ_gps = θ, positive nose down. The text has it positive with the forward antenna
        above the master antenna, which is -θ.

    Args:
        theta: pitch θ, rad.

    Returns:
        θ_gps, rad.
    """
    return theta


def roll_inclination(theta: float, phi: float) -> float:
    """Compute the inclination of the body's Y-axis as GPS gives it.

    Equation:
        (6.44) φ_gps = sin⁻¹(c_θ s_φ), positive left side up. The text has it positive with the
        antenna on the right above the master antenna, which is the opposite.

    Args:
        theta: pitch θ, rad.
        phi: roll φ, rad.

    Returns:
        φ_gps, rad.
    """
    _, c_theta, s_phi, _ = abbreviations(theta, phi)
    return float(np.arcsin(c_theta * s_phi))


def measured_pitch(theta: float, e_theta: float = 0.0) -> float:
    """Compute what GPS reads as pitch.

    Equation:
        (6.45) y_θ = θ + e_θ

    Args:
        theta: pitch θ, rad.
        e_theta: noise, rad.

    Returns:
        y_θ, rad.
    """
    return pitch_inclination(theta) + e_theta


def measured_roll(theta: float, phi: float, e_phi: float = 0.0) -> float:
    """Compute what GPS reads as roll.

    Equation:
        (6.46) y_φ = sin⁻¹(c_θ s_φ) + e_φ

    Args:
        theta: pitch θ, rad.
        phi: roll φ, rad.
        e_phi: noise, rad.

    Returns:
        y_φ, rad.
    """
    return roll_inclination(theta, phi) + e_phi
