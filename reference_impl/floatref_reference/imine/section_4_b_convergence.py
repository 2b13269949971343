"""IV.B Convergence Analysis."""

import numpy as np
import numpy.typing as npt

from floatref_reference.imine.section_2_trailer import Matrix, Trailer
from floatref_reference.imine.section_4_state_form import StateForm


def error_matrix(form: StateForm, G: Matrix, C_prime: Matrix) -> Matrix:
    """Compute the composite error matrix.

    Equation:
        (12) to (14): ė_1 = (A - G C' + D_1 A_2) e_1 and ė_2 = A_2 e_1 + C_2 e_2, together
        L = [A_3 0; A_2 C_2] with A_3 = A + D_1 A_2 - G C', e_1 = x̄_1 - x_1 and e_2 = ū - u. The
        zero is right: C_1 + D_1 C_2, through which e_2 would act on e_1, vanishes.

    Args:
        form: matrices of (8) and (9).
        G: gains, shape (10, nm).
        C_prime: C', shape (nm, 10).

    Returns:
        L of (15) ė = L e, shape (12, 12).
    """
    A_3 = form.A + form.D_1 @ form.A_2 - G @ C_prime
    zero = np.zeros((10, 2))
    return np.block([[A_3, zero], [form.A_2, form.C_2]])


def slowest_rate(L: Matrix) -> float:
    """Compute the largest real part of the eigenvalues; errors vanish if it is negative.

    Equation:
        (15): e converges to zero if L is stable. (18) asks for more, that L + Lᵀ is negative
        definite, which depends on the units of the state and is not needed.

    Args:
        L: composite error matrix, shape (12, 12).

    Returns:
        max Re λ(L), 1/s.
    """
    return float(np.linalg.eigvals(L).real.max())


def printed_conditions(g: npt.ArrayLike, trailer: Trailer) -> bool:
    """Tell whether gains meet the conditions as printed, which decide nothing.

    Equation:
        (19) g_1, g_2, g_3, g_8 > 0, and (20) g_4 > (B_3 + B_4)/m_1, g_5 > (B_2 + B_4)/m_2,
        g_6 > (B_1 + B_2)/m - (B_1 + B_3)/m_1, g_7 > k_2 B_4/m², g_9 > (B_1 + B_2) l/I_x,
        g_10 > (B_1 + B_2) p/I_y. B_4 acts on m_2, not on m_1. They neither follow from (18)
        nor lead to it: use `slowest_rate`.

    Args:
        g: g_1 to g_10, shape (10,).
        trailer: parameters.

    Returns:
        Whether all ten hold.
    """
    m_1, m_2, m, I_x, I_y, _, k_2, _, _, _, B_1, B_2, B_3, B_4, l_x, p = trailer
    bounds = [
        0,
        0,
        0,
        (B_3 + B_4) / m_1,
        (B_2 + B_4) / m_2,
        (B_1 + B_2) / m - (B_1 + B_3) / m_1,
        k_2 * B_4 / m**2,
        0,
        (B_1 + B_2) * l_x / I_x,
        (B_1 + B_2) * p / I_y,
    ]
    return all(g_i > bound for g_i, bound in zip(np.asarray(g), bounds, strict=True))
