"""A.3 Initialization: the first outputs of every filter stage.

Every stage starts as if input and output had both equalled the first sample before. A low-pass
stage holds that sample, a high-pass stage decays from it. A signal of one sample yields one
output only.
"""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.table_a_1 import Coefficients
from floatref_reference.signals import Samples, samples


def lpf_b3s1_start(x: npt.ArrayLike, coefficients: Coefficients) -> Samples:
    """Initialize the forward first-order low-pass stage.

    Equation:
        (A.12) y(t_1) = x(t_1)

    Args:
        x: input signal, shape (K,).
        coefficients: row LPF_B3S1 of Table A.1; not needed by the equation.

    Returns:
        [y(t_1)], in the unit of x.
    """
    del coefficients
    return samples(x)[:1]


def lpf_b3s2_start(x: npt.ArrayLike, coefficients: Coefficients) -> Samples:
    """Initialize the forward second-order low-pass stage.

    Equation:
        (A.13) y(t_1) = x(t_1),
        y(t_2) = (N_0 x(t_2) + (N_1 + N_2) x(t_1) - (D_1 + D_2) y(t_1)) / D_0

    Args:
        x: input signal, shape (K,).
        coefficients: row LPF_B3S2 of Table A.1.

    Returns:
        [y(t_1), y(t_2)], in the unit of x.
    """
    x_t = samples(x)
    return _two_outputs(x_t[:2], x_t[0], coefficients)


def hpf_b3s1_start(x: npt.ArrayLike, coefficients: Coefficients) -> Samples:
    """Initialize the forward first-order high-pass stage.

    Equation:
        (A.14) y(t_1) = -(D_1 / D_0) x(t_1)

    Args:
        x: input signal, shape (K,).
        coefficients: row HPF_B3S1 of Table A.1.

    Returns:
        [y(t_1)], in the unit of x.
    """
    D = coefficients.D
    return [-D[1] / D[0] * samples(x)[0]]


def hpf_b3s2_start(x: npt.ArrayLike, coefficients: Coefficients) -> Samples:
    """Initialize the forward second-order high-pass stage.

    Equation:
        (A.15) y(t_1) = -((D_1 + D_2) / D_0) x(t_1),
        y(t_2) = (N_0 x(t_2) + (N_1 + N_2) x(t_1) - (D_1 + D_2) y(t_1)) / D_0

    Args:
        x: input signal, shape (K,).
        coefficients: row HPF_B3S2 of Table A.1.

    Returns:
        [y(t_1), y(t_2)], in the unit of x.
    """
    D, x_t = coefficients.D, samples(x)
    return _two_outputs(x_t[:2], -(D[1] + D[2]) / D[0] * x_t[0], coefficients)


def lpf_b3s1r_start(x: npt.ArrayLike, coefficients: Coefficients) -> Samples:
    """Initialize the reverse first-order low-pass stage.

    Equation:
        (A.16) y(t_K) = x(t_K)

    Args:
        x: input signal, shape (K,).
        coefficients: row LPF_B3S1 of Table A.1; not needed by the equation.

    Returns:
        [y(t_K)], in the unit of x.
    """
    del coefficients
    return samples(x)[-1:]


def lpf_b3s2r_start(x: npt.ArrayLike, coefficients: Coefficients) -> Samples:
    """Initialize the reverse second-order low-pass stage.

    Equation:
        (A.17) y(t_K) = x(t_K),
        y(t_{K-1}) = (N_0 x(t_{K-1}) + (N_1 + N_2) x(t_K) - (D_1 + D_2) y(t_K)) / D_0

    Args:
        x: input signal, shape (K,).
        coefficients: row LPF_B3S2 of Table A.1.

    Returns:
        [y(t_K), y(t_{K-1})], in the unit of x.
    """
    x_t = samples(x)
    return _two_outputs(x_t[:-3:-1], x_t[-1], coefficients)


def hpf_b3s1r_start(x: npt.ArrayLike, coefficients: Coefficients) -> Samples:
    """Initialize the reverse first-order high-pass stage.

    Equation:
        (A.18) y(t_K) = -(D_1 / D_0) x(t_K)

    Args:
        x: input signal, shape (K,).
        coefficients: row HPF_B3S1 of Table A.1.

    Returns:
        [y(t_K)], in the unit of x.
    """
    D = coefficients.D
    return [-D[1] / D[0] * samples(x)[-1]]


def hpf_b3s2r_start(x: npt.ArrayLike, coefficients: Coefficients) -> Samples:
    """Initialize the reverse second-order high-pass stage.

    Equation:
        (A.19), mended to mirror (A.15) and (A.17); the print swaps x(t_K) and x(t_{K-1}):
        y(t_K) = -((D_1 + D_2) / D_0) x(t_K),
        y(t_{K-1}) = (N_0 x(t_{K-1}) + (N_1 + N_2) x(t_K) - (D_1 + D_2) y(t_K)) / D_0

    Args:
        x: input signal, shape (K,).
        coefficients: row HPF_B3S2 of Table A.1.

    Returns:
        [y(t_K), y(t_{K-1})], in the unit of x.
    """
    D, x_t = coefficients.D, samples(x)
    return _two_outputs(x_t[:-3:-1], -(D[1] + D[2]) / D[0] * x_t[-1], coefficients)


def _two_outputs(x_t: Samples, y_1: np.longdouble, coefficients: Coefficients) -> Samples:
    D, N = coefficients
    if len(x_t) == 1:
        return [y_1]
    return [y_1, (N[0] * x_t[1] + (N[1] + N[2]) * x_t[0] - (D[1] + D[2]) * y_1) / D[0]]
