"""The quarter car with physical masses, which neither paper on vehicle response has.

It is figure 2.1 of the dissertation with a damper beside the spring of the tyre, in the form of
(7) of Zhu et al. (2021), so that their sections on state space and estimation apply.
"""

from typing import NamedTuple

import numpy as np

from floatref_reference.zhu_2021.symbols import Structure


class ResponseCar(NamedTuple):
    """Parameters of a body on a wheel.

    Equation:
        Figure 2.1, not divided by the sprung mass.

    Attributes:
        m_s: sprung mass, kg.
        m_u: unsprung mass, kg.
        k_s: stiffness of the suspension, N/m.
        c_s: damping of the suspension, N·s/m.
        k_t: stiffness of the tyre, N/m.
        c_t: damping of the tyre, N·s/m.
    """

    m_s: float
    m_u: float
    k_s: float
    c_s: float
    k_t: float
    c_t: float = 0.0


def structure(car: ResponseCar) -> Structure:
    """Write the matrices of the quarter car.

    Equation:
        m_s z̈_s + c_s (ż_s - ż_u) + k_s (z_s - z_u) = 0,
        m_u z̈_u - c_s (ż_s - ż_u) - k_s (z_s - z_u) + c_t ż_u + k_t z_u = F,
        with F = k_t u + c_t u̇ the force of the road through the tyre.

    Args:
        car: parameters.

    Returns:
        M, C, K of Y = (z_s, z_u), shape (2, 2), and S_p, shape (2, 1).
    """
    m_s, m_u, k_s, c_s, k_t, c_t = car
    M = np.diag([m_s, m_u])
    C = np.array([[c_s, -c_s], [-c_s, c_s + c_t]])
    K = np.array([[k_s, -k_s], [-k_s, k_s + k_t]])
    return Structure(M, C, K, np.array([[0.0], [1.0]]))
