"""6.6.4 Kalman Smoother with a Constant Attitude Reference."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import Matrix
from floatref_reference.chapter_6.section_6_4_4_tuning import DEGREE, SIGMA_GPS
from floatref_reference.chapter_6.section_6_5_implementation import Observe
from floatref_reference.chapter_6.section_6_6_3_reflection import (
    FACTOR,
    V_0,
    height_sensor_reflection,
)

SIGMA_THETA = 5 * DEGREE
"""σ_θ, rad (6.63)."""
SIGMA_PHI = 2 * DEGREE
"""σ_φ, rad (6.63)."""
SIGMA_H = 0.07
"""σ_h of one height-sensor reading, m (6.64)."""
SIGMA = (SIGMA_GPS[0], SIGMA_GPS[1], SIGMA_THETA, SIGMA_PHI)
"""Those of Table 6.1 for y_rz and y_vz, and (6.63)."""


def level(y: npt.ArrayLike) -> Matrix:
    """Put zeros in the place of the attitude that GPS reads.

    Equation:
        (6.62) y_θ,k = 0, y_φ,k = 0

    Args:
        y: GPS readings in the order of (C.7), shape (M, 4); y_θ and y_φ are not looked at.

    Returns:
        y_rz and y_vz as they were, and zeros, shape (M, 4).
    """
    y_m = np.array(y, dtype=np.float64).reshape(-1, 4)
    y_m[:, 2:] = 0.0
    return y_m


def constant_attitude(
    steps: npt.ArrayLike,
    y: npt.ArrayLike,
    h: npt.ArrayLike,
    fresh: npt.ArrayLike,
    v: npt.ArrayLike,
    sigma: npt.ArrayLike = SIGMA,
    sigma_h: float = SIGMA_H,
    factor: float = FACTOR,
    v_0: float = V_0,
) -> Observe:
    """Observe height and vertical velocity by GPS, and a level attitude along with them.

    Equation:
        (6.62), (6.63), with height-sensor reflection (6.58) to (6.61) at (6.64) while stopped.

    Args:
        steps: time steps k of the GPS readings, increasing, shape (M,).
        y: y_rz in m, y_vz in m/s and two columns that are not looked at, shape (M, 4).
        h: height-sensor reading, m, shape (N,).
        fresh: whether it is new at this step, shape (N,).
        v: speed, m/s, shape (N,).
        sigma: σ_rz, σ_vz, σ_θ, σ_φ while not stopped, shape (4,).
        sigma_h: σ_h of a height-sensor reading, m.
        factor: by what σ_vz and σ_θ grow while stopped.
        v_0: speed below which the mode is "stopped", m/s.

    Returns:
        What `kalman_filter` asks at each step.
    """
    return height_sensor_reflection(
        steps, level(y), h, fresh, v, sigma, sigma_h=sigma_h, factor=factor, v_0=v_0
    )
