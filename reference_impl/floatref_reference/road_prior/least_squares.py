"""The posterior of the road prior from one least-squares problem, to hold the smoother to.

The unknowns are of unit variance and independent: each κ_j, the starts of r, v, b and z, and the
noise of every step. White noise w(s) on 0 ≤ s ≤ Δt shows in a step by its coordinates ξ_0, ξ_1 and
ξ_2 along the first Legendre polynomials, normalized to the step:

    ∫ w = √Δt ξ_0,  ∬ w = Δt √Δt (ξ_0/2 + ξ_1/(2√3)),
    ∭ w = Δt² √Δt (ξ_0/6 + ξ_1/(4√3) + ξ_2/(12√5)).

So each state is an affine function of the unknowns, here a row of their factors whose last entry is
the constant. Heights are rows in the unknowns too, and the solution needs no covariance, no
inverse of one, and nothing from `model`.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from floatref_reference.road_prior.symbols import Constants, Matrix, Recorded, Stack, Vector


class Posterior(NamedTuple):
    """Means of all states, and the root of all covariances between them.

    Equation:
        cov(x_k, x_l) = root_k root_lᵀ

    Attributes:
        x: states in the order of the smoother's, shape (N, ns).
        root: shape (N, ns, M) of M unknowns.
    """

    x: Matrix
    root: Stack


def white_noise(fresh: Matrix, dt: float) -> tuple[Vector, Vector, Vector]:
    """Integrate white noise of unit density over a step, up to three times.

    Equation:
        ∫ w, ∬ w and ∭ w as above

    Args:
        fresh: ξ_0, ξ_1 and ξ_2 as rows, shape (3, M + 1).
        dt: Δt, s.

    Returns:
        The three integrals as rows, shape (M + 1,) each.
    """
    root = np.sqrt(dt)
    once = root * fresh[0]
    twice = dt * root * (fresh[0] / 2 + fresh[1] / (2 * np.sqrt(3)))
    thrice = fresh[0] / 6 + fresh[1] / (4 * np.sqrt(3)) + fresh[2] / (12 * np.sqrt(5))
    return once, twice, dt**2 * root * thrice


def advance(
    state: Matrix, force: Matrix, run: Recorded, k: int, c: Constants, fresh: Matrix
) -> Matrix:
    """Advance r, v, b and z of a track by one step.

    Equation:
        With f = a_m - Σ κ_j u_j linear in time: v ← v + ∫f - Δt b + ∫w_a - ∬w_b,
        r ← r + Δt v + ∬f - (Δt²/2) b + ∬w_a - ∭w_b, b ← b + ∫w_b, z ← α z + √(1 - α²) σ_z ξ
        with α = e^{-ΔX/λ_p} and σ_z² = q λ_p/2

    Args:
        state: r, v, b and z at k as rows, shape (4, M + 1).
        force: f at k and at k + 1 as rows, shape (2, M + 1).
        run: the recording.
        k: sample before the step.
        c: constants.
        fresh: six unknowns of this step as rows, shape (6, M + 1).

    Returns:
        r, v, b and z at k + 1, shape (4, M + 1).
    """
    r, v, b, z = state
    dt, dx = run.t[k + 1] - run.t[k], run.distance[k + 1] - run.distance[k]
    squares = (run.a_x[k] ** 2 + run.a_x[k + 1] ** 2) / 2
    a_1, a_2, _ = c.sigma_a * np.array(white_noise(fresh[[0, 1, 1]], dt))
    b_1, b_2, b_3 = np.hypot(c.sigma_b0, c.sigma_b1 * np.sqrt(squares)) * np.array(
        white_noise(fresh[2:5], dt)
    )
    r_next = r + dt * v + dt**2 * (force[0] / 3 + force[1] / 6 - b / 2) + a_2 - b_3
    v_next = v + dt * ((force[0] + force[1]) / 2 - b) + a_1 - b_2
    new = np.sqrt(-np.expm1(-2 * dx / c.lambda_p) * c.q * c.lambda_p / 2)
    return np.array([r_next, v_next, b + b_1, np.exp(-dx / c.lambda_p) * z + new * fresh[5]])


def all_states(run: Recorded, c: Constants) -> Stack:
    """Write every state as a function of the unknowns.

    Equation:
        The starts 0 + σ ξ, κ_j = 0 + σ_κ ξ, and then step by step

    Args:
        run: the recording.
        c: constants.

    Returns:
        Rows of all states at all samples, shape (N, ns, M + 1).
    """
    n, N, J = run.u.shape
    K = J if run.shared else n * J
    M = K + n * (4 + 6 * (N - 1))
    unknown: Iterator[Vector] = iter(np.eye(M, M + 1))
    sigma_kappa = np.resize(np.asarray(c.sigma_kappa, np.float64), K)
    kappa = np.array([sigma * next(unknown) for sigma in sigma_kappa]).reshape(K, M + 1)
    starts = [c.sigma_r, c.sigma_v, c.sigma_b, np.sqrt(c.q * c.lambda_p / 2)]
    rows = np.zeros((N, 4 * n + K, M + 1))
    rows[:, 4 * n :] = kappa
    for i in range(n):
        own, track = kappa if run.shared else kappa[i * J : i * J + J], slice(4 * i, 4 * i + 4)
        force = -run.u[i] @ own
        force[:, -1] += run.a_m[i]
        rows[0, track] = [sigma * next(unknown) for sigma in starts]
        for k in range(N - 1):
            fresh = np.array([next(unknown) for _ in range(6)])
            rows[k + 1, track] = advance(rows[k, track], force[k : k + 2], run, k, c, fresh)
    return rows


def least_squares(run: Recorded, c: Constants) -> Posterior:
    """Solve for all unknowns of a short run at once.

    Equation:
        min |ξ|² + Σ (h - r + z)²/σ_h² by the QR factors of its design; cov ξ = (RᵀR)⁻¹

    Args:
        run: the recording; the work grows with the cube of its length.
        c: constants.

    Returns:
        Means and the root of the covariances of all states.
    """
    rows = all_states(run, c)
    there = ~np.isnan(run.h.T)
    height = (rows[:, 0 : 4 * len(run.u) : 4] - rows[:, 3 : 4 * len(run.u) : 4])[there] / c.sigma_h
    M = rows.shape[2] - 1
    design = np.vstack([np.eye(M), height[:, :M]])
    right = np.concatenate([np.zeros(M), run.h.T[there] / c.sigma_h - height[:, M]])
    Q, triangle = np.linalg.qr(design)
    root = rows[:, :, :M] @ np.linalg.inv(triangle)
    return Posterior(rows[:, :, M] + root @ (Q.T @ right), root)


def deviation(posterior: Posterior, weights: Stack) -> Vector:
    """Compute the deviation of sums over the whole run, as a filter of the profile forms them.

    Equation:
        σ² of Σ_k w_kᵀ x_k is |Σ_k w_kᵀ root_k|²

    Args:
        posterior: what `least_squares` returned.
        weights: w_k of m sums, shape (m, N, ns).

    Returns:
        Their standard deviations, shape (m,).
    """
    sums = np.einsum("mks,ksj->mj", weights, posterior.root)
    return np.array([np.sqrt(np.sum(row**2)) for row in sums])
