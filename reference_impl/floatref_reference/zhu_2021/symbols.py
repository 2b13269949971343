"""Matrices of sections 2 and 3."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]
Matrix = npt.NDArray[np.float64]
Stack = npt.NDArray[np.float64]


class Structure(NamedTuple):
    """A vehicle of n freedoms that p forces act on.

    Equation:
        (7) M Ÿ + C Ẏ + K Y = S_p F(t)

    Attributes:
        M: mass, kg and kg·m², shape (n, n).
        C: damping, N·s/m, N·s and N·m·s, shape (n, n).
        K: stiffness, N/m, N and N·m, shape (n, n).
        S_p: where the forces act, shape (n, p).
    """

    M: Matrix
    C: Matrix
    K: Matrix
    S_p: Matrix


class System(NamedTuple):
    """The discrete state-space model, of ns states, p forces and nm measurements.

    Equation:
        (12) X_{k+1} = A_c X_k + B_c F_k + w_k, (13) Z_k = G X_k + J F_k + v_k

    Attributes:
        A_c: state transition, shape (ns, ns).
        B_c: input matrix, shape (ns, p).
        G: output influence, shape (nm, ns).
        J: direct transmission, shape (nm, p).
    """

    A_c: Matrix
    B_c: Matrix
    G: Matrix
    J: Matrix
