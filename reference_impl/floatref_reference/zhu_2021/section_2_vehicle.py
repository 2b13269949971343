"""2 Dynamic Equations of the Vehicle: a half car that carries equipment."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.zhu_2021.symbols import Structure, Vector


class HalfCar(NamedTuple):
    """Parameters of body, equipment and axles; k_1, k_2, c_1 and c_2 belong to (1) alone.

    Equation:
        Table 1

    Attributes:
        L_1: distance from the centre of gravity to the rear axle, m.
        L_2: distance from it to the front axle, m.
        e: eccentricity of the equipment, m, forward of the centre of gravity.
        m_1: mass of the equipment, kg.
        m_2: mass of the body, kg.
        m_3: mass of the rear wheels, kg.
        m_4: mass of the front wheels, kg.
        J_2: moment of inertia I of the body about the lateral axis, kg·m².
        k_3: stiffness below the equipment, N/m.
        k_4: stiffness of a suspension, N/m; there are two to an axle.
        k_5: stiffness of a tyre, N/m.
        c_3: damping below the equipment, N·s/m.
        c_4: damping of a suspension, N·s/m; there are two to an axle.
    """

    L_1: float
    L_2: float
    e: float
    m_1: float
    m_2: float
    m_3: float
    m_4: float
    J_2: float
    k_3: float
    k_4: float
    k_5: float
    c_3: float
    c_4: float


TABLE_1 = HalfCar(
    L_1=3.19,
    L_2=6.19,
    e=1.5,
    m_1=1000.0,
    m_2=13_000.0,
    m_3=170.0,
    m_4=170.0,
    J_2=124_566.0,
    k_3=1_000_000.0,
    k_4=2_500_000.0,
    k_5=1_434_000.0,
    c_3=790.0,
    c_4=1200.0,
)
"""Table 1; printed for c_3 and c_4 are 0.79 and 0.0012 N·s/m, which damp nothing."""


def forces(
    car: HalfCar, Y: npt.ArrayLike, Y_dot: npt.ArrayLike, u_1: float, u_2: float
) -> tuple[float, float, float, float, float]:
    """Compute the forces and the moment that accelerate the masses.

    Equation:
        (2) to (6), solved for m_1 ÿ_1, m_2 ÿ_2, m_3 ÿ_3, m_4 ÿ_4 and I θ̈.

    Args:
        car: parameters.
        Y: y_1 to y_4 in m and θ in rad, shape (5,).
        Y_dot: their rates, m/s and rad/s, shape (5,).
        u_1: road under the rear wheels, m.
        u_2: road under the front wheels, m.

    Returns:
        Four forces in N and a moment in N·m.
    """
    L_1, L_2, e, _, _, _, _, _, k_3, k_4, k_5, c_3, c_4 = car
    y_1, y_2, y_3, y_4, theta = (float(y) for y in np.asarray(Y, np.float64))
    v_1, v_2, v_3, v_4, omega = (float(v) for v in np.asarray(Y_dot, np.float64))
    k_2_theta = e * k_3 - 2 * L_1 * k_4 + 2 * k_4 * L_2
    c_2_theta = e * c_3 + 2 * c_4 * L_2 - 2 * c_4 * L_1
    equipment = -c_3 * v_1 + c_3 * v_2 + e * c_3 * omega - k_3 * y_1 + k_3 * y_2 + k_3 * e * theta
    body = c_3 * v_1 - (4 * c_4 + c_3) * v_2 + 2 * c_4 * v_3 + 2 * c_4 * v_4 - c_2_theta * omega
    body += k_3 * y_1 - (k_3 + 4 * k_4) * y_2 + 2 * k_4 * y_3 + 2 * k_4 * y_4 - k_2_theta * theta
    rear = 2 * c_4 * v_2 - 2 * c_4 * v_3 - 2 * c_4 * L_1 * omega
    rear += 2 * k_4 * y_2 - (2 * k_4 + k_5) * y_3 - 2 * k_4 * L_1 * theta + k_5 * u_1
    front = 2 * c_4 * v_2 - 2 * c_4 * v_4 + 2 * c_4 * L_2 * omega
    front += 2 * k_4 * y_2 - (2 * k_4 + k_5) * y_4 + 2 * k_4 * L_2 * theta + k_5 * u_2
    moment = e * c_3 * v_1 - c_2_theta * v_2 - 2 * c_4 * L_1 * v_3 + 2 * c_4 * L_2 * v_4
    moment -= (2 * c_4 * L_1**2 + 2 * c_4 * L_2**2 + e**2 * c_3) * omega
    moment += e * k_3 * y_1 - k_2_theta * y_2 - 2 * k_4 * L_1 * y_3 + 2 * k_4 * L_2 * y_4
    moment -= (2 * L_1**2 * k_4 + e**2 * k_3 + 2 * L_2**2 * k_4) * theta
    return equipment, body, rear, front, moment


def structure_of_equations(car: HalfCar = TABLE_1) -> Structure:
    """Read the matrices off the equations of motion.

    Equation:
        (2) to (6): column j of K and C is minus the forces under a unit of Y_j and of Ẏ_j, and
        k_5 S_p has the forces under a unit of u_1 and of u_2.

    Args:
        car: parameters.

    Returns:
        M, C, K, shape (5, 5), and S_p, shape (5, 2).
    """
    K, C, zero = np.zeros((5, 5)), np.zeros((5, 5)), np.zeros(5)
    for j in range(5):
        unit = np.zeros(5)
        unit[j] = 1.0
        K[:, j] = -np.array(forces(car, unit, zero, 0.0, 0.0))
        C[:, j] = -np.array(forces(car, zero, unit, 0.0, 0.0))
    by_road = [forces(car, zero, zero, 1.0, 0.0), forces(car, zero, zero, 0.0, 1.0)]
    M = np.diag([car.m_1, car.m_2, car.m_3, car.m_4, car.J_2])
    return Structure(M, C, K, np.array(by_road).T / car.k_5)


def structure(car: HalfCar = TABLE_1) -> Structure:
    """Write the matrices down.

    Equation:
        (7) with M, C, K and S_p as printed below it, but C[3,3] = 2c_4, where -2c_4 is printed.

    Args:
        car: parameters.

    Returns:
        M, C, K, shape (5, 5), and S_p, shape (5, 2), which acts on F = (k_5 u_1, k_5 u_2) in N.
    """
    L_1, L_2, e, m_1, m_2, m_3, m_4, J_2, k_3, k_4, k_5, c_3, c_4 = car
    C_25 = e * c_3 + 2 * c_4 * L_2 - 2 * c_4 * L_1
    C = [
        [c_3, -c_3, 0, 0, -e * c_3],
        [-c_3, 4 * c_4 + c_3, -2 * c_4, -2 * c_4, C_25],
        [0, -2 * c_4, 2 * c_4, 0, 2 * L_1 * c_4],
        [0, -2 * c_4, 0, 2 * c_4, -2 * L_2 * c_4],
        [
            -e * c_3,
            C_25,
            2 * L_1 * c_4,
            -2 * L_2 * c_4,
            2 * c_4 * L_1**2 + 2 * c_4 * L_2**2 + e**2 * c_3,
        ],
    ]
    K_25 = e * k_3 + 2 * L_2 * k_4 - 2 * L_1 * k_4
    K = [
        [k_3, -k_3, 0, 0, -e * k_3],
        [-k_3, k_3 + 4 * k_4, -2 * k_4, -2 * k_4, K_25],
        [0, -2 * k_4, 2 * k_4 + k_5, 0, 2 * L_1 * k_4],
        [0, -2 * k_4, 0, 2 * k_4 + k_5, -2 * L_2 * k_4],
        [
            -e * k_3,
            K_25,
            2 * L_1 * k_4,
            -2 * L_2 * k_4,
            e**2 * k_3 + 2 * L_1**2 * k_4 + 2 * L_2**2 * k_4,
        ],
    ]
    S_p = [[0, 0], [0, 0], [1, 0], [0, 1], [0, 0]]
    M = np.diag([m_1, m_2, m_3, m_4, J_2])
    return Structure(M, *(np.array(matrix, np.float64) for matrix in (C, K, S_p)))


def delay(v: float, car: HalfCar = TABLE_1) -> float:
    """Compute by how much the rear wheels come later.

    Equation:
        (8) Δt = (L_1 + L_2)/v

    Args:
        v: speed, m/s.
        car: parameters.

    Returns:
        Δt, s.

    Raises:
        ValueError: unless the vehicle drives forward.
    """
    if not v > 0:
        raise ValueError(f"at {v} m/s the rear wheels never come to where the front wheels are")
    return (car.L_1 + car.L_2) / v


def rear_road(u_2: npt.ArrayLike, dt: float, v: float, car: HalfCar = TABLE_1) -> Vector:
    """Derive the road under the rear wheels from that under the front wheels.

    Equation:
        (8) u_1(t) = u_2(t - Δt), between two samples on the straight line, and the first sample
        before all.

    Args:
        u_2: road under the front wheels, m, shape (N,).
        dt: time between two samples, s.
        v: speed, m/s.
        car: parameters.

    Returns:
        u_1, m, shape (N,).

    Raises:
        ValueError: unless the vehicle drives forward.
    """
    u, samples_late = np.asarray(u_2, np.float64), delay(v, car) / dt
    u_1 = np.zeros(len(u))
    for k in range(len(u)):
        place = max(k - samples_late, 0.0)
        j = int(place)
        after = min(j + 1, len(u) - 1)
        u_1[k] = u[j] + (place - j) * (u[after] - u[j])
    return u_1
