"""6.4.2 Rate Gyroscopes."""

import numpy as np

from floatref_reference.signals import PI, Real

N_A = 7.56e-4
"""Angle random walk of the rate gyroscope, deg/√s (6.54)."""
R_A = 1.03e-7
"""Its ramp instability, deg/s² (6.55)."""
K_A = 1.38e-6
"""Its rate random walk, deg/s^(3/2) (6.55)."""


def per_root_hour(n_a: Real) -> np.longdouble:
    """Convert the angle random walk to its other customary unit.

    Equation:
        (6.54) 7.56e-4 deg/√s = 0.0454 deg/√h, that is times √3600

    Args:
        n_a: N_A, deg/√s.

    Returns:
        N_A, deg/√h.
    """
    return 60 * np.longdouble(n_a)


def spectral_density(f: Real, r_a: Real = R_A, k_a: Real = K_A, n_a: Real = N_A) -> np.longdouble:
    """Compute the spectral density of the rate that a gyroscope at rest reads.

    Equation:
        (6.56) S_Ω(2πf) = R_A²/(2πf)³ + K_A²/(2πf)² + N_A², by default with (6.54) and (6.55).
        The text calls it one-sided; with coefficients as in (6.53) it is the two-sided density,
        and the one-sided is twice that.

    Args:
        f: frequency, Hz, positive.
        r_a: ramp instability R_A, deg/s² for a density in the unit below.
        k_a: rate random walk K_A, deg/s^(3/2).
        n_a: angle random walk N_A, deg/√s.

    Returns:
        S_Ω, two-sided, deg²/s.
    """
    omega = 2 * PI * np.longdouble(f)
    ramp, walk = np.longdouble(r_a) ** 2 / omega**3, np.longdouble(k_a) ** 2 / omega**2
    return np.longdouble(ramp + walk + np.longdouble(n_a) ** 2)
