"""6.6.5 Kalman Smoother with a Constant Height and Attitude Reference."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import State, Vector
from floatref_reference.chapter_6.section_6_3_4_gps_height import measured_height
from floatref_reference.chapter_6.section_6_5_implementation import Observation
from floatref_reference.chapter_6.section_6_6_3_reflection import (
    FACTOR,
    NAN,
    V_0,
    reflected_height,
    stopped,
    stopped_variances,
)
from floatref_reference.chapter_6.section_6_6_4_constant_attitude import (
    SIGMA_H,
    SIGMA_PHI,
    SIGMA_THETA,
)

SIGMA_RZ = 0.5
"""σ_rz, m (6.66)."""
SIGMA_VZ = 1.0
"""σ_vz, m/s (6.66)."""
SIGMA = (SIGMA_RZ, SIGMA_VZ, SIGMA_THETA, SIGMA_PHI)


class ConstantHeightAndAttitude:
    """Observe zeros at every time step, and the height sensor while stopped.

    Equation:
        (6.65) y_rz,k = y_vz,k = y_θ,k = y_φ,k = 0 with (6.63) and (6.66) while not stopped; while
        stopped, (6.58) with (6.64) and zeros for the others at each new height-sensor reading.
        No GPS gives y_rz,ref, so it is the height that the filter predicts for the antenna at the
        first stopped step. h_ref is the last reading before it; if nothing was read before, the
        mode begins with the first reading.

    Called as `kalman_filter` does, at each step from 0 on, in order.
    """

    def __init__(
        self,
        h: npt.ArrayLike,
        fresh: npt.ArrayLike,
        v: npt.ArrayLike,
        lever: npt.ArrayLike,
        sigma: npt.ArrayLike = SIGMA,
        sigma_h: float = SIGMA_H,
        factor: float = FACTOR,
        v_0: float = V_0,
    ) -> None:
        """Prepare the observations of one run.

        Args:
            h: height-sensor reading, m, shape (N,).
            fresh: whether it is new at this step, shape (N,).
            v: speed, m/s, shape (N,).
            lever: lever arm l_x, l_y, l_z of the antenna, m, shape (3,).
            sigma: σ_rz, σ_vz, σ_θ, σ_φ while not stopped, shape (4,).
            sigma_h: σ_h of a height-sensor reading, m.
            factor: by what σ_vz and σ_θ grow while stopped.
            v_0: speed below which the mode is "stopped", m/s.
        """
        self.h = np.where(np.asarray(fresh, bool), np.asarray(h, np.float64), NAN)
        self.at_rest = stopped(v, v_0)
        self.lever = np.asarray(lever, np.float64)
        self.R = np.asarray(sigma, np.float64) ** 2
        self.R_stopped = stopped_variances(sigma, sigma_h, factor)
        self.h_last = self.h_ref = self.y_rz_ref = NAN

    def __call__(self, k: int, x: Vector) -> Observation | None:
        """Observe step k.

        Equation:
            (6.65), or (6.58) while stopped.

        Args:
            k: time step.
            x: x̂_{k|k-1}, shape (7,).

        Returns:
            Measurements and variances; None between height-sensor readings while stopped.
        """
        if k == 0:
            self.h_last = NAN
        self._refer(k, x)
        if not np.isnan(self.h[k]):
            self.h_last = self.h[k]
        if np.isnan(self.h_ref):
            return np.zeros(4), self.R
        if np.isnan(self.h[k]):
            return None
        y_rz = reflected_height(self.h[k], self.y_rz_ref, self.h_ref)
        return np.array([y_rz, 0.0, 0.0, 0.0]), self.R_stopped

    def _refer(self, k: int, x: Vector) -> None:
        """Take the references of a stop once there are any, and drop those of the last one."""
        if k == 0 or not self.at_rest[k]:
            self.h_ref = self.y_rz_ref = NAN
        if self.at_rest[k] and np.isnan(self.h_ref):
            state = State(*x)
            self.h_ref = self.h[k] if np.isnan(self.h_last) else self.h_last
            self.y_rz_ref = measured_height(state.r_zp, state.theta, state.phi, self.lever)
