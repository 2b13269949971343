"""6.1.2 Extended Kalman Filter."""

import numpy as np

from floatref_reference.appendix_c.symbols import Matrix, Vector


def predicted_covariance(P: Matrix, A: Matrix, W: Matrix, Q: Matrix) -> Matrix:
    """Predict the covariance of the state; the state itself is f(x̂_{k-1|k-1}, u_{k-1}, 0), (6.9).

    Equation:
        (6.10) P_{k|k-1} = A_{k-1} P_{k-1|k-1} A_{k-1}ᵀ + W_{k-1} Q_{k-1} W_{k-1}ᵀ. Printed with
        P_{k|k-1} on both sides; the right one is P_{k-1|k-1}, as (6.5) and (6.20) have it.

    Args:
        P: P_{k-1|k-1}, shape (ns, ns).
        A: ∂f/∂x of (6.11), shape (ns, ns).
        W: ∂f/∂w of (6.12), shape (ns, nn).
        Q: covariance of the process noise, shape (nn, nn).

    Returns:
        P_{k|k-1}, shape (ns, ns).
    """
    return A @ P @ A.T + W @ Q @ W.T


def measurement_update(
    x: Vector, P: Matrix, y: Vector, h_x: Vector, H: Matrix, R: Matrix, V: Matrix
) -> tuple[Vector, Matrix]:
    """Correct the state and its covariance by a measurement.

    Equation:
        (6.13) K_k = P_{k|k-1} H_kᵀ (H_k P_{k|k-1} H_kᵀ + V_k R_k V_kᵀ)⁻¹,
        x̂_{k|k} = x̂_{k|k-1} + K_k (y_k - h(x̂_{k|k-1}, 0)), P_{k|k} = (I - K_k H_k) P_{k|k-1}

    Args:
        x: x̂_{k|k-1}, shape (ns,).
        P: P_{k|k-1}, shape (ns, ns).
        y: measurements y_k, shape (nm,).
        h_x: h(x̂_{k|k-1}, 0), shape (nm,).
        H: ∂h/∂x of (6.14), shape (nm, ns).
        R: covariance of the measurement noise, shape (nm, nm).
        V: ∂h/∂v of (6.15), shape (nm, nm).

    Returns:
        x̂_{k|k}, shape (ns,), and P_{k|k}, shape (ns, ns).
    """
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + V @ R @ V.T)
    return x + K @ (y - h_x), (np.eye(len(x)) - K @ H) @ P
