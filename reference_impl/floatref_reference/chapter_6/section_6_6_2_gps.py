"""6.6.1 Kalman Filter and 6.6.2 Kalman Smoother: GPS observes all four measurements."""

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import Vector
from floatref_reference.chapter_6.section_6_4_4_tuning import SIGMA_GPS
from floatref_reference.chapter_6.section_6_5_implementation import Observation, Observe


def readings_by_step(
    steps: npt.ArrayLike, y: npt.ArrayLike, sigma: npt.ArrayLike = SIGMA_GPS
) -> dict[int, Observation]:
    """Arrange the readings of GPS by the time step at which they came.

    Equation:
        (6.48) for y_k and (C.10) for its variances.

    Args:
        steps: time steps k of the readings, increasing, shape (M,).
        y: y_rz in m, y_vz in m/s, y_θ and y_φ in rad, NaN where one is missing, shape (M, 4).
        sigma: their standard deviations, shape (4,) or, one row per reading, (M, 4).

    Returns:
        Readings and variances by step.
    """
    y_m = np.asarray(y, np.float64).reshape(-1, 4)
    variances = np.broadcast_to(np.asarray(sigma, np.float64) ** 2, y_m.shape)
    return {int(k): (y_m[m], variances[m]) for m, k in enumerate(np.asarray(steps))}


def observed_at(observations: Mapping[int, Observation]) -> Observe:
    """Make observations that do not depend on the state known to the Kalman filter.

    Equation:
        (6.16) at the steps without an observation.

    Args:
        observations: observations by step.

    Returns:
        What `kalman_filter` asks at each step.
    """

    def observe(k: int, x: Vector) -> Observation | None:
        return observations.get(k)

    return observe


def gps_observations(
    steps: npt.ArrayLike, y: npt.ArrayLike, sigma: npt.ArrayLike = SIGMA_GPS
) -> Observe:
    """Observe height, vertical velocity, pitch and roll whenever GPS gives them.

    Equation:
        (6.48) at the steps with a reading, (6.16) at the others.

    Args:
        steps: time steps k of the readings, increasing, shape (M,).
        y: y_rz in m, y_vz in m/s, y_θ and y_φ in rad, NaN where one is missing, shape (M, 4).
        sigma: their standard deviations, shape (4,) or (M, 4); those of Table 6.1 by default.

    Returns:
        What `kalman_filter` asks at each step.
    """
    return observed_at(readings_by_step(steps, y, sigma))
