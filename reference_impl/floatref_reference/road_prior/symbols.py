"""Symbols of the road-prior smoother: recorded signals, and constants with physical units."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]
Matrix = npt.NDArray[np.float64]
Stack = npt.NDArray[np.float64]


class Constants(NamedTuple):
    """Constants of the model; noise as densities, so that they hold at any sampling rate.

    Equation:
        (2.4) and (2.2): the spectrum G_s/(2πν)² over ν > 0 is that of a random walk over distance
        with the variance G_s/2 per metre, so q = G_s/2; q = 1e-5 m is the normal road of Table 2.2.
        G_a/(2πν)⁴ is that of a road whose slope is such a walk, so g = G_a/2.

    Attributes:
        sigma_a: density of w_a, m/s²/√Hz, both sides: integrated over τ s it deviates by σ_a √τ.
        sigma_b0: density of w_b at a_x = 0, m/s²/√s: b deviates by σ_b0 √τ after τ s.
        sigma_b1: what |a_x| adds to it in quadrature, 1/√s per m/s² of bias and of a_x.
        sigma_h: deviation of n, m, of every laser sample.
        q: intensity of the road's elevation, m²/m.
        g: intensity of the slope of its long waves, 1/m. It has to be positive: without it s is
            known to be 0, and no covariance with s can be inverted.
        lambda_p: distance after which elevation and slope are forgotten, m.
        sigma_r: deviation of r at the start, m, about 0.
        sigma_v: deviation of v at the start, m/s, about 0.
        sigma_b: deviation of b at the start, m/s², about 0.
        sigma_kappa: deviation of every κ_j, about 0: one for all, or one for each j.
    """

    sigma_a: float = 2e-4
    sigma_b0: float = 2e-4
    sigma_b1: float = 3e-3
    sigma_h: float = 1e-4
    q: float = 4e-6
    g: float = 1e-7
    lambda_p: float = 60.0
    sigma_r: float = 1.0
    sigma_v: float = 1.0
    sigma_b: float = 0.1
    sigma_kappa: float | tuple[float, ...] = 0.05


class Recorded(NamedTuple):
    """What n tracks recorded at N common times.

    Equation:
        a_m, V, u_j and h of the model. V is here by its integral, the travel distance.

    Attributes:
        t: time, s, increasing, shape (N,).
        distance: travel distance ∫V dt, m, non-decreasing, shape (N,).
        a_m: vertical accelerometer with 1 g removed, m/s², shape (n, N).
        h: height, m, NaN where the laser has no sample, shape (n, N).
        u: known inputs, shape (n, N, J); κ_j u_j is in m/s².
        a_x: longitudinal acceleration, m/s², shape (N,).
        shared: whether the tracks have each κ_j in common.
    """

    t: Vector
    distance: Vector
    a_m: Matrix
    h: Matrix
    u: Stack
    a_x: Vector
    shared: bool


def recorded(
    t: npt.ArrayLike,
    distance: npt.ArrayLike,
    a_m: npt.ArrayLike,
    h: npt.ArrayLike,
    u: npt.ArrayLike | None = None,
    a_x: npt.ArrayLike = 0.0,
    shared: bool = True,
) -> Recorded:
    """Put signals together that belong together.

    Equation:
        The model's signals. Laser samples that fall between those of the accelerometer get times
        of their own, at which a_m is the value that linear interpolation gives.

    Args:
        t: time, s, shape (N,).
        distance: travel distance, m, shape (N,).
        a_m: accelerometer with 1 g removed, m/s², shape (n, N), or (N,) of a single track.
        h: height, m, NaN where it is missing, of the shape of a_m.
        u: inputs, shape (n, N, J), or (N, J) for all tracks alike; no inputs if None.
        a_x: longitudinal acceleration, m/s², shape (N,) or a constant.
        shared: whether the tracks have each κ_j in common.

    Returns:
        The signals in the shapes of `Recorded`.

    Raises:
        ValueError: if time does not increase, if distance decreases, if a signal other than h is
            not finite, or if shapes do not fit.
    """
    t_k, x_k = np.asarray(t, np.float64), np.asarray(distance, np.float64)
    a, h_k = np.atleast_2d(np.asarray(a_m, np.float64)), np.atleast_2d(np.asarray(h, np.float64))
    n, N = a.shape
    if t_k.shape != (N,) or x_k.shape != (N,) or h_k.shape != (n, N):
        raise ValueError(f"times, distances and heights do not fit an accelerometer of {(n, N)}")
    u_k = np.zeros((N, 0)) if u is None else np.asarray(u, np.float64)
    u_k = np.broadcast_to(u_k, (n, N, u_k.shape[-1]))
    a_x_k = np.broadcast_to(np.asarray(a_x, np.float64), (N,))
    if not all(np.isfinite(x).all() for x in (t_k, x_k, a, u_k, a_x_k)):
        raise ValueError("a signal other than the height holds NaN or infinity")
    if (np.diff(t_k) <= 0).any() or (np.diff(x_k) < 0).any():
        raise ValueError("time does not increase, or distance decreases")
    return Recorded(t_k, x_k, a, h_k, u_k, a_x_k, shared)
