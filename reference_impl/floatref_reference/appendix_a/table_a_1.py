"""Table A.1: the coefficients of the four basic filtering stages."""

from typing import NamedTuple

import numpy as np


class Coefficients(NamedTuple):
    """One row of Table A.1.

    Equation:
        (A.8) H(z) = Σ N_i z^-i / Σ D_i z^-i

    Args:
        D: denominator coefficients D_0 … D_n, dimensionless.
        N: numerator coefficients N_0 … N_n, dimensionless.
    """

    D: tuple[np.longdouble, ...]
    N: tuple[np.longdouble, ...]


def lpf_b3s1_coefficients(c: np.longdouble) -> Coefficients:
    """Look up the first-order low-pass stage.

    Equation:
        Table A.1, LPF_B3S1.

    Args:
        c: substitution (A.11).

    Returns:
        D_0, D_1 and N_0, N_1.
    """
    return Coefficients(D=(c + 1, c - 1), N=(c, c))


def lpf_b3s2_coefficients(c: np.longdouble) -> Coefficients:
    """Look up the second-order low-pass stage.

    Equation:
        Table A.1, LPF_B3S2.

    Args:
        c: substitution (A.11).

    Returns:
        D_0, D_1, D_2 and N_0, N_1, N_2.
    """
    return Coefficients(D=_second_order_denominator(c), N=(c**2, 2 * c**2, c**2))


def hpf_b3s1_coefficients(c: np.longdouble) -> Coefficients:
    """Look up the first-order high-pass stage.

    Equation:
        Table A.1, HPF_B3S1.

    Args:
        c: substitution (A.11).

    Returns:
        D_0, D_1 and N_0, N_1.
    """
    one = np.longdouble(1)
    return Coefficients(D=(c + 1, c - 1), N=(one, -one))


def hpf_b3s2_coefficients(c: np.longdouble) -> Coefficients:
    """Look up the second-order high-pass stage.

    Equation:
        Table A.1, HPF_B3S2.

    Args:
        c: substitution (A.11).

    Returns:
        D_0, D_1, D_2 and N_0, N_1, N_2.
    """
    one = np.longdouble(1)
    return Coefficients(D=_second_order_denominator(c), N=(one, -2 * one, one))


def _second_order_denominator(c: np.longdouble) -> tuple[np.longdouble, ...]:
    return (c**2 + c + 1, 2 * (c**2 - 1), c**2 - c + 1)
