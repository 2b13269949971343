"""II System Description and Modeling: a chassis on two wheels."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]
Matrix = npt.NDArray[np.float64]


class Trailer(NamedTuple):
    """Parameters of chassis, suspensions and tyres.

    Equation:
        (1) to (6)

    Attributes:
        m_1: mass of the left wheel, kg.
        m_2: mass of the right wheel, kg.
        m: mass of the chassis, kg.
        I_x: moment of inertia in roll, kg·m².
        I_y: moment of inertia in pitch, kg·m².
        k_1: stiffness of the left suspension, N/m.
        k_2: stiffness of the right suspension, N/m.
        k_3: stiffness of the left tyre, N/m.
        k_4: stiffness of the right tyre, N/m.
        k_c: stiffness between the wheels, N/m.
        B_1: damping of the left suspension, N·s/m.
        B_2: damping of the right suspension, N·s/m.
        B_3: damping of the left tyre, N·s/m.
        B_4: damping of the right tyre, N·s/m.
        l_x: half the distance l between the wheels, m.
        p: half the length of the trailer, m.
    """

    m_1: float = 40.0
    m_2: float = 40.0
    m: float = 600.0
    I_x: float = 250.0
    I_y: float = 500.0
    k_1: float = 30e3
    k_2: float = 30e3
    k_3: float = 190e3
    k_4: float = 190e3
    k_c: float = 5e3
    B_1: float = 1500.0
    B_2: float = 1500.0
    B_3: float = 300.0
    B_4: float = 300.0
    l_x: float = 0.75
    p: float = 0.6


TRAILER = Trailer()
"""Our round numbers for such a trailer; the paper prints no numbers."""


class Motion(NamedTuple):
    """The matrices of the trailer.

    Equation:
        (7) M q̈ + B q̇ + K q = C u + D u̇, q = (z_1, z_2, z, θ, φ), u = (u_1, u_2)

    Attributes:
        M: inertia, shape (5, 5).
        B: damping, shape (5, 5).
        K: stiffness, shape (5, 5).
        C: force by the height of the road, N/m, shape (5, 2).
        D: force by its rate, N·s/m, shape (5, 2).
    """

    M: Matrix
    B: Matrix
    K: Matrix
    C: Matrix
    D: Matrix


def sides(z: float, theta: float, phi: float, trailer: Trailer = TRAILER) -> tuple[float, float]:
    """Compute the heights of the chassis above the two wheels.

    Equation:
        (1) z_l = z - l θ - p φ, z_r = z + l θ - p φ, for small angles.

    Args:
        z: height of the chassis, m.
        theta: roll θ, rad.
        phi: pitch φ, rad.
        trailer: parameters.

    Returns:
        z_l and z_r, m.
    """
    l_x, p = trailer.l_x, trailer.p
    return z - l_x * theta - p * phi, z + l_x * theta - p * phi


def forces(
    q: npt.ArrayLike,
    q_dot: npt.ArrayLike,
    u: npt.ArrayLike,
    u_dot: npt.ArrayLike,
    trailer: Trailer = TRAILER,
) -> tuple[float, float, float, float, float]:
    """Compute the forces and moments that accelerate wheels and chassis.

    Equation:
        (2) to (6), the forms with all terms written out: m_1 z̈_1, m_2 z̈_2, m z̈, I_x θ̈, I_y φ̈.
        Printed in (3) are - k_2 l θ and - B_2 l θ̇; (1) makes both positive.

    Args:
        q: z_1, z_2, z in m and θ, φ in rad, shape (5,).
        q_dot: their rates, shape (5,).
        u: road u_1, u_2, m, shape (2,).
        u_dot: its rates, m/s, shape (2,).
        trailer: parameters.

    Returns:
        Three forces in N and two moments in N·m.
    """
    _, _, _, _, _, k_1, k_2, k_3, k_4, k_c, B_1, B_2, B_3, B_4, l_x, p = trailer
    z_1, z_2, z, theta, phi = (float(x) for x in np.asarray(q, np.float64))
    v_1, v_2, v, omega, psi = (float(x) for x in np.asarray(q_dot, np.float64))
    (u_1, u_2), (w_1, w_2) = np.asarray(u, np.float64), np.asarray(u_dot, np.float64)
    left = -(k_1 + k_3 + k_c) * z_1 + k_c * z_2 + k_1 * z - k_1 * l_x * theta - k_1 * p * phi
    left += -(B_1 + B_3) * v_1 + B_1 * v - B_1 * l_x * omega - B_1 * p * psi
    right = -(k_2 + k_4 + k_c) * z_2 + k_c * z_1 + k_2 * z + k_2 * l_x * theta - k_2 * p * phi
    right += -(B_2 + B_4) * v_2 + B_2 * v + B_2 * l_x * omega - B_2 * p * psi
    heave = k_1 * z_1 + k_2 * z_2 - (k_1 + k_2) * z
    heave += (k_1 - k_2) * l_x * theta + (k_1 + k_2) * p * phi
    heave += B_1 * v_1 + B_2 * v_2 - (B_1 + B_2) * v
    heave += (B_1 - B_2) * l_x * omega + (B_1 + B_2) * p * psi
    roll = -k_1 * z_1 + k_2 * z_2 + (k_1 - k_2) * z
    roll += -(k_1 + k_2) * l_x * theta + (k_2 - k_1) * p * phi
    roll += -B_1 * v_1 + B_2 * v_2 + (B_1 - B_2) * v
    roll += -(B_1 + B_2) * l_x * omega + (B_2 - B_1) * p * psi
    pitch = -k_1 * z_1 - k_2 * z_2 + (k_1 + k_2) * z
    pitch += (k_2 - k_1) * l_x * theta - (k_2 + k_1) * p * phi
    pitch += -B_1 * v_1 - B_2 * v_2 + (B_2 + B_1) * v
    pitch += (B_2 - B_1) * l_x * omega - (B_2 + B_1) * p * psi
    by_road = float(k_3 * u_1 + B_3 * w_1), float(k_4 * u_2 + B_4 * w_2)
    return left + by_road[0], right + by_road[1], heave, roll * l_x, pitch * p


def motion(trailer: Trailer = TRAILER) -> Motion:
    """Read the matrices off the equations of motion.

    Equation:
        (7) from (2) to (6): column j of K and B is minus the forces under a unit of q_j and of
        q̇_j, that of C and D the forces under a unit of u_j and of u̇_j.

    Args:
        trailer: parameters.

    Returns:
        M, B, K, C and D. K is singular: z = p φ takes the chassis up over resting wheels, since
        the hitch, which would hold its other end, is not in (2) to (6).
    """
    K, B, C, D = np.zeros((5, 5)), np.zeros((5, 5)), np.zeros((5, 2)), np.zeros((5, 2))
    rest, level = np.zeros(5), np.zeros(2)
    for j, unit in enumerate(np.eye(5)):
        K[:, j] = -np.array(forces(unit, rest, level, level, trailer))
        B[:, j] = -np.array(forces(rest, unit, level, level, trailer))
    for j, unit in enumerate(np.eye(2)):
        C[:, j] = forces(rest, rest, unit, level, trailer)
        D[:, j] = forces(rest, rest, level, unit, trailer)
    M = np.diag([trailer.m_1, trailer.m_2, trailer.m, trailer.I_x, trailer.I_y])
    return Motion(M, B, K, C, D)
