"""C.3 to C.6: linearized state transition and process noise."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import Inputs, Matrix, State, abbreviations


def matrix_a(x: npt.ArrayLike, u: npt.ArrayLike, dt: float) -> Matrix:
    """Differentiate the process model with respect to the state.

    Equation:
        (C.3) with (C.4): A of (6.11) and (6.18), that is ∂f/∂x of (6.47), as printed.

    Args:
        x: state of (C.2), shape (7,).
        u: inputs u_ax, u_ay, u_az in m/s² and u_ω1, u_ω2, u_ω3 in rad/s, shape (6,).
        dt: time step Δt, s.

    Returns:
        A, shape (7, 7).
    """
    state, u_k = State(*np.asarray(x, np.float64)), Inputs(*np.asarray(u, np.float64))
    s_theta, c_theta, s_phi, c_phi = abbreviations(state.theta, state.phi)
    a_13, a_14, a_23, a_24, a_34, a_43, a_44 = elements_of_a(state, u_k, dt)
    return np.array(
        [
            [1, dt, a_13, a_14, dt**2 / 2, 0, 0],
            [0, 1, a_23, a_24, dt, 0, 0],
            [0, 0, 1, a_34, 0, 0, c_phi * dt],
            [0, 0, a_43, a_44, 0, dt, s_theta * s_phi * dt / c_theta],
            [0, 0, 0, 0, 1, 0, 0],
            [0, 0, 0, 0, 0, 1, 0],
            [0, 0, 0, 0, 0, 0, 1],
        ]
    )


def elements_of_a(x: State, u: Inputs, dt: float) -> tuple[float, ...]:
    """Compute those elements of A that depend on the inputs.

    Equation:
        (C.4) A[1,3] = (-c_θ u_ax - s_θ s_φ u_ay - s_θ c_φ u_az) Δt²/2,
        A[1,4] = c_θ (c_φ u_ay - s_φ u_az) Δt²/2, A[2,3] and A[2,4] the same with Δt for Δt²/2,
        A[3,4] = -Δt (s_φ (u_ω2 + δ_ω2) + c_φ u_ω3),
        A[4,3] = (c_φ u_ω3 + s_φ (u_ω2 + δ_ω2)) Δt / c_θ²,
        A[4,4] = 1 + (c_φ (u_ω2 + δ_ω2) - s_φ u_ω3) s_θ Δt / c_θ

    Args:
        x: state of (C.2).
        u: inputs.
        dt: time step Δt, s.

    Returns:
        A[1,3], A[1,4], A[2,3], A[2,4], A[3,4], A[4,3], A[4,4].
    """
    s_theta, c_theta, s_phi, c_phi = abbreviations(x.theta, x.phi)
    omega_2 = u.u_2 + x.delta_2
    by_theta = -c_theta * u.u_ax - s_theta * s_phi * u.u_ay - s_theta * c_phi * u.u_az
    by_phi = c_theta * (c_phi * u.u_ay - s_phi * u.u_az)
    return (
        by_theta * dt**2 / 2,
        by_phi * dt**2 / 2,
        by_theta * dt,
        by_phi * dt,
        -dt * (s_phi * omega_2 + c_phi * u.u_3),
        (c_phi * u.u_3 + s_phi * omega_2) * dt / c_theta**2,
        1 + (c_phi * omega_2 - s_phi * u.u_3) * s_theta * dt / c_theta,
    )


def matrix_q(sigma: npt.ArrayLike) -> Matrix:
    """Compute the covariance of the process noise.

    Equation:
        (C.5) Q of (6.4) = diag(σ_a², σ_ω1², σ_ω2², σ_ω3², σ_a'², σ_ω'1², σ_ω'2²)

    Args:
        sigma: standard deviations per time step in this order: m/s², three in rad/s, m/s² and
            two in rad/s, shape (7,).

    Returns:
        Q, shape (7, 7).
    """
    return np.diag(np.asarray(sigma, np.float64) ** 2)


def matrix_w(x: npt.ArrayLike, dt: float) -> Matrix:
    """Differentiate the process model with respect to the noise.

    Equation:
        (C.6) W of (6.12) and (6.21), that is ∂f/∂w of (6.47), as printed.

    Args:
        x: state of (C.2), shape (7,).
        dt: time step Δt, s.

    Returns:
        W, shape (7, 7), its columns in the order of (C.5).
    """
    state = State(*np.asarray(x, np.float64))
    s_theta, c_theta, s_phi, c_phi = abbreviations(state.theta, state.phi)
    w_43, w_44 = s_theta * s_phi * dt / c_theta, s_theta * c_phi * dt / c_theta
    return np.array(
        [
            [dt**2 / 2, 0, 0, 0, 0, 0, 0],
            [dt, 0, 0, 0, 0, 0, 0],
            [0, 0, c_phi * dt, -s_phi * dt, 0, 0, 0],
            [0, dt, w_43, w_44, 0, 0, 0],
            [0, 0, 0, 0, 1, 0, 0],
            [0, 0, 0, 0, 0, 1, 0],
            [0, 0, 0, 0, 0, 0, 1],
        ]
    )
