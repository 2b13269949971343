"""4.3 The Influence of the Vehicle Speed, and the error of Table 2."""

import math

import numpy as np
import numpy.typing as npt


def calculation_rate(v: float) -> float:
    """Choose the rate of the calculation, so that a step is as long in distance at any speed.

    Equation:
        Section 4.3: f = 20 v, printed 1/20v; 200 Hz at 10 m/s and 400 Hz at 20 m/s, 0.05 m a step.

    Args:
        v: speed, m/s.

    Returns:
        f, Hz.

    Raises:
        ValueError: unless the vehicle drives forward.
    """
    if not v > 0:
        raise ValueError(f"at {v} m/s there is no rate of calculation")
    return 20.0 * v


def error(u_hat: npt.ArrayLike, u: npt.ArrayLike) -> float:
    """Compute by how much an estimated road differs from the true one.

    Equation:
        Table 2: the error in per cent. How it is made relative is not printed;
        100 ‖û - u‖/‖u‖ here.

    Args:
        u_hat: estimated road û, m, shape (N,).
        u: true road, m, shape (N,).

    Returns:
        Error, %.
    """
    of_difference = of_road = 0.0
    pairs = zip(np.asarray(u_hat, np.float64), np.asarray(u, np.float64), strict=True)
    for u_hat_k, u_k in pairs:
        of_difference += float(u_hat_k - u_k) ** 2
        of_road += float(u_k) ** 2
    return 100 * math.sqrt(of_difference / of_road)
