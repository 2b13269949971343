"""The half car that pitches over the road under its wheels, and what its accelerometer reads.

`floatref_reference.beyond.laser_place` derives the equations. Only the axles' places are known of
a vehicle; all else is usual.
"""

from typing import NamedTuple

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.axle_setup import AxleSetup

STATES, BODY = 10, 4
HEAVE, PITCH = 0, 1
"""Heave and pitch in m and rad, wheels, rates of all four, disturbances of front and rear axle."""
SPRING = 63.3
DAMPER = 6.0
TYRE = 653.0
WHEEL = 0.15
"""The golden car of the IRI (2.1.1), over the mass that an axle carries: 1/s², 1/s, 1/s², 1."""
DYNAMIC_INDEX = 0.8
"""k²/(ab) of the body; 1 would decouple the axles. Passenger cars and vans have 0.7 to 1."""
BRAKE_ARM_M = 0.6
"""Height of the centre of gravity, 0.5 to 0.9 m, less what the links of the suspension carry."""
DISTURBANCE = 0.3
DISTURBED_HZ = 1.0
"""What the usual vehicle is wrong by: acceleration in m/s² of each axle's share of the body, with
the frequency of its bounce. The body's own is 0.5 to 1.5 m/s²."""
READING = 0.03
"""1-σ of what the accelerometer is wrong by in the pitch's frequencies, in m/s²."""


class HalfCar(NamedTuple):
    """x' = A x + B u, and the accelerometer's reading H x + D u.

    Inputs are the road under front and rear wheels in m and the acceleration along the road in
    m/s².

    Attributes:
        dynamics: A, shape (10, 10).
        inputs: B, shape (10, 3).
        reading: H, shape (10,).
        direct: D, shape (3,).
    """

    dynamics: FloatArray
    inputs: FloatArray
    reading: FloatArray
    direct: FloatArray

    @classmethod
    def usual(cls, axles: AxleSetup, accelerometer_m: float) -> "HalfCar":
        """Return the usual half car on ``axles``, its centre of gravity between them.

        ``accelerometer_m`` is its accelerometer's place ahead of the vehicle point.
        """
        half = 0.5 * axles.wheelbase_m
        inertia = DYNAMIC_INDEX * half**2
        lines = np.array([[1.0, half], [1.0, -half]])
        pull = 0.5 * np.vstack([lines[:, 0], lines[:, 1] / inertia])
        springs, dampers = (np.hstack([-x * lines, x * np.eye(2)]) for x in (SPRING, DAMPER))
        a, b = np.zeros((STATES, STATES)), np.zeros((STATES, 3))
        a[:BODY, BODY : 2 * BODY] = np.eye(BODY)
        a[BODY : BODY + 2] = pull @ np.hstack([springs, dampers, np.eye(2)])
        wheels = slice(BODY + 2, 2 * BODY)
        a[wheels, : 2 * BODY] = np.hstack([-springs, -dampers]) / WHEEL
        a[wheels, 2:BODY] -= np.eye(2) * TYRE / WHEEL
        a[2 * BODY :, 2 * BODY :] = -2.0 * np.pi * DISTURBED_HZ * np.eye(2)
        b[wheels, :2] = np.eye(2) * TYRE / WHEEL
        b[BODY + PITCH, 2] = BRAKE_ARM_M / inertia
        ahead = accelerometer_m - axles.front_axle_m + half
        at = np.array([1.0, ahead])
        return cls(a, b, at @ a[BODY : BODY + 2], at @ b[BODY : BODY + 2])

    def at_rest(self, u: FloatArray) -> FloatArray:
        """Return the state at rest under constant inputs ``u``, shape (3,)."""
        moving, held = slice(BODY, 2 * BODY), slice(0, BODY)
        x = np.zeros(STATES)
        x[held] = -np.linalg.solve(self.dynamics[moving, held], self.inputs[moving] @ u)
        return x


class Gains(NamedTuple):
    """What the smoother of constant gain multiplies by, for samples a step apart.

    Attributes:
        transition: Φ, shape (10, 10).
        before, now: of the inputs at both ends of the step, shape (10, 3).
        filter: K, shape (10,).
        smoother: C, shape (10, 10).
    """

    transition: FloatArray
    before: FloatArray
    now: FloatArray
    filter: FloatArray
    smoother: FloatArray

    @classmethod
    def of(cls, car: HalfCar, step: float) -> "Gains":
        """Return the gains for readings every ``step`` s."""
        from scipy.linalg import solve_discrete_are

        phi, before, now = _discretize(car, step)
        decay = np.exp(-4.0 * np.pi * DISTURBED_HZ * step)
        driven = np.append(np.zeros(2 * BODY), np.full(2, DISTURBANCE**2 * (1.0 - decay)))
        h, r = car.reading, READING**2
        p = solve_discrete_are(phi.T, h[:, np.newaxis], np.diag(driven), np.array([[r]]))
        gain = p @ h / (h @ p @ h + r)
        after = p - np.outer(gain, h @ p)
        back = after @ phi.T @ np.linalg.pinv(p, hermitian=True)
        return cls(phi, before, now, gain, np.ascontiguousarray(back))


def _discretize(car: HalfCar, step: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return Φ and the shares of the inputs before and now, which are linear in between."""
    from scipy.linalg import expm

    n, m = car.inputs.shape
    wide = np.zeros((n + 2 * m, n + 2 * m))
    wide[:n, :n], wide[:n, n : n + m] = car.dynamics * step, car.inputs * step
    wide[n : n + m, n + m :] = np.eye(m)
    found = expm(wide)
    now = found[:n, n + m :]
    phi, before = found[:n, :n], found[:n, n : n + m] - now
    return np.ascontiguousarray(phi), before, np.ascontiguousarray(now)
