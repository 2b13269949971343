"""6.1.4 Kalman Smoother, by Rauch, Tung and Striebel."""

import numpy as np

from floatref_reference.appendix_c.symbols import Matrix, Vector


def smoother_gain(P: Matrix, A: Matrix, P_next: Matrix) -> Matrix:
    """Compute the gain of the backward pass.

    Equation:
        (6.17) L_k = P_{k|k} A_kᵀ P_{k+1|k}⁻¹, with A_k of (6.18)

    Args:
        P: P_{k|k}, shape (ns, ns).
        A: A_k = ∂f/∂x at x̂_{k|k} and u_k, shape (ns, ns).
        P_next: P_{k+1|k}, shape (ns, ns).

    Returns:
        L_k, shape (ns, ns).

    Raises:
        numpy.linalg.LinAlgError: if P_{k+1|k} is singular, as for a state that is known exactly
            and has no process noise.
    """
    return P @ A.T @ np.linalg.inv(P_next)


def smoothed_state(x: Vector, L: Matrix, x_smoothed: Vector, x_next: Vector) -> Vector:
    """Refine the state by what came afterwards.

    Equation:
        (6.17) x̂_{k|N} = x̂_{k|k} + L_k (x̂_{k+1|N} - x̂_{k+1|k})

    Args:
        x: x̂_{k|k}, shape (ns,).
        L: gain L_k, shape (ns, ns).
        x_smoothed: x̂_{k+1|N}, shape (ns,).
        x_next: x̂_{k+1|k} of (6.19), shape (ns,).

    Returns:
        x̂_{k|N}, shape (ns,).
    """
    return x + L @ (x_smoothed - x_next)


def smoothed_covariance(P: Matrix, L: Matrix, P_smoothed: Matrix, P_next: Matrix) -> Matrix:
    """Refine the covariance of the state.

    Equation:
        (6.22) P_{k|N} = P_{k|k} + L_k (P_{k+1|N} - P_{k+1|k}) L_kᵀ

    Args:
        P: P_{k|k}, shape (ns, ns).
        L: gain L_k, shape (ns, ns).
        P_smoothed: P_{k+1|N}, shape (ns, ns).
        P_next: P_{k+1|k} of (6.20), shape (ns, ns).

    Returns:
        P_{k|N}, shape (ns, ns).
    """
    return P + L @ (P_smoothed - P_next) @ L.T
