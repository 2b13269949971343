"""The laser that is not under its accelerometer: a rigid body, and a half car that pitches.

The body is rigid: at a pitch θ, nose up positive, a laser l ahead of the accelerometer is higher
than it by l sin θ. Without a sensor of pitch, θ is that of a half car over the measured road whose
disturbing forces are found from the accelerometer, by a Kalman smoother of constant gain.
"""

from math import sin
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
STATES, BODY = 10, 4
"""Four coordinates, their rates, and the disturbing acceleration of each axle."""
TERMS = 20
"""Of the exponential's series, whose argument is halved until it is below one half."""
SETTLED = 1e-12
"""Largest relative change of the covariance by a step, in what counts as constant."""


class Axle(NamedTuple):
    """One axle: place ahead of the centre of gravity, share of the body's mass, and three rates.

    x in m; omega = √(k/m) in rad/s; damping c/m in 1/s; tyre k_t/m in 1/s²; wheel m_u/m; m is the
    axle's share of the body's mass.
    """

    x: float
    share: float
    omega: float
    damping: float
    tyre: float
    wheel: float


class HalfCar(NamedTuple):
    """Two axles, the dynamic index k²/(ab), and what of the centre's height brakes pitch by, in m.

    Attributes:
        front, rear: the axles.
        dynamic_index: squared radius of gyration over the product of the axles' distances a, b
            from the centre of gravity.
        arm: height of the centre of gravity in m, less what the links carry.
        disturbance, corner: standard deviation in m/s² of what the model misses at each axle, and
            the reciprocal of its time constant in 1/s.
        reading: standard deviation of the accelerometer's reading, in m/s².
    """

    front: Axle
    rear: Axle
    dynamic_index: float
    arm: float
    disturbance: float
    corner: float
    reading: float


def height_under_accelerometer(height: float, pitch: float, lever: float) -> float:
    """Return what the laser would read in the accelerometer's place, of the same point of the road.

    Equation:
        range = r + l sin θ - z, in which r is the accelerometer's height and z the road's
        elevation under the laser; hence r - z = range - l sin θ.
    """
    return height - lever * sin(pitch)


def equations(car: HalfCar) -> tuple[Array, Array]:
    """Return A, shape (10, 10), and B, shape (10, 3), of x' = A x + B u.

    Equation:
        State: heave z, pitch θ (nose up), wheels u_f, u_r, their rates, disturbances d_f, d_r.
        Inputs: road under front and rear wheels in m, acceleration along the road in m/s².
        With s_i the share of axle i, y_i = z + x_i θ and F_i = s_i(ω_i²(u_i - y_i) + c_i(u_i' -
        y_i') + d_i): z'' = F_f + F_r; I θ'' = x_f F_f + x_r F_r + h a, I = dynamic_index·x_f·|x_r|;
        m_i u_i'' = -(F_i - s_i d_i)/s_i + t_i (w_i - u_i); d_i' = -corner·d_i.
    """
    A, B = np.zeros((STATES, STATES)), np.zeros((STATES, 3))
    inertia = car.dynamic_index * car.front.x * abs(car.rear.x)
    for i in range(BODY):
        A[i, BODY + i] = 1.0
    for i, axle in enumerate((car.front, car.rear)):
        u, du, d = 2 + i, BODY + 2 + i, 8 + i
        force = np.zeros(STATES)
        force[u], force[0], force[1] = axle.omega**2, -(axle.omega**2), -(axle.omega**2) * axle.x
        force[du], force[4], force[5] = axle.damping, -axle.damping, -axle.damping * axle.x
        for k in range(STATES):
            A[4, k] += axle.share * force[k]
            A[5, k] += axle.share * axle.x / inertia * force[k]
            A[du, k] -= force[k] / axle.wheel
        A[4, d] += axle.share
        A[5, d] += axle.share * axle.x / inertia
        A[du, u] -= axle.tyre / axle.wheel
        B[du, i] += axle.tyre / axle.wheel
        A[d, d] = -car.corner
    B[5, 2] = car.arm / inertia
    return A, B


def reading_of(car: HalfCar, place: float) -> tuple[Array, Array]:
    """Return the vertical acceleration at ``place`` m ahead of the centre: of state and input.

    Equation:
        r'' = z'' + x θ'', both of which are rows of the equations of motion.
    """
    A, B = equations(car)
    return A[4] + place * A[5], B[4] + place * B[5]


def step_matrices(A: Array, B: Array, dt: float) -> tuple[Array, Array, Array]:
    """Return Φ, Γ_0, Γ_1 of x(t+Δt) = Φ x + Γ_0 u(t) + Γ_1 u(t+Δt), u linear in between.

    Equation:
        The exponential of [[A, B, 0], [0, 0, I/Δt], [0, 0, 0]] Δt, by its series.
    """
    n, m = B.shape
    M = np.zeros((n + 2 * m, n + 2 * m))
    M[:n, :n], M[:n, n : n + m], M[n : n + m, n + m :] = A * dt, B * dt, np.eye(m)
    halvings = 0
    while np.abs(M).sum(axis=0).max() > 0.5:
        M, halvings = M / 2.0, halvings + 1
    E = term = np.eye(n + 2 * m)
    for k in range(1, TERMS):
        term = term @ M / k
        E = E + term
    for _ in range(halvings):
        E = E @ E
    now = E[:n, n + m :]
    return E[:n, :n], E[:n, n : n + m] - now, now


def constant_covariance(phi: Array, Q: Array, H: Array, R: float) -> Array:
    """Return the covariance before a reading to which the Kalman filter settles.

    Equation:
        P <- Φ (P - P Hᵀ H P / (H P Hᵀ + R)) Φᵀ + Q, until P no longer changes.
    """
    P = Q.copy()
    while True:
        gain = P @ H / (H @ P @ H + R)
        after = P - np.outer(gain, H @ P)
        new = phi @ after @ phi.T + Q
        new = (new + new.T) / 2.0
        if np.abs(new - P).max() <= SETTLED * np.abs(new).max():
            return new
        P = new


def smoothed_states(car: HalfCar, place: float, u: Array, force: Array, dt: float) -> Array:
    """Return the half car's states, shape (N, 10), at all readings of its accelerometer.

    Args:
        car: the vehicle.
        place: of the accelerometer ahead of the centre of gravity, in m.
        u: the road under front and rear wheels in m and the acceleration along the road in m/s²,
            shape (3, N).
        force: vertical acceleration by the accelerometer in m/s², shape (N,).
        dt: between two readings, in s.

    Equation:
        x_k⁻ = Φ x_{k-1} + Γ u, x_k = x_k⁻ + K (y_k - H x_k⁻ - D u_k), and backward
        x_k^s = x_k + C (x_{k+1}^s - x_{k+1}⁻), C = P⁺ Φᵀ P⁻¹; it begins at rest on its first roads.
    """
    A, B = equations(car)
    H, D = reading_of(car, place)
    phi, before, now = step_matrices(A, B, dt)
    Q = np.zeros((STATES, STATES))
    Q[8, 8] = Q[9, 9] = car.disturbance**2 * (1.0 - np.exp(-2.0 * car.corner * dt))
    P = constant_covariance(phi, Q, H, car.reading**2)
    K = P @ H / (H @ P @ H + car.reading**2)
    after = P - np.outer(K, H @ P)
    C = after @ phi.T @ np.linalg.pinv(P, hermitian=True)
    x = np.zeros(STATES)
    x[:BODY] = -np.linalg.solve(A[BODY : 2 * BODY, :BODY], B[BODY : 2 * BODY] @ u[:, 0])
    predicted, filtered = [], []
    for k in range(force.size):
        if k > 0:
            x = phi @ x + before @ u[:, k - 1] + now @ u[:, k]
        predicted.append(x)
        x = x + K * (force[k] - H @ x - D @ u[:, k])
        filtered.append(x)
    found = [filtered[-1]]
    for k in range(force.size - 2, -1, -1):
        found.insert(0, filtered[k] + C @ (found[0] - predicted[k + 1]))
    return np.array(found)
