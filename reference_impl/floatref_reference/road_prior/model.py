"""The linear model of the road-prior smoother, from one sample to the next.

The state is (r, v, b, z, s) of each track, one track after the other, and then the κ_j: all J of
them once if the tracks share them, else those of the first track, of the second and so on.

Between two samples Δt apart, a_m and u_j are linear in time, and the squared density of w_b is
the mean of its squares at both ends. With that the discretization is exact: no noise is held, and
steps can be split. The road changes only by the distance ΔX between the samples, at any speed,
and `road` defines how.
"""

import numpy as np

from floatref_reference.road_prior.road import road_noise, road_prior, road_transition
from floatref_reference.road_prior.symbols import Constants, Matrix, Recorded, Vector


def states(run: Recorded) -> int:
    """Count the states.

    Equation:
        ns = 5n + J with shared, 5n + nJ with separate κ_j

    Args:
        run: the recording.

    Returns:
        ns.
    """
    n, J = len(run.u), int(run.u.shape[2])
    return 5 * n + (J if run.shared else n * J)


def kappa(run: Recorded, i: int) -> slice:
    """Find the κ_j of a track in the state.

    Equation:
        The order of the state.

    Args:
        run: the recording.
        i: track, 0 to n - 1.

    Returns:
        Their J places.
    """
    J, start = run.u.shape[2], 5 * len(run.u)
    if not run.shared:
        start += i * J
    return slice(start, start + J)


def integrals(f_0: Vector, f_1: Vector, dt: float) -> tuple[Vector, Vector]:
    """Integrate a linear signal once and twice over a step.

    Equation:
        ∫ f = Δt (f_0 + f_1)/2, ∬ f = Δt² (f_0/3 + f_1/6)

    Args:
        f_0: values at the start of the step, any shape.
        f_1: values at its end, of that shape.
        dt: Δt, s.

    Returns:
        ∫ f and ∬ f.
    """
    return dt * (f_0 + f_1) / 2, dt**2 * (f_0 / 3 + f_1 / 6)


def transition(run: Recorded, k: int, c: Constants) -> Matrix:
    """Compute how the state at k enters that at k + 1.

    Equation:
        r ← r + Δt v - (Δt²/2) b - Σ κ_j ∬u_j, v ← v - Δt b - Σ κ_j ∫u_j, b ← b, κ ← κ, and
        z and s by `road_transition`

    Args:
        run: the recording.
        k: sample before the step, 0 to N - 2.
        c: constants.

    Returns:
        F_k, shape (ns, ns).
    """
    dt = float(run.t[k + 1] - run.t[k])
    road = road_transition(float(run.distance[k + 1] - run.distance[k]), c)
    F = np.eye(states(run))
    for i in range(len(run.u)):
        r, v, b, z, s = range(5 * i, 5 * i + 5)
        once, twice = integrals(run.u[i, k], run.u[i, k + 1], dt)
        F[r, v] = dt
        F[r, b] = -(dt**2) / 2
        F[v, b] = -dt
        F[z : s + 1, z : s + 1] = road
        F[r, kappa(run, i)] = -twice
        F[v, kappa(run, i)] = -once
    return F


def known_input(run: Recorded, k: int) -> Vector:
    """Compute what the accelerometer adds to the state at k + 1.

    Equation:
        r ← r + ∬a_m, v ← v + ∫a_m

    Args:
        run: the recording.
        k: sample before the step, 0 to N - 2.

    Returns:
        g_k, shape (ns,).
    """
    g = np.zeros(states(run))
    for i in range(len(run.u)):
        once, twice = integrals(run.a_m[i, k], run.a_m[i, k + 1], float(run.t[k + 1] - run.t[k]))
        g[5 * i], g[5 * i + 1] = twice, once
    return g


def process_noise(run: Recorded, k: int, c: Constants) -> Matrix:
    """Compute the covariance of what noise adds to the state at k + 1.

    Equation:
        On (r, v, b), w_a gives σ_a² of [Δt³/3, Δt²/2; Δt²/2, Δt], w_b gives σ_b² of
        [Δt⁵/20, Δt⁴/8, -Δt³/6; Δt⁴/8, Δt³/3, -Δt²/2; -Δt³/6, -Δt²/2, Δt], where
        σ_b² = σ_b0² + σ_b1² (a_x,k² + a_x,k+1²)/2; on (z, s) `road_noise`.

    Args:
        run: the recording.
        k: sample before the step, 0 to N - 2.
        c: constants.

    Returns:
        Q_k, shape (ns, ns).
    """
    t = float(run.t[k + 1] - run.t[k])
    road = road_noise(float(run.distance[k + 1] - run.distance[k]), c)
    sigma_b2 = c.sigma_b0**2 + c.sigma_b1**2 * (run.a_x[k] ** 2 + run.a_x[k + 1] ** 2) / 2
    white = np.array([[t**3 / 3, t**2 / 2, 0], [t**2 / 2, t, 0], [0, 0, 0]])
    walk = np.array(
        [
            [t**5 / 20, t**4 / 8, -(t**3) / 6],
            [t**4 / 8, t**3 / 3, -(t**2) / 2],
            [-(t**3) / 6, -(t**2) / 2, t],
        ]
    )
    Q = np.zeros((states(run), states(run)))
    for i in range(len(run.u)):
        Q[5 * i : 5 * i + 3, 5 * i : 5 * i + 3] = c.sigma_a**2 * white + sigma_b2 * walk
        Q[5 * i + 3 : 5 * i + 5, 5 * i + 3 : 5 * i + 5] = road
    return Q


def observation(run: Recorded) -> Matrix:
    """Compute how the state shows in the heights.

    Equation:
        h = r - z + n for each track

    Args:
        run: the recording.

    Returns:
        H, shape (n, ns).
    """
    H = np.zeros((len(run.u), states(run)))
    for i in range(len(run.u)):
        H[i, 5 * i], H[i, 5 * i + 3] = 1, -1
    return H


def prior(run: Recorded, c: Constants) -> Matrix:
    """Compute the covariance of the state at the first sample, where its mean is 0.

    Equation:
        diag(σ_r², σ_v², σ_b²) and `road_prior` of each track, and σ_κ² of every κ_j

    Args:
        run: the recording.
        c: constants.

    Returns:
        P_0, shape (ns, ns).
    """
    P = np.zeros((states(run), states(run)))
    variances = [c.sigma_r**2, c.sigma_v**2, c.sigma_b**2]
    for i in range(len(run.u)):
        P[5 * i : 5 * i + 3, 5 * i : 5 * i + 3] = np.diag(variances)
        P[5 * i + 3 : 5 * i + 5, 5 * i + 3 : 5 * i + 5] = road_prior(c)
        J = kappa(run, i)
        P[J, J] = np.diag(np.broadcast_to(np.asarray(c.sigma_kappa) ** 2, J.stop - J.start))
    return P
