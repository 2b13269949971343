"""Longitudinal acceleration from an encoder's distance, under a Gaussian, without phase."""

import math

import numpy as np
import numpy.typing as npt

from floatref_reference.road_prior.pitch import pitch_response
from floatref_reference.road_prior.symbols import Vector

SIGMA = 0.03
REACH = 4.0


def weights(dt: float) -> Vector:
    """Compute what the distances about a sample add to the acceleration there.

    Equation:
        w_j = C e^{-t_j²/(2S²)} (t_j² - m) at t_j = jΔt, |t_j| ≤ 4 S, S = 0.03 s: m the mean of
        t_j² under the Gaussian, so that they sum to 0, and C so that Σ w_j t_j² = 2

    Args:
        dt: Δt, s.

    Returns:
        The weights from the earliest to the latest, 1/s², shape (2n + 1,).
    """
    n = max(1, round(REACH * SIGMA / dt))
    t = [j * dt for j in range(-n, n + 1)]
    bell = [math.exp(-(tau**2) / (2 * SIGMA**2)) for tau in t]
    m = sum(b * tau**2 for b, tau in zip(bell, t, strict=True)) / sum(bell)
    w = [b * (tau**2 - m) for b, tau in zip(bell, t, strict=True)]
    scale = sum(each * tau**2 for each, tau in zip(w, t, strict=True))
    return np.array([2 * each / scale for each in w])


def acceleration(distance: npt.ArrayLike, dt: float) -> Vector:
    """Compute the longitudinal acceleration at all samples.

    Equation:
        a_x = Σ_j w_j X_{k+j}; before the start and behind the end the distances are turned about
        the first and the last one, X_{-j} = 2 X_0 - X_j

    Args:
        distance: X, m, shape (N,), N more than half of the weights.
        dt: Δt, s.

    Returns:
        a_x, m/s², shape (N,).

    Raises:
        ValueError: if the run is shorter than the weights reach.
    """
    x, w = [float(value) for value in np.asarray(distance, np.float64)], weights(dt)
    n = len(w) // 2
    if len(x) <= n:
        raise ValueError(f"{len(x)} distances, but the weights reach over {n} to either side")
    before = [2 * x[0] - x[j] for j in range(n, 0, -1)]
    behind = [2 * x[-1] - x[-1 - j] for j in range(1, n + 1)]
    extended = np.array([*before, *x, *behind])
    return np.array([math.fsum(w * extended[k : k + 2 * n + 1]) for k in range(len(x))])


def inputs(
    distance: npt.ArrayLike, dt: float, f_p: float = 1.6, zeta: float = 0.3
) -> tuple[Vector, Vector]:
    """Form what the lean and the tilt of the vehicle multiply.

    Equation:
        u_1 = a_x and u_2 = a_x θ̂, the response θ̂ starting from rest one step before the first
        sample, where a_x = 0

    Args:
        distance: X, m, shape (N,).
        dt: Δt, s.
        f_p: natural frequency of the pitch response, Hz.
        zeta: its damping ratio.

    Returns:
        u_1 and u_2, m/s² and m²/s⁴, shape (N,) each.
    """
    a_x = acceleration(distance, dt)
    times = dt * np.arange(-1, len(a_x))
    response = pitch_response(np.append(0.0, a_x), times, f_p, zeta, 0.0)[1:]
    return a_x, a_x * response
