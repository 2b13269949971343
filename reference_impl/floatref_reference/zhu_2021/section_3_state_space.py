"""3 Mathematical Formulation: state and measurements."""

import numpy as np
import numpy.typing as npt

from floatref_reference.zhu_2021.symbols import Matrix, Structure


def state_space(vehicle: Structure) -> tuple[Matrix, Matrix]:
    """Write the equations of motion in state form.

    Equation:
        (9) Ẋ = A X + B F with X = (Y, Ẏ), A = [0 I; -M⁻¹K -M⁻¹C] and B = [0; M⁻¹S_p]. B has as
        many columns as there are forces.

    Args:
        vehicle: M, C, K of n freedoms and S_p of p forces.

    Returns:
        A, shape (2n, 2n), and B, shape (2n, p).
    """
    M, C, K, S_p = vehicle
    n, p = S_p.shape
    inverse = np.linalg.inv(M)
    A, B = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, p))
    A[:n, n:] = np.eye(n)
    A[n:, :n], A[n:, n:] = -inverse @ K, -inverse @ C
    B[n:] = inverse @ S_p
    return A, B


def output_matrices(
    vehicle: Structure, S_a: npt.ArrayLike, S_v: npt.ArrayLike, S_d: npt.ArrayLike
) -> tuple[Matrix, Matrix]:
    """Write the measurements as a combination of state and forces.

    Equation:
        (10) Z = S_a Ÿ + S_v Ẏ + S_d Y, and (11) Z = G X + J F with
        G = [S_d - S_a M⁻¹K, S_v - S_a M⁻¹C], J = S_a M⁻¹S_p

    Args:
        vehicle: M, C, K of n freedoms and S_p of p forces.
        S_a: selection of accelerations, shape (nm, n).
        S_v: selection of velocities, shape (nm, n).
        S_d: selection of displacements, shape (nm, n).

    Returns:
        G, shape (nm, 2n), and J, shape (nm, p).
    """
    M, C, K, S_p = vehicle
    by_acceleration = np.asarray(S_a, np.float64) @ np.linalg.inv(M)
    by_state = np.hstack([np.asarray(S_d, np.float64), np.asarray(S_v, np.float64)])
    G = by_state - by_acceleration @ np.hstack([K, C])
    return G, by_acceleration @ S_p
