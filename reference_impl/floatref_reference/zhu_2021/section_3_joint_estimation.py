"""3 Mathematical Formulation: joint estimation of input and state, steps (a) to (c)."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.zhu_2021.symbols import Matrix, Stack, System, Vector


class Estimate(NamedTuple):
    """What the filter knows at N steps.

    Equation:
        Steps (a) and (b)

    Attributes:
        F: F̂_{k|k}, N, shape (N, p).
        P_F: P_F[k|k], N², shape (N, p, p).
        X: X̂_{k|k}, shape (N, ns).
        P: P_{k|k}, shape (N, ns, ns).
        P_XF: P_XF[k|k], shape (N, ns, p).
    """

    F: Matrix
    P_F: Stack
    X: Matrix
    P: Stack
    P_XF: Stack


def innovation_covariance(P: Matrix, G: Matrix, R: Matrix) -> Matrix:
    """Compute how far measurements may lie from their prediction but for the force.

    Equation:
        Step (a): R̃_k = G P_{k|k-1} Gᵀ + R

    Args:
        P: P_{k|k-1}, shape (ns, ns).
        G: output influence, shape (nm, ns).
        R: covariance of the measurement noise, shape (nm, nm).

    Returns:
        R̃_k, shape (nm, nm).
    """
    return G @ P @ G.T + R


def input_estimation(
    x: Vector, Z: Vector, G: Matrix, J: Matrix, R_tilde: Matrix
) -> tuple[Vector, Matrix]:
    """Estimate the forces by weighted least squares.

    Equation:
        Step (a): M_k = (Jᵀ R̃_k⁻¹ J)⁻¹ Jᵀ R̃_k⁻¹, F̂_{k|k} = M_k (Z_k - G X̂_{k|k-1}),
        P_F[k|k] = (Jᵀ R̃_k⁻¹ J)⁻¹

    Args:
        x: X̂_{k|k-1}, shape (ns,).
        Z: measurements Z_k, shape (nm,).
        G: output influence, shape (nm, ns).
        J: direct transmission, shape (nm, p).
        R_tilde: R̃_k, shape (nm, nm).

    Returns:
        F̂_{k|k}, shape (p,), and P_F[k|k], shape (p, p).

    Raises:
        ValueError: unless J has full column rank; an acceleration at each wheel gives it.
    """
    if np.linalg.matrix_rank(J) < J.shape[1]:
        raise ValueError(f"J does not determine {J.shape[1]} forces: measure wheel accelerations")
    inverse = np.linalg.inv(R_tilde)
    P_F = symmetric(np.linalg.inv(J.T @ inverse @ J))
    M_k = P_F @ J.T @ inverse
    return M_k @ (Z - G @ x), P_F


def measurement_update(
    x: Vector,
    P: Matrix,
    Z: Vector,
    G: Matrix,
    J: Matrix,
    R_tilde: Matrix,
    F: Vector,
    P_F: Matrix,
) -> tuple[Vector, Matrix, Matrix]:
    """Correct the state by what the estimated forces do not explain.

    Equation:
        Step (b): L_k = P_{k|k-1} Gᵀ R̃_k⁻¹,
        X̂_{k|k} = X̂_{k|k-1} + L_k (Z_k - G X̂_{k|k-1} - J F̂_{k|k}),
        P_{k|k} = P_{k|k-1} - L_k (R̃_k - J P_F[k|k] Jᵀ) L_kᵀ, P_XF[k|k] = -L_k J P_F[k|k]

    Args:
        x: X̂_{k|k-1}, shape (ns,).
        P: P_{k|k-1}, shape (ns, ns).
        Z: measurements Z_k, shape (nm,).
        G: output influence, shape (nm, ns).
        J: direct transmission, shape (nm, p).
        R_tilde: R̃_k of step (a), shape (nm, nm).
        F: F̂_{k|k} of step (a), shape (p,).
        P_F: P_F[k|k] of step (a), shape (p, p).

    Returns:
        X̂_{k|k}, shape (ns,), P_{k|k}, shape (ns, ns), and P_XF[k|k], shape (ns, p).
    """
    L_k = P @ G.T @ np.linalg.inv(R_tilde)
    x_after = x + L_k @ (Z - G @ x - J @ F)
    P_after = P - L_k @ (R_tilde - J @ P_F @ J.T) @ L_k.T
    return x_after, symmetric(P_after), -L_k @ J @ P_F


def time_update(
    x: Vector,
    P: Matrix,
    F: Vector,
    P_F: Matrix,
    P_XF: Matrix,
    A_c: Matrix,
    B_c: Matrix,
    Q: Matrix,
) -> tuple[Vector, Matrix]:
    """Predict the state and its covariance.

    Equation:
        Step (c): X̂_{k+1|k} = A_c X̂_{k|k} + B_c F̂_{k|k},
        P_{k+1|k} = [A_c B_c] [P_{k|k} P_XF; P_XFᵀ P_F] [A_c B_c]ᵀ + Q. Printed for P_XFᵀ is P_XF,
        which does not fit.

    Args:
        x: X̂_{k|k}, shape (ns,).
        P: P_{k|k}, shape (ns, ns).
        F: F̂_{k|k}, shape (p,).
        P_F: P_F[k|k], shape (p, p).
        P_XF: P_XF[k|k], shape (ns, p).
        A_c: state transition, shape (ns, ns).
        B_c: input matrix, shape (ns, p).
        Q: covariance of the process noise, shape (ns, ns).

    Returns:
        X̂_{k+1|k}, shape (ns,), and P_{k+1|k}, shape (ns, ns).
    """
    both = np.hstack([A_c, B_c])
    joint = np.block([[P, P_XF], [P_XF.T, P_F]])
    return A_c @ x + B_c @ F, symmetric(both @ joint @ both.T + Q)


def symmetric(P: npt.ArrayLike) -> Matrix:
    """Make a covariance symmetric that rounding has made a little asymmetric.

    Equation:
        Not in the print: (P + Pᵀ)/2. Steps (b) and (c) take differences of large terms. What they
        round off one side of the diagonal and not off the other, nothing in the recursion takes
        back; it grows from step to step until the numbers overflow.

    Args:
        P: covariance, shape (n, n).

    Returns:
        The same, symmetric.
    """
    one = np.asarray(P, np.float64)
    return (one + one.T) / 2


def joint_input_state(
    Z: npt.ArrayLike, system: System, Q: Matrix, R: Matrix, X_0: npt.ArrayLike, P_0: Matrix
) -> Estimate:
    """Estimate forces and states from all measurements up to each step.

    Equation:
        Steps (a), (b) and (c) at each step. They count from 0 here: X_0 and P_0 mean
        X̂_{0|-1} and P_{0|-1}. No step uses F̂_{0|-1} of the print.

    Args:
        Z: measurements, shape (N, nm).
        system: A_c, B_c, G and J of (12) and (13).
        Q: covariance of the process noise of a step, shape (ns, ns).
        R: covariance of the measurement noise, shape (nm, nm).
        X_0: state before the first measurement, shape (ns,).
        P_0: its covariance, shape (ns, ns).

    Returns:
        Forces, states and their covariances.

    Raises:
        ValueError: unless J has full column rank.
    """
    A_c, B_c, G, J = system
    x, P = np.asarray(X_0, np.float64), np.asarray(P_0, np.float64)
    steps = []
    for Z_k in np.asarray(Z, np.float64):
        R_tilde = innovation_covariance(P, G, R)
        F, P_F = input_estimation(x, Z_k, G, J, R_tilde)
        x, P, P_XF = measurement_update(x, P, Z_k, G, J, R_tilde, F, P_F)
        steps.append((F, P_F, x, P, P_XF))
        x, P = time_update(x, P, F, P_F, P_XF, A_c, B_c, Q)
    return Estimate(*(np.array(part) for part in zip(*steps, strict=True)))
