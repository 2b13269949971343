"""6.6.3 Kalman Smoother with Height-Sensor Reflection."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import State, Vector
from floatref_reference.chapter_6.section_6_3_4_gps_height import measured_height
from floatref_reference.chapter_6.section_6_4_4_tuning import SIGMA_GPS
from floatref_reference.chapter_6.section_6_5_implementation import Observation, Observe
from floatref_reference.chapter_6.section_6_6_2_gps import observed_at, readings_by_step

V_0 = 0.16 / 3.6
"""Speed below which the mode is "stopped", m/s: 0.16 km/h."""
SIGMA_H = 0.0015
"""σ_h of one height-sensor reading, m (6.60)."""
FACTOR = 10.0
"""By what σ_vz and σ_θ grow in the stopped mode."""
NAN = float("nan")


class References(NamedTuple):
    """Readings from which a stop counts; NaN until there is one.

    Equation:
        (6.58) and (6.61): the last ones obtained before the stopped mode.

    Attributes:
        y_rz: y_rz,ref, m.
        y_vz: y_vz,ref, m/s.
        h: h_ref, printed as y_h,ref, m.
    """

    y_rz: float = NAN
    y_vz: float = NAN
    h: float = NAN

    @property
    def complete(self) -> bool:
        """Whether (6.58) can be applied; without y_vz,ref the velocity goes unobserved."""
        return not np.isnan([self.y_rz, self.h]).any()

    def updated(self, y: Vector | None, h: float) -> "References":
        """Take over what step k read; NaN leaves a reading as it was.

        Equation:
            (6.58) and (6.61), for the stop that the next step may begin.

        Args:
            y: GPS reading in the order of (C.7), None if it is missing.
            h: height-sensor reading, m, NaN if it is missing.

        Returns:
            The last readings of each.
        """
        y_rz, y_vz = (NAN, NAN) if y is None else (float(y[0]), float(y[1]))
        new = zip(self, (y_rz, y_vz, h), strict=True)
        return References(*(old if np.isnan(value) else value for old, value in new))


def reflected_height(h: float, y_rz_ref: float, h_ref: float) -> float:
    """Compute the height that replaces that of GPS at a stop.

    Equation:
        (6.58) y_rz,k = y_rz,ref + (h_k - h_ref). Printed with h_ref - h_k; at a stop the road
        under the sensor does not change, so that r_zp and h rise together and cancel in (6.57).

    Args:
        h: height-sensor reading h_k, m.
        y_rz_ref: last GPS height before the stopped mode, m.
        h_ref: last height-sensor reading before it, m.

    Returns:
        y_rz,k, m.
    """
    return y_rz_ref + (h - h_ref)


def height_reading(
    x: npt.ArrayLike, lever: npt.ArrayLike, y_rz_ref: float, h_ref: float, e_h: float = 0.0
) -> float:
    """Compute what the height sensor reads at a stop.

    Equation:
        (6.59) h_k = r_zp,k + c_θ (s_φ l_y + c_φ l_z) - y_rz,ref + h_ref + e_h,k, see (6.41).
        Printed with + y_rz,ref, which is (6.58) solved for h_k with neither sign.

    Args:
        x: state of (C.2), shape (7,).
        lever: lever arm l_x, l_y, l_z of the antenna, m, shape (3,).
        y_rz_ref: last GPS height before the stopped mode, m.
        h_ref: last height-sensor reading before it, m.
        e_h: noise of the height sensor, m.

    Returns:
        h_k, m.
    """
    state = State(*np.asarray(x, np.float64))
    antenna = measured_height(state.r_zp, state.theta, state.phi, lever)
    return antenna - y_rz_ref + h_ref + e_h


def stopped(v: npt.ArrayLike, v_0: float = V_0) -> npt.NDArray[np.bool_]:
    """Find the time steps of the stopped mode.

    Equation:
        Section 6.6.3: speed below 0.16 km/h.

    Args:
        v: speed, m/s, shape (N,).
        v_0: threshold, m/s.

    Returns:
        Whether each step is in the stopped mode, shape (N,).
    """
    return np.asarray(v, np.float64) < v_0


def stopped_variances(
    sigma: npt.ArrayLike = SIGMA_GPS, sigma_h: float = SIGMA_H, factor: float = FACTOR
) -> Vector:
    """Compute the variances of the measurements in the stopped mode.

    Equation:
        (6.60) σ_h for σ_rz, and section 6.6.3: σ_vz and σ_θ times 10, σ_φ as it was.

    Args:
        sigma: σ_rz, σ_vz, σ_θ, σ_φ when not stopped, shape (4,).
        sigma_h: σ_h of a height-sensor reading, m.
        factor: by what σ_vz and σ_θ grow.

    Returns:
        The four variances, shape (4,).
    """
    _, sigma_vz, sigma_theta, sigma_phi = np.asarray(sigma, np.float64)
    return np.array([sigma_h, factor * sigma_vz, factor * sigma_theta, sigma_phi]) ** 2


def height_sensor_reflection(
    steps: npt.ArrayLike,
    y: npt.ArrayLike,
    h: npt.ArrayLike,
    fresh: npt.ArrayLike,
    v: npt.ArrayLike,
    sigma: npt.ArrayLike = SIGMA_GPS,
    sigma_h: float = SIGMA_H,
    factor: float = FACTOR,
    v_0: float = V_0,
) -> Observe:
    """Observe by GPS, and by the height sensor while stopped.

    Equation:
        (6.48) with GPS readings while not stopped; (6.58), (6.60) and (6.61) with y_θ = y_φ = 0 at
        each new height-sensor reading while stopped, GPS then being ignored. A stop that nothing
        was read before, as at the start of a run, goes on with GPS until y_rz and h have been
        read; they are its references from the next step on.

    Args:
        steps: time steps k of the GPS readings, increasing, shape (M,).
        y: y_rz in m, y_vz in m/s, y_θ and y_φ in rad, NaN where one is missing, shape (M, 4).
        h: height-sensor reading, m, shape (N,).
        fresh: whether it is new at this step, shape (N,).
        v: speed, m/s, shape (N,).
        sigma: standard deviations of GPS, shape (4,).
        sigma_h: σ_h of a height-sensor reading, m.
        factor: by what σ_vz and σ_θ grow while stopped.
        v_0: speed below which the mode is "stopped", m/s.

    Returns:
        What `kalman_filter` asks at each step.
    """
    gps, at_rest = readings_by_step(steps, y, sigma), stopped(v, v_0)
    h_k = np.where(np.asarray(fresh, bool), np.asarray(h, np.float64), NAN)
    R = stopped_variances(sigma, sigma_h, factor)
    observations: dict[int, Observation] = {}
    last = reference = References()
    for k in range(len(h_k)):
        if not at_rest[k]:
            reference = References()
        elif not reference.complete:
            reference = last
        if at_rest[k] and reference.complete:
            if not np.isnan(h_k[k]):
                y_rz = reflected_height(h_k[k], reference.y_rz, reference.h)
                observations[k] = np.array([y_rz, reference.y_vz, 0.0, 0.0]), R
        elif k in gps:
            observations[k] = gps[k]
        last = last.updated(gps[k][0] if k in gps else None, h_k[k])
    return observed_at(observations)
