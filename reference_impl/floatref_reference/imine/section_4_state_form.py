"""IV Observation and Estimation: the state, and the part that depends on the input."""

from typing import NamedTuple

import numpy as np

from floatref_reference.imine.section_2_trailer import TRAILER, Matrix, Motion, Trailer, motion


class StateForm(NamedTuple):
    """The matrices of state and input.

    Equation:
        (8) ẋ_1 = A x_1 + C_1 u + D_1 u̇, (9) u̇ = A_2 x_1 + C_2 u + D_2 (z̈_1, z̈_2), with
        x_1 = (q, q̇)

    Attributes:
        A: shape (10, 10).
        C_1: shape (10, 2).
        D_1: shape (10, 2).
        A_2: shape (2, 10).
        C_2: shape (2, 2).
        D_2: shape (2, 2).
    """

    A: Matrix
    C_1: Matrix
    D_1: Matrix
    A_2: Matrix
    C_2: Matrix
    D_2: Matrix


def state_matrices(matrices: Motion) -> tuple[Matrix, Matrix, Matrix]:
    """Write the equations of motion in state form.

    Equation:
        (8) from (7): A = [0 I; -M⁻¹K -M⁻¹B], C_1 = [0; M⁻¹C], D_1 = [0; M⁻¹D]. What is printed of
        A does not have the order (q, q̇).

    Args:
        matrices: M, B, K, C and D.

    Returns:
        A, shape (10, 10), C_1 and D_1, shape (10, 2).
    """
    M, B, K, C, D = matrices
    inverse, n = np.linalg.inv(M), len(M)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ K, -inverse @ B]])
    above = np.zeros((n, C.shape[1]))
    return A, np.vstack([above, inverse @ C]), np.vstack([above, inverse @ D])


def input_matrices(trailer: Trailer = TRAILER) -> tuple[Matrix, Matrix, Matrix]:
    """Solve the equations of the wheels for the rates of the road.

    Equation:
        (9) from (2) and (3): B_3 u̇_1 = m_1 z̈_1 + (k_1 + k_3 + k_c) z_1 - ... - k_3 u_1, and so for
        the right wheel. D_2 = diag(m_1/B_3, m_2/B_4), printed with a minus.

    Args:
        trailer: parameters; both tyres need damping.

    Returns:
        A_2, shape (2, 10), C_2 and D_2, shape (2, 2).

    Raises:
        ValueError: unless both tyres have damping: (9) divides by it.
    """
    m_1, m_2, _, _, _, k_1, k_2, k_3, k_4, k_c, B_1, B_2, B_3, B_4, l_x, p = trailer
    if not min(B_3, B_4) > 0:
        raise ValueError(f"tyre dampings {B_3} and {B_4} N·s/m: (9) needs both above zero")
    A_21 = [
        [k_1 + k_c + k_3, -k_c, -k_1, k_1 * l_x, k_1 * p],
        [-k_c, k_2 + k_4 + k_c, -k_2, -k_2 * l_x, k_2 * p],
    ]
    A_22 = [
        [B_1 + B_3, 0, -B_1, B_1 * l_x, B_1 * p],
        [0, B_2 + B_4, -B_2, -B_2 * l_x, B_2 * p],
    ]
    divide = np.diag([1 / B_3, 1 / B_4])
    C_2, D_2 = -divide @ np.diag([k_3, k_4]), divide @ np.diag([m_1, m_2])
    return divide @ np.hstack([A_21, A_22]), C_2, D_2


def state_form(trailer: Trailer = TRAILER) -> StateForm:
    """Put all matrices together.

    Equation:
        (8), (9)

    Args:
        trailer: parameters; both tyres need damping.

    Returns:
        A, C_1, D_1, A_2, C_2 and D_2.

    Raises:
        ValueError: unless both tyres have damping.
    """
    return StateForm(*state_matrices(motion(trailer)), *input_matrices(trailer))


def output_matrix(measured: list[int]) -> Matrix:
    """Select what is measured of the state.

    Equation:
        (8) y = C' x_1

    Args:
        measured: places in x_1, from 0; 0 to 4 are wheels, chassis, roll and pitch, as in IV.A.

    Returns:
        C', shape (len(measured), 10).
    """
    C_prime = np.zeros((len(measured), 10))
    for row, place in enumerate(measured):
        C_prime[row, place] = 1.0
    return C_prime
