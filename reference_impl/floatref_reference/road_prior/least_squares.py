"""The posterior of the road prior from one least-squares problem, to hold the smoother to.

The unknowns are of unit variance and independent: each κ_j, the starts of r, v, b, z and s, and the
noise of every step. White noise w(t) on 0 ≤ t ≤ Δt shows in a step by its coordinates ξ_0, ξ_1 and
ξ_2 along the first Legendre polynomials, normalized to the step:

    ∫ w = √Δt ξ_0,  ∬ w = Δt √Δt (ξ_0/2 + ξ_1/(2√3)),
    ∭ w = Δt² √Δt (ξ_0/6 + ξ_1/(4√3) + ξ_2/(12√5)).

The road's noise enters with weights, e^{-τ/λ_p} into s and also τ e^{-τ/λ_p} into z, at the
distance τ before the end of a step. Its coordinates are along these functions made orthogonal by
the QR factors of their samples. Before the start τ has no end, and Laguerre functions, of weight
e^{-2τ/λ_p}, are orthogonal there already.

So each state is an affine function of the unknowns, here a row of their factors whose last entry is
the constant. Heights are rows in the unknowns too, and the solution needs no covariance, no
inverse of one, and nothing from `model`.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from floatref_reference.road_prior.symbols import Constants, Matrix, Recorded, Stack, Vector

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(64)


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


def start_of_road(fresh: Matrix, c: Constants) -> tuple[Vector, Vector]:
    """Gather the noise of all the road before the start.

    Equation:
        As (2/λ_p) ∫ L_i L_j e^{-2τ/λ_p} dτ over τ ≥ 0 is 1 for i = j and else 0, L_0 = 1 and
        L_1 = 1 - 2τ/λ_p, s = √(g λ_p/2) ξ_1 and
        z = √(q λ_p/2) ξ_0 + √(g λ_p/2) (λ_p/2) (ξ_1 - ξ_2)

    Args:
        fresh: ξ_0 of W_q, ξ_1 and ξ_2 of W_g as rows, shape (3, M + 1).
        c: constants.

    Returns:
        z and s as rows, shape (M + 1,) each.
    """
    of_q, of_g = np.sqrt(c.q * c.lambda_p / 2), np.sqrt(c.g * c.lambda_p / 2)
    z = of_q * fresh[0] + of_g * c.lambda_p / 2 * (fresh[1] - fresh[2])
    return z, of_g * fresh[1]


def noise_of_road(fresh: Matrix, dx: float, c: Constants) -> tuple[Vector, Vector]:
    """Gather the noise of the road over a step.

    Equation:
        ∫ f dW = Σ_m f(τ_m) √w_m ξ_m at Gauss's points τ_m and weights w_m in 0 ≤ τ ≤ ΔX, for
        f of e^{-τ/λ_p} and of τ e^{-τ/λ_p}. With the rows f(τ_m) √w_m of both, transposed, as QR,
        Rᵀ holds their coordinates.

    Args:
        fresh: one unknown of W_q and two of W_g as rows, shape (3, M + 1).
        dx: ΔX, m, up to some 50 λ_p.
        c: constants.

    Returns:
        What is new in z and s, as rows, shape (M + 1,) each.
    """
    tau, weight = dx * (1 + POINTS) / 2, dx * WEIGHTS / 2
    decayed = np.exp(-tau / c.lambda_p) * np.sqrt(weight)
    _, R = np.linalg.qr(np.transpose([decayed, tau * decayed]))
    into_s, into_z = np.sqrt(c.g) * R.T @ fresh[1:]
    return np.sqrt(c.q) * np.linalg.norm(decayed) * fresh[0] + into_z, into_s


def advance(
    state: Matrix, force: Matrix, run: Recorded, k: int, c: Constants, fresh: Matrix
) -> Matrix:
    """Advance r, v, b, z and s of a track by one step.

    Equation:
        With f = a_m - Σ κ_j u_j linear in time: v ← v + ∫f - Δt b + ∫w_a - ∬w_b,
        r ← r + Δt v + ∬f - (Δt²/2) b + ∬w_a - ∭w_b, b ← b + ∫w_b, and with the noise of the road
        z ← α (z + ΔX s) + its part in z, s ← α s + its part in s, α = e^{-ΔX/λ_p}

    Args:
        state: r, v, b, z and s at k as rows, shape (5, M + 1).
        force: f at k and at k + 1 as rows, shape (2, M + 1).
        run: the recording.
        k: sample before the step.
        c: constants.
        fresh: eight unknowns of this step as rows, shape (8, M + 1).

    Returns:
        r, v, b, z and s at k + 1, shape (5, M + 1).
    """
    r, v, b, z, s = state
    dt, dx = run.t[k + 1] - run.t[k], run.distance[k + 1] - run.distance[k]
    squares = (run.a_x[k] ** 2 + run.a_x[k + 1] ** 2) / 2
    a_1, a_2, _ = c.sigma_a * np.array(white_noise(fresh[[0, 1, 1]], dt))
    b_1, b_2, b_3 = np.hypot(c.sigma_b0, c.sigma_b1 * np.sqrt(squares)) * np.array(
        white_noise(fresh[2:5], dt)
    )
    r_next = r + dt * v + dt**2 * (force[0] / 3 + force[1] / 6 - b / 2) + a_2 - b_3
    v_next = v + dt * ((force[0] + force[1]) / 2 - b) + a_1 - b_2
    alpha, (new_z, new_s) = np.exp(-dx / c.lambda_p), noise_of_road(fresh[5:], dx, c)
    z_next, s_next = alpha * (z + dx * s) + new_z, alpha * s + new_s
    return np.array([r_next, v_next, b + b_1, z_next, s_next])


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
    M = K + n * (6 + 8 * (N - 1))
    unknown: Iterator[Vector] = iter(np.eye(M, M + 1))
    sigma_kappa = np.resize(np.asarray(c.sigma_kappa, np.float64), K)
    kappa = np.array([sigma * next(unknown) for sigma in sigma_kappa]).reshape(K, M + 1)
    starts = [c.sigma_r, c.sigma_v, c.sigma_b]
    rows = np.zeros((N, 5 * n + K, M + 1))
    rows[:, 5 * n :] = kappa
    for i in range(n):
        own, track = kappa if run.shared else kappa[i * J : i * J + J], slice(5 * i, 5 * i + 5)
        force = -run.u[i] @ own
        force[:, -1] += run.a_m[i]
        still = [sigma * next(unknown) for sigma in starts]
        road = start_of_road(np.array([next(unknown) for _ in range(3)]), c)
        rows[0, track] = [*still, *road]
        for k in range(N - 1):
            fresh = np.array([next(unknown) for _ in range(8)])
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
    tracks = 5 * len(run.u)
    height = (rows[:, 0:tracks:5] - rows[:, 3:tracks:5])[there] / c.sigma_h
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
