"""3 Mathematical Formulation: from continuous to discrete time.

(12) holds the force for a step. A road is smoother than that: on a straight line between samples
is the first-order hold, which the print does not have.
"""

import numpy as np

from floatref_reference.zhu_2021.symbols import Matrix, System


def precise_integration(H: Matrix, N: int = 20) -> Matrix:
    """Compute an exponential without losing the digits of its small increment.

    Equation:
        exp(H) of (12) by the method of its reference [16]: with h = H/2^N,
        T_a = h + h²/2 + h³/6 + h⁴/24, then N times T_a <- 2 T_a + T_a T_a, and exp(H) = I + T_a.
        I is added last, since next to it the digits of T_a would be rounded off.

    Args:
        H: square matrix.
        N: number of doublings.

    Returns:
        exp(H), of the same shape.
    """
    h = H / 2**N
    T_a = h + h @ h / 2 + h @ h @ h / 6 + h @ h @ h @ h / 24
    for _ in range(N):
        T_a = 2 * T_a + T_a @ T_a
    T: Matrix = np.eye(len(H)) + T_a
    return T


def input_matrix(A: Matrix, B: Matrix, dt: float) -> Matrix:
    """Compute how a force acts that stays for the step, as printed.

    Equation:
        (12) B_c = (A_c - I) A⁻¹ B with A_c = exp(A Δt)

    Args:
        A: state matrix of (9), shape (ns, ns); its inverse has to exist.
        B: input matrix of (9), shape (ns, p).
        dt: time step Δt, s.

    Returns:
        B_c, shape (ns, p).

    Raises:
        numpy.linalg.LinAlgError: if A is singular, as when a vehicle can move without a spring.
    """
    A_c = precise_integration(A * dt)
    return (A_c - np.eye(len(A))) @ np.linalg.inv(A) @ B


def zero_order_hold(A: Matrix, B: Matrix, dt: float) -> tuple[Matrix, Matrix]:
    """Carry the state over one step of constant force, whether or not A has an inverse.

    Equation:
        (12) with [A_c B_c; 0 I] = exp([A B; 0 0] Δt), which is `input_matrix` where that exists.

    Args:
        A: state matrix of (9), shape (ns, ns).
        B: input matrix of (9), shape (ns, p).
        dt: time step Δt, s.

    Returns:
        A_c, shape (ns, ns), and B_c, shape (ns, p).
    """
    ns, p = B.shape
    augmented = np.zeros((ns + p, ns + p))
    augmented[:ns, :ns], augmented[:ns, ns:] = A, B
    T = precise_integration(augmented * dt)
    return T[:ns, :ns], T[:ns, ns:]


def first_order_hold(A: Matrix, B: Matrix, dt: float) -> tuple[Matrix, Matrix, Matrix]:
    """Carry the state over one step in which the force moves on a straight line.

    Equation:
        X_{k+1} = A_c X_k + Γ_1 F_k + Γ_2 (F_{k+1} - F_k) with
        [A_c Γ_1 Γ_2; 0 I I; 0 0 I] = exp([A Δt, B Δt, 0; 0 0 I; 0 0 0]). Γ_1 is B_c of (12).

    Args:
        A: state matrix of (9), shape (ns, ns).
        B: input matrix of (9), shape (ns, p).
        dt: time step Δt, s.

    Returns:
        A_c, shape (ns, ns), Γ_1 and Γ_2, shape (ns, p).
    """
    ns, p = B.shape
    augmented = np.zeros((ns + 2 * p, ns + 2 * p))
    augmented[:ns, :ns], augmented[:ns, ns : ns + p] = A * dt, B * dt
    augmented[ns : ns + p, ns + p :] = np.eye(p)
    T = precise_integration(augmented)
    return T[:ns, :ns], T[:ns, ns : ns + p], T[:ns, ns + p :]


def system(A: Matrix, B: Matrix, G: Matrix, J: Matrix, dt: float) -> System:
    """Put the discrete model together that holds the force for each step.

    Equation:
        (12) and (13)

    Args:
        A: state matrix of (9), shape (ns, ns).
        B: input matrix of (9), shape (ns, p).
        G: output influence of (11), shape (nm, ns).
        J: direct transmission of (11), shape (nm, p).
        dt: time step Δt, s.

    Returns:
        A_c, B_c, G and J.
    """
    return System(*zero_order_hold(A, B, dt), G, J)


def first_order_system(
    A: Matrix, B: Matrix, G: Matrix, J: Matrix, dt: float
) -> tuple[System, Matrix]:
    """Put the discrete model together that moves the force on a straight line.

    Equation:
        With ξ_k = X_k - Γ_2 F_k, `first_order_hold` has the form of (12) and (13):
        ξ_{k+1} = A_c ξ_k + (A_c Γ_2 + Γ_1 - Γ_2) F_k, Z_k = G ξ_k + (J + G Γ_2) F_k.

    Args:
        A: state matrix of (9), shape (ns, ns).
        B: input matrix of (9), shape (ns, p).
        G: output influence of (11), shape (nm, ns).
        J: direct transmission of (11), shape (nm, p).
        dt: time step Δt, s.

    Returns:
        The model of ξ, and Γ_2, shape (ns, p), with which X = ξ + Γ_2 F.
    """
    A_c, Gamma_1, Gamma_2 = first_order_hold(A, B, dt)
    B_xi = A_c @ Gamma_2 + Gamma_1 - Gamma_2
    return System(A_c, B_xi, G, J + G @ Gamma_2), Gamma_2
