"""6.1.1 Linear Kalman Filter."""

import numpy as np

from floatref_reference.appendix_c.symbols import Matrix, Vector


def time_update(
    x: Vector, P: Matrix, u: Vector, A: Matrix, B: Matrix, Q: Matrix
) -> tuple[Vector, Matrix]:
    """Predict the state and its covariance.

    Equation:
        (6.5) x̂_{k|k-1} = A_{k-1} x̂_{k-1|k-1} + B_{k-1} u_{k-1},
        P_{k|k-1} = A_{k-1} P_{k-1|k-1} A_{k-1}ᵀ + Q_{k-1}

    Args:
        x: x̂_{k-1|k-1}, shape (ns,).
        P: P_{k-1|k-1}, shape (ns, ns).
        u: u_{k-1}, shape (ni,).
        A: state transition A_{k-1}, shape (ns, ns).
        B: input matrix B_{k-1}, shape (ns, ni).
        Q: covariance of the process noise, shape (ns, ns).

    Returns:
        x̂_{k|k-1}, shape (ns,), and P_{k|k-1}, shape (ns, ns).
    """
    return A @ x + B @ u, A @ P @ A.T + Q


def measurement_update(
    x: Vector, P: Matrix, y: Vector, H: Matrix, R: Matrix
) -> tuple[Vector, Matrix]:
    """Correct the state and its covariance by a measurement.

    Equation:
        (6.7) K_k = P_{k|k-1} H_kᵀ (H_k P_{k|k-1} H_kᵀ + R_k)⁻¹,
        x̂_{k|k} = x̂_{k|k-1} + K_k (y_k - H_k x̂_{k|k-1}), P_{k|k} = (I - K_k H_k) P_{k|k-1}.
        H_k has nm rows; printed below (6.1) is its shape turned over.

    Args:
        x: x̂_{k|k-1}, shape (ns,).
        P: P_{k|k-1}, shape (ns, ns).
        y: measurements y_k, shape (nm,).
        H: observation matrix H_k, shape (nm, ns).
        R: covariance of the measurement noise, shape (nm, nm).

    Returns:
        x̂_{k|k}, shape (ns,), and P_{k|k}, shape (ns, ns).
    """
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ (y - H @ x), (np.eye(len(x)) - K @ H) @ P
