"""2.1.1 International Roughness Index (IRI): the Golden-Car Model of figure 2.1."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.signals import Real, Samples, Signal, samples, signal


class QuarterCar(NamedTuple):
    """Constants of a quarter car, each divided by the sprung mass.

    Args:
        K_1: tyre stiffness, 1/s².
        K_2: suspension stiffness, 1/s².
        C: suspension damping, 1/s.
        mu: unsprung mass μ, dimensionless.
    """

    K_1: float
    K_2: float
    C: float
    mu: float


GOLDEN_CAR = QuarterCar(K_1=653.0, K_2=63.3, C=6.0, mu=0.15)


def state_matrices(car: QuarterCar = GOLDEN_CAR) -> tuple[Signal, Signal]:
    """Write the equations of motion in state form.

    Equation:
        Figure 2.1, differentiated along the road, so that displacements become slopes:
        z_s'' + C (z_s' - z_u') + K_2 (z_s - z_u) = 0,
        z_s'' + μ z_u'' + K_1 z_u = K_1 y.

    Args:
        car: constants of the quarter car.

    Returns:
        A, shape (4, 4), and B, shape (4,), of dX/dt = A X + B y for X = (z_s, dz_s/dt, z_u,
        dz_u/dt) with z_s, z_u and y in slope.
    """
    K_1, K_2, C, mu = (np.longdouble(constant) for constant in car)
    A = np.array(
        [
            [0, 1, 0, 0],
            [-K_2, -C, K_2, C],
            [0, 0, 0, 1],
            [K_2 / mu, C / mu, -(K_1 + K_2) / mu, -C / mu],
        ],
        dtype=np.longdouble,
    )
    return A, np.array([0, 0, 0, K_1 / mu], dtype=np.longdouble)


def matrix_exponential(M: Signal) -> Signal:
    """Compute exp(M) by its series, scaled down first and squared up afterwards.

    Equation:
        exp(M) = (Σ_i (M / 2^m)^i / i!)^(2^m)

    Args:
        M: square matrix.

    Returns:
        exp(M), of the same shape, to extended precision.
    """
    m = 0
    while np.abs(M).sum(axis=1).max() / 2**m > 0.5:
        m += 1
    term = np.eye(len(M), dtype=np.longdouble)
    result = term.copy()
    for i in range(1, 25):
        term = term @ M / 2**m / i
        result = result + term
    for _ in range(m):
        result = result @ result
    return result


def state_transition(dt: Real, car: QuarterCar = GOLDEN_CAR) -> tuple[Signal, Signal]:
    """Carry the car over one interval of constant slope, exactly.

    Equation:
        X(t + Δt) = S X(t) + P y, where [S P; 0 1] = exp([A B; 0 0] Δt)

    Args:
        dt: time Δt the car takes for one interval, s.
        car: constants of the quarter car.

    Returns:
        S, shape (4, 4), and P, shape (4,).
    """
    augmented = np.zeros((5, 5), dtype=np.longdouble)
    augmented[:4, :4], augmented[:4, 4] = state_matrices(car)
    exponential = matrix_exponential(augmented * np.longdouble(dt))
    return exponential[:4, :4], exponential[:4, 4]


def suspension_stroke(
    y: npt.ArrayLike,
    dx: float,
    start: Real,
    speed_kmh: float = 80.0,
    car: QuarterCar = GOLDEN_CAR,
) -> Signal:
    """Drive the quarter car over a slope profile.

    Equation:
        Step 3: X(x_{k+1}) = S X(x_k) + P y(x_k), output z_s' - z_u' at x_{k+1}.

    Args:
        y: smoothed slope, m/m, shape (K,).
        dx: constant interval Δx, m.
        start: slope of both masses before the first interval, m/m.
        speed_kmh: simulated speed V, km/h.
        car: constants of the quarter car.

    Returns:
        Spatial velocity across the suspension, m/m, shape (K,).
    """
    S, P = state_transition(np.longdouble(dx) * np.longdouble("3.6") / speed_kmh, car)
    rows, p = [list(row) for row in S], list(P)
    X = [np.longdouble(start), np.longdouble(0), np.longdouble(start), np.longdouble(0)]
    stroke: Samples = []
    for y_k in samples(y):
        X = [
            r[0] * X[0] + r[1] * X[1] + r[2] * X[2] + r[3] * X[3] + q * y_k
            for r, q in zip(rows, p, strict=True)
        ]
        stroke.append(X[0] - X[2])
    return signal(stroke)
