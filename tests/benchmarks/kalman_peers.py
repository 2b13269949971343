"""The seven-state model of appendix C in two peers of `bench_kalman.py`: filterpy and JAX.

Both filter at every sample and smooth by Rauch, Tung and Striebel, (6.17) to (6.22); the inputs
of a step are the means of its ends, as in ours. ``u`` has shape (6, n): specific force along and
angular rate about X, Y and Z.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

STATES = 7
"""Height, velocity, pitch, roll, biases of acceleration, roll rate and pitch rate, (C.2)."""


@dataclass(frozen=True, eq=False)
class Problem:
    """Inputs, readings and noise; `seen` tells at which samples there is a reading.

    ``rows``, shape (m, 8), holds height, velocity, pitch and roll, and their variances.
    """

    step: float
    gravity: float
    arm: np.ndarray
    process: np.ndarray
    start: np.ndarray
    variance: np.ndarray
    u: np.ndarray
    at: np.ndarray
    rows: np.ndarray

    @property
    def means(self) -> np.ndarray:
        """Inputs of the step that leads to each sample, shape (n, 6)."""
        before = np.concatenate((self.u[:, :1], self.u[:, :-1]), axis=1)
        return np.ascontiguousarray(0.5 * (before + self.u).T)

    @property
    def spectrum(self) -> np.ndarray:
        """Variances of the noise of one step: acceleration, rates, walks, shape (7,)."""
        return np.concatenate((self.process[:4] / self.step, self.process[4:] * self.step))


def step_of(p: Problem, xp: Any) -> Callable[[Any, Any], tuple[Any, Any, Any]]:
    """Return (6.47) with its derivatives by state (C.3) and noise (C.6), in numpy or JAX."""
    dt, half = p.step, 0.5 * p.step**2
    o, i = 0.0, 1.0

    def step(x: Any, u: Any) -> tuple[Any, Any, Any]:
        st, ct, sp, cp = xp.sin(x[2]), xp.cos(x[2]), xp.sin(x[3]), xp.cos(x[3])
        q1, q2, q3, tangent = u[3] + x[5], u[4] + x[6], u[5], st / ct
        across, along = sp * u[1] + cp * u[2], sp * q2 + cp * q3
        rise = ct * across - st * u[0] + x[4] - p.gravity
        by_3, by_4 = -ct * u[0] - st * across, ct * (cp * u[1] - sp * u[2])
        turn = cp * q2 - sp * q3
        moved = xp.stack(
            [
                x[0] + dt * x[1] + half * rise,
                x[1] + dt * rise,
                x[2] + dt * turn,
                x[3] + dt * (q1 + tangent * along),
                x[4],
                x[5],
                x[6],
            ]
        )
        f = [
            [i, dt, half * by_3, half * by_4, half, o, o],
            [o, i, dt * by_3, dt * by_4, dt, o, o],
            [o, o, i, -dt * along, o, o, dt * cp],
            [o, o, dt * along / (ct * ct), 1.0 + dt * turn * tangent, o, dt, dt * sp * tangent],
            [o, o, o, o, i, o, o],
            [o, o, o, o, o, i, o],
            [o, o, o, o, o, o, i],
        ]
        w = [
            [half, o, o, o, o, o, o],
            [dt, o, o, o, o, o, o],
            [o, o, dt * cp, -dt * sp, o, o, o],
            [o, dt, dt * sp * tangent, dt * cp * tangent, o, o, o],
            [o, o, o, o, i, o, o],
            [o, o, o, o, o, i, o],
            [o, o, o, o, o, o, i],
        ]
        return moved, xp.array(f), xp.array(w)

    return step


def reading_of(p: Problem, xp: Any) -> tuple[Callable[..., Any], Callable[..., Any]]:
    """Return what a reading is expected to be, (6.48), and its derivative, (C.8)."""
    lx, ly, lz = p.arm.tolist()

    def parts(x: Any, u: Any) -> tuple[Any, ...]:
        st, ct, sp, cp = xp.sin(x[2]), xp.cos(x[2]), xp.sin(x[3]), xp.cos(x[3])
        q1, q2, q3 = u[3] + x[5], u[4] + x[6], u[5]
        whirl = q2 * lz - q3 * ly, q3 * lx - q1 * lz, q1 * ly - q2 * lx
        return st, ct, sp, cp, *whirl

    def expected(x: Any, u: Any) -> Any:
        st, ct, sp, cp, wx, wy, wz = parts(x, u)
        height = x[0] - st * lx + ct * (sp * ly + cp * lz)
        velocity = x[1] - st * wx + ct * (sp * wy + cp * wz)
        return xp.stack([height, velocity, x[2], xp.arcsin(ct * sp)])

    def derivative(x: Any, u: Any) -> Any:
        st, ct, sp, cp, wx, wy, wz = parts(x, u)
        up, side, root = sp * ly + cp * lz, cp * ly - sp * lz, xp.sqrt(1.0 - (ct * sp) ** 2)
        o, i = 0.0, 1.0
        whirled, rolled = -ct * wx - st * (sp * wy + cp * wz), ct * (cp * wy - sp * wz)
        rows = [
            [i, o, -ct * lx - st * up, ct * side, o, o, o],
            [o, i, whirled, rolled, o, ct * side, -st * lz - ct * cp * lx],
            [o, o, i, o, o, o, o],
            [o, o, -st * sp / root, ct * cp / root, o, o, o],
        ]
        return xp.array(rows)

    return expected, derivative


def by_filterpy(p: Problem) -> np.ndarray:
    """Return the smoothed height by `ExtendedKalmanFilter` and `rts_smoother`."""
    from filterpy.kalman import ExtendedKalmanFilter, rts_smoother

    step, (expected, derivative) = step_of(p, np), reading_of(p, np)
    n, means, spectrum = p.u.shape[1], p.means, np.diag(p.spectrum)
    kalman = ExtendedKalmanFilter(STATES, 4)
    kalman.x, kalman.P = p.start.copy(), np.diag(p.variance)
    xs, ps = np.empty((n, STATES)), np.empty((n, STATES, STATES))
    fs, qs, ahead = np.empty_like(ps), np.empty_like(ps), np.empty_like(xs)
    rows = dict(zip(p.at.tolist(), p.rows, strict=True))
    for k in range(n):
        if k > 0:
            moved, kalman.F, w = step(kalman.x, means[k])
            kalman.Q = w @ spectrum @ w.T
            kalman.predict_x = lambda u, moved=moved: setattr(kalman, "x", moved)
            kalman.predict()
            fs[k - 1], qs[k - 1] = kalman.F, kalman.Q
        ahead[k] = kalman.x
        if k in rows:
            now = (p.u[:, k],)
            noise = np.diag(rows[k][4:])
            kalman.update(rows[k][:4], derivative, expected, noise, args=now, hx_args=now)
        xs[k], ps[k] = kalman.x, kalman.P
    fs[-1], qs[-1] = np.eye(STATES), np.zeros((STATES, STATES))
    return smoothed_linear(rts_smoother, xs, ps, fs, qs, ahead)


def smoothed_linear(
    smoother: Callable[..., Any],
    xs: np.ndarray,
    ps: np.ndarray,
    fs: np.ndarray,
    qs: np.ndarray,
    ahead: np.ndarray,
) -> np.ndarray:
    """Smooth with a smoother that takes F x for the prediction, which here is ``ahead``.

    Both agree for states told from a path c with c_(k+1) = F c_k + (prediction - F x_k).
    """
    path = np.zeros_like(xs)
    for k in range(len(xs) - 1):
        path[k + 1] = ahead[k + 1] + fs[k] @ (path[k] - xs[k])
    found = smoother(xs - path, ps, fs, qs)[0]
    return np.asarray(found[:, 0] + path[:, 0])


def by_jax(p: Problem) -> Callable[[], np.ndarray]:
    """Return a compiled scan forward and one backward that give the smoothed height."""
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    step, (expected, derivative) = step_of(p, jnp), reading_of(p, jnp)
    spectrum, unit = jnp.array(p.spectrum), jnp.eye(STATES)

    def observed(x: Any, cov: Any, u: Any, row: Any) -> tuple[Any, Any]:
        h = derivative(x, u)
        cross = cov @ h.T
        gain = jnp.linalg.solve(h @ cross + jnp.diag(row[4:]), cross.T).T
        left = unit - gain @ h
        return x + gain @ (row[:4] - expected(x, u)), left @ cov @ left.T + (
            gain * row[4:]
        ) @ gain.T

    def forth(state: Any, now: Any) -> tuple[Any, Any]:
        x, cov = state
        mean, u, seen, row = now
        moved, f, w = step(x, mean)
        spread = f @ cov @ f.T + (w * spectrum) @ w.T
        x, cov = jax.lax.cond(
            seen, lambda: observed(moved, spread, u, row), lambda: (moved, spread)
        )
        return (x, cov), (x, cov, moved, spread, f)

    def back(later: Any, now: Any) -> tuple[Any, Any]:
        x, cov, moved, spread, f = now
        gain = jnp.linalg.solve(spread, f @ cov).T
        x = x + gain @ (later - moved)
        return x, x[0]

    @jax.jit
    def smooth(means: Any, u: Any, seen: Any, rows: Any) -> Any:
        start = jnp.array(p.start), jnp.diag(jnp.array(p.variance))
        _, (xs, covs, moved, spread, fs) = jax.lax.scan(forth, start, (means, u, seen, rows))
        past = xs[:-1], covs[:-1], moved[1:], spread[1:], fs[1:]
        _, heights = jax.lax.scan(back, xs[-1], past, reverse=True)
        return jnp.append(heights, xs[-1, 0])

    n = p.u.shape[1] - 1
    seen, rows = np.zeros(n, bool), np.ones((n, 8))
    seen[p.at - 1], rows[p.at - 1] = True, p.rows
    given = [jnp.array(a) for a in (p.means[1:], p.u.T[1:], seen, rows)]
    return lambda: np.append(p.start[0], np.asarray(smooth(*given)))
