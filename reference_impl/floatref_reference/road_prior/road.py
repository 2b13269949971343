"""The road under one laser: its elevation and the slope of its long waves, in distance alone.

The road of (2.4) is white noise that is integrated once, for the slope, and twice, for the spatial
acceleration. Both are forgotten over the distance λ_p, so that they have a variance at the start:

    dz = (s - z/λ_p) dx + √q dW_q,  ds = -(s/λ_p) dx + √g dW_g.

What a noise at the distance τ behind adds to s it adds to z as well, τ times; and all of it has
decayed by e^{-τ/λ_p} since. So the new of a step is known by three integrals over it, I_0 to I_2.
"""

from math import exp, factorial

import numpy as np

from floatref_reference.road_prior.symbols import Constants, Matrix, Vector


def moments(dx: float, lambda_p: float) -> Vector:
    """Integrate the powers of a distance under the decay of a variance.

    Equation:
        I_n = ∫ τⁿ e^{-aτ} dτ over 0 ≤ τ ≤ ΔX with a = 2/λ_p, by parts with y = aΔX
        (n!/aⁿ⁺¹)(1 - e^{-y} Σ_{j≤n} yʲ/j!), which below y = 1 would cancel: as the exponential
        series is e^y, that bracket is e^{-y} Σ_{j>n} yʲ/j!, here to terms below rounding.

    Args:
        dx: ΔX, m.
        lambda_p: λ_p, m.

    Returns:
        I_0 in m, I_1 in m² and I_2 in m³, shape (3,): 0 exactly at ΔX = 0.
    """
    a, integrals = 2 / lambda_p, []
    y = a * dx
    for n in range(3):
        if y < 1:
            bracket = exp(-y) * sum(y**j / factorial(j) for j in range(n + 1, n + 20))
        else:
            bracket = 1 - exp(-y) * sum(y**j / factorial(j) for j in range(n + 1))
        integrals.append(factorial(n) / a ** (n + 1) * bracket)
    return np.array(integrals)


def road_transition(dx: float, c: Constants) -> Matrix:
    """Compute what becomes of elevation and slope after a distance.

    Equation:
        z ← α z + α ΔX s, s ← α s with α = e^{-ΔX/λ_p}: both as they were exactly at ΔX = 0

    Args:
        dx: ΔX = ∫V dt, m.
        c: constants.

    Returns:
        The transition of (z, s), shape (2, 2).
    """
    alpha = exp(-dx / c.lambda_p)
    return np.array([[alpha, alpha * dx], [0, alpha]])


def road_noise(dx: float, c: Constants) -> Matrix:
    """Compute the covariance of what is new after a distance.

    Equation:
        Q_zz = q I_0 + g I_2, Q_zs = g I_1, Q_ss = g I_0 with the I_n of `moments`

    Args:
        dx: ΔX = ∫V dt, m.
        c: constants.

    Returns:
        The covariance of (z, s), shape (2, 2): 0 exactly at ΔX = 0.
    """
    I_0, I_1, I_2 = moments(dx, c.lambda_p)
    return np.array([[c.q * I_0 + c.g * I_2, c.g * I_1], [c.g * I_1, c.g * I_0]])


def road_prior(c: Constants) -> Matrix:
    """Compute how far a road strays of which nothing is known.

    Equation:
        P_zz = q λ_p/2 + g λ_p³/4, P_zs = g λ_p²/4, P_ss = g λ_p/2: all that is new as ΔX → ∞

    Args:
        c: constants.

    Returns:
        The covariance of (z, s), shape (2, 2).
    """
    zz, zs, ss = c.q * c.lambda_p / 2 + c.g * c.lambda_p**3 / 4, c.g * c.lambda_p**2 / 4, c.g
    return np.array([[zz, zs], [zs, ss * c.lambda_p / 2]])
