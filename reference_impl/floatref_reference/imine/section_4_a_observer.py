"""IV.A Observer Design: observer of the state, estimator of the road."""

from floatref_reference.imine.section_2_trailer import Matrix, Vector
from floatref_reference.imine.section_4_state_form import StateForm


def estimator(x: Vector, u: Vector, z_ddot: Vector, form: StateForm) -> Vector:
    """Compute how the estimated road goes on.

    Equation:
        (11) dū/dt = A_2 x̄_1 + C_2 ū + D_2 (z̈_1, z̈_2)

    Args:
        x: x̄_1, shape (10,).
        u: ū, m, shape (2,).
        z_ddot: measured accelerations of the wheels z̈_1, z̈_2, m/s², shape (2,).
        form: matrices of (9).

    Returns:
        dū/dt, m/s, shape (2,).
    """
    return form.A_2 @ x + form.C_2 @ u + form.D_2 @ z_ddot


def observer(
    x: Vector,
    u: Vector,
    u_dot: Vector,
    y: Vector,
    form: StateForm,
    G: Matrix,
    C_prime: Matrix,
) -> Vector:
    """Compute how the estimated state goes on.

    Equation:
        (10) dx̄_1/dt = A x̄_1 + C_1 ū + D_1 dū/dt + G (y - C' x̄_1), where y = C' x_1

    Args:
        x: x̄_1, shape (10,).
        u: ū, m, shape (2,).
        u_dot: dū/dt of (11), m/s, shape (2,).
        y: what is measured of the state, shape (nm,).
        form: matrices of (8).
        G: gains, 1/s and 1/s², shape (10, nm).
        C_prime: C', shape (nm, 10).

    Returns:
        dx̄_1/dt, shape (10,).
    """
    return form.A @ x + form.C_1 @ u + form.D_1 @ u_dot + G @ (y - C_prime @ x)
