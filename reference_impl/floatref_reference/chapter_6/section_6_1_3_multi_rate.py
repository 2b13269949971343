"""6.1.3 Multi-Rate Kalman Filter."""

import numpy as np

from floatref_reference.appendix_c.symbols import Matrix, Vector
from floatref_reference.chapter_6.section_6_1_2_extended import measurement_update


def multi_rate_update(
    x: Vector, P: Matrix, y: Vector | None, h_x: Vector, H: Matrix, R: Matrix
) -> tuple[Vector, Matrix]:
    """Correct the state if there is an observation.

    Equation:
        (6.16) x̂_{k|k} = x̂_{k|k-1}, P_{k|k} = P_{k|k-1} without an observation, else (6.13) with
        V = I. If a component of an observation is missing, its rows are omitted.

    Args:
        x: x̂_{k|k-1}, shape (ns,).
        P: P_{k|k-1}, shape (ns, ns).
        y: measurements y_k, shape (nm,), NaN where one is missing; None if all are.
        h_x: h(x̂_{k|k-1}, 0), shape (nm,).
        H: ∂h/∂x, shape (nm, ns).
        R: covariance of the measurement noise, shape (nm, nm).

    Returns:
        x̂_{k|k}, shape (ns,), and P_{k|k}, shape (ns, ns).
    """
    if y is None or np.isnan(y).all():
        return x, P
    there = ~np.isnan(y)
    R_there = R[np.ix_(there, there)]
    V = np.eye(len(R_there))
    return measurement_update(x, P, y[there], h_x[there], H[there], R_there, V)
