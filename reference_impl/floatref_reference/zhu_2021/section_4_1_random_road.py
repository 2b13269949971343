"""4.1 Random Road Profile: the road, and the settings of the filter on it."""

import math

import numpy as np
import numpy.typing as npt

from floatref_reference.zhu_2021.symbols import Matrix, Vector

N_0 = 0.1
"""Reference wave number n_0, cycle/m."""
N_1 = 0.1
"""Lower cut-off n_1, cycle/m."""
CLASS_E = 4096e-6
"""G_q(n_0) of ISO 8608 class E, m³/cycle, its geometric mean; not printed."""
SPEED = 10.0
"""Speed of figures 2 to 5, m/s."""
SAMPLING_RATE = 200.0
"""Sampling rate at that speed, Hz."""

TABLE_2 = (8.84, 10.34, 7.61, 7.47, 7.39)
"""Table 2: error in per cent of five runs, on average 8.33."""

Q_OF_VELOCITIES = (1e-4, 1e-4, 1e-2, 1e-2, 1e-4)
"""First five of the diagonal of Q as printed, of ẏ_1 to ẏ_4 and θ̇."""
Q_OF_DISPLACEMENTS = (1e-8, 1e-8, 1e-7, 1e-7, 1e-8)
"""Last five of it, of y_1 to y_4 and θ."""
R_PRINTED = (1e-4, 1e-4, 1e-2, 1e-2, 1e-4)
"""Diagonal of R as printed."""
P_0_PRINTED = 5e-5
"""Every diagonal element of P_{0|-1} as printed."""


def road_spectrum(n: float, G_q: float = CLASS_E, W: float = 2.0) -> float:
    """Evaluate the spectral density of a road's elevation.

    Equation:
        (14) G_q(n) = G_q(n_0) (n/n_0)^-W

    Args:
        n: wave number, cycle/m.
        G_q: density at n_0, m³/cycle.
        W: exponent, dimensionless.

    Returns:
        G_q(n), m³/cycle, over n > 0.
    """
    return G_q * math.pow(n / N_0, -W)


def random_road(
    omega: npt.ArrayLike, dt: float, v: float = SPEED, G_q: float = CLASS_E, n_1: float = N_1
) -> Vector:
    """Pass white noise through a first-order low-pass filter.

    Equation:
        (15) u̇_r = -2π n_1 v u_r + 2π n_0 √G_q(n_0) v ω, exactly over each step. The noise ω has
        a density of 1 over the wave number: over n_1 the road then has the spectrum (14) at any
        speed, and all in all the variance π n_0² G_q(n_0)/(2 n_1).

    Args:
        omega: independent draws from the standard normal distribution, shape (N,).
        dt: time step, s.
        v: speed, m/s.
        G_q: density at n_0, m³/cycle.
        n_1: lower cut-off, cycle/m.

    Returns:
        u_r, m, shape (N,), stationary from its first sample on.
    """
    draws = np.asarray(omega, np.float64)
    keep = math.exp(-2 * math.pi * n_1 * v * dt)
    deviation = math.sqrt(math.pi * N_0**2 * G_q / (2 * n_1))
    u_r = np.zeros(len(draws))
    u_r[0] = deviation * draws[0]
    for k in range(1, len(draws)):
        u_r[k] = keep * u_r[k - 1] + deviation * math.sqrt(1 - keep**2) * draws[k]
    return u_r


def printed_covariances() -> tuple[Matrix, Matrix, Matrix]:
    """Set up the filter as printed, in the order of (9).

    Equation:
        Section 4.1. The diagonal of Q is printed for velocities first, as X is listed after step
        (c); (9) has displacements first.

    Returns:
        Q, shape (10, 10), R, shape (5, 5), and P_{0|-1}, shape (10, 10).
    """
    Q = np.diag([*Q_OF_DISPLACEMENTS, *Q_OF_VELOCITIES])
    return Q, np.diag(R_PRINTED), P_0_PRINTED * np.eye(10)
