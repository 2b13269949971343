"""Beyond section 6.6.3: GPS velocity and attitude go on being observed at a stop.

(6.61) puts the last GPS velocity before the stop, and zeros for pitch and roll, in the place of all
later readings. Here nothing but the height of GPS is replaced. Both take (6.58) and (6.60).
"""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import Vector
from floatref_reference.chapter_6.section_6_4_4_tuning import SIGMA_GPS
from floatref_reference.chapter_6.section_6_5_implementation import Observation, Observe
from floatref_reference.chapter_6.section_6_6_2_gps import observed_at, readings_by_step
from floatref_reference.chapter_6.section_6_6_3_reflection import (
    NAN,
    SIGMA_H,
    V_0,
    References,
    reflected_height,
    stopped,
)


def reflection_beside_gps(
    steps: npt.ArrayLike,
    y: npt.ArrayLike,
    h: npt.ArrayLike,
    fresh: npt.ArrayLike,
    v: npt.ArrayLike,
    sigma: npt.ArrayLike = SIGMA_GPS,
    sigma_h: float = SIGMA_H,
    v_0: float = V_0,
) -> Observe:
    """Observe by GPS, but for the height while stopped, which the height sensor gives.

    Equation:
        (6.58) and (6.60) at each new height-sensor reading while stopped; y_vz, y_θ and y_φ of
        (6.48) as they come, in place of (6.61).

    Args:
        steps: time steps k of the GPS readings, increasing, shape (M,).
        y: y_rz in m, y_vz in m/s, y_θ and y_φ in rad, NaN where one is missing, shape (M, 4).
        h: height-sensor reading, m, shape (N,).
        fresh: whether it is new at this step, shape (N,).
        v: speed, m/s, shape (N,).
        sigma: standard deviations of GPS, shape (4,).
        sigma_h: σ_h of a height-sensor reading, m.
        v_0: speed below which the mode is "stopped", m/s.

    Returns:
        What `kalman_filter` asks at each step.
    """
    gps, at_rest = readings_by_step(steps, y, sigma), stopped(v, v_0)
    h_k = np.where(np.asarray(fresh, bool), np.asarray(h, np.float64), NAN)
    observations: dict[int, Observation] = {}
    last = reference = References()
    for k in range(len(h_k)):
        if not at_rest[k]:
            reference = References()
        elif not reference.complete:
            reference = last
        height = NAN
        if reference.complete and not np.isnan(h_k[k]):
            height = reflected_height(h_k[k], reference.y_rz, reference.h)
        if not reference.complete and k in gps:
            observations[k] = gps[k]
        elif reference.complete and (k in gps or not np.isnan(height)):
            observations[k] = _beside(gps.get(k), height, sigma_h)
        last = last.updated(gps[k][0] if k in gps else None, h_k[k])
    return observed_at(observations)


def _beside(gps: Observation | None, height: float, sigma_h: float) -> Observation:
    """Return the reading of GPS with the reflected height in place of its own."""
    y: Vector = np.full(4, NAN)
    variances = np.ones(4)
    if gps is not None:
        y[1:], variances[1:] = gps[0][1:], gps[1][1:]
    y[0], variances[0] = height, sigma_h**2
    return y, variances
