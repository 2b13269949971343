"""The road-prior smoother, literally: over every sample forward, and backward over all of them."""

from typing import NamedTuple

import numpy as np

from floatref_reference.chapter_6.section_6_1_1_linear import time_update
from floatref_reference.chapter_6.section_6_1_4_smoother import (
    smoothed_covariance,
    smoothed_state,
    smoother_gain,
)
from floatref_reference.road_prior import model
from floatref_reference.road_prior.symbols import Constants, Matrix, Recorded, Stack, Vector


class Filtered(NamedTuple):
    """What the forward pass leaves for the backward pass.

    Equation:
        x̂_{k|k-1}, P_{k|k-1}, x̂_{k|k}, P_{k|k} and F_k at every k

    Attributes:
        x_prior: states before each measurement, shape (N, ns).
        P_prior: their covariances, shape (N, ns, ns).
        x: states after it, shape (N, ns).
        P: their covariances, shape (N, ns, ns).
        F: transitions from k to k + 1, shape (N - 1, ns, ns).
    """

    x_prior: Matrix
    P_prior: Stack
    x: Matrix
    P: Stack
    F: Stack


class Smoothed(NamedTuple):
    """What the whole run says of every sample.

    Equation:
        x̂_{k|N} and P_{k|N}; of each track r, z and the profile e = r - h of (6.57)

    Attributes:
        x: all states in the order of `model`, shape (N, ns).
        P: their covariances, shape (N, ns, ns).
        r: height of the reference point, m, shape (n, N).
        z: road under the laser, m, shape (n, N).
        e: profile, m, NaN where the laser has no sample, shape (n, N).
        sigma_r: deviation of r, m, shape (n, N).
        sigma_z: deviation of z, m, shape (n, N).
        sigma_e: deviation of e from the road, m, NaN as e is, shape (n, N).
    """

    x: Matrix
    P: Stack
    r: Matrix
    z: Matrix
    e: Matrix
    sigma_r: Matrix
    sigma_z: Matrix
    sigma_e: Matrix


def measurement_update(
    x: Vector, P: Matrix, y: Vector, H: Matrix, R: Matrix
) -> tuple[Vector, Matrix]:
    """Correct the state and its covariance by the heights that there are.

    Equation:
        K = P Hᵀ (H P Hᵀ + R)⁻¹, x̂ ← x̂ + K (y - H x̂) and, in Joseph's form,
        P ← (I - K H) P (I - K H)ᵀ + K R Kᵀ, without the rows of missing heights

    Args:
        x: x̂_{k|k-1}, shape (ns,).
        P: P_{k|k-1}, shape (ns, ns).
        y: heights, m, NaN where one is missing, shape (n,).
        H: observation matrix, shape (n, ns).
        R: covariance of n, m², shape (n, n).

    Returns:
        x̂_{k|k}, shape (ns,), and P_{k|k}, shape (ns, ns).
    """
    there = ~np.isnan(y)
    if not there.any():
        return x, P
    H_k, R_k = H[there], R[np.ix_(there, there)]
    K = P @ H_k.T @ np.linalg.inv(H_k @ P @ H_k.T + R_k)
    rest = np.eye(len(x)) - K @ H_k
    return x + K @ (y[there] - H_k @ x), rest @ P @ rest.T + K @ R_k @ K.T


def forward(run: Recorded, c: Constants) -> Filtered:
    """Run the Kalman filter.

    Equation:
        At k = 0 the prior, at every other k (6.5) with F, g and Q of `model`; then the update by
        the heights.

    Args:
        run: the recording.
        c: constants.

    Returns:
        States and covariances of all N samples.
    """
    H, R = model.observation(run), c.sigma_h**2 * np.eye(len(run.u))
    x, P = np.zeros(model.states(run)), model.prior(run, c)
    priors, posteriors, F = [], [], []
    for k in range(len(run.t)):
        if k > 0:
            F.append(model.transition(run, k - 1, c))
            Q, g = model.process_noise(run, k - 1, c), model.known_input(run, k - 1)
            x, P = time_update(x, P, g, F[-1], np.eye(len(x)), Q)
        priors.append((x, P))
        x, P = measurement_update(x, P, run.h[:, k], H, R)
        posteriors.append((x, P))
    x_prior, P_prior = (np.array(part) for part in zip(*priors, strict=True))
    x_k, P_k = (np.array(part) for part in zip(*posteriors, strict=True))
    return Filtered(x_prior, P_prior, x_k, P_k, np.array(F))


def backward(run: Filtered) -> tuple[Matrix, Stack]:
    """Run the smoother over what the filter left.

    Equation:
        (6.17) and (6.22) with F_k for A_k, from the last sample but one to the first

    Args:
        run: states and covariances of the filter.

    Returns:
        x̂_{k|N}, shape (N, ns), and P_{k|N}, shape (N, ns, ns).
    """
    x, P = run.x.copy(), run.P.copy()
    for k in range(len(x) - 2, -1, -1):
        L = smoother_gain(run.P[k], run.F[k], run.P_prior[k + 1])
        x[k] = smoothed_state(run.x[k], L, x[k + 1], run.x_prior[k + 1])
        P[k] = smoothed_covariance(run.P[k], L, P[k + 1], run.P_prior[k + 1])
    return x, P


def profile(run: Recorded, x: Matrix, P: Stack, sigma_h: float) -> Smoothed:
    """Read heights, roads and profiles from the states.

    Equation:
        (6.57) e = r - h. It misses the road r - h + n by the error of r and by n, of which the
        smoother knows: σ_e² = σ_h² - P_rr + 2 P_rz, the mean over all noise.

    Args:
        run: the recording.
        x: x̂_{k|N}, shape (N, ns).
        P: P_{k|N}, shape (N, ns, ns).
        sigma_h: deviation of n, m.

    Returns:
        The smoothed run.
    """
    r, z = np.arange(len(run.u)) * 5, np.arange(len(run.u)) * 5 + 3
    rr, zz, rz = P[:, r, r].T, P[:, z, z].T, P[:, r, z].T
    e, there = x[:, r].T - run.h, ~np.isnan(run.h)
    sigma_e = np.sqrt(np.where(there, sigma_h**2 - rr + 2 * rz, np.nan))
    return Smoothed(x, P, x[:, r].T, x[:, z].T, e, np.sqrt(rr), np.sqrt(zz), sigma_e)


def smooth(run: Recorded, c: Constants) -> Smoothed:
    """Smooth a run by the road prior.

    Equation:
        The model of this package, over its fixed interval: `forward`, then `backward`.

    Args:
        run: the recording.
        c: constants.

    Returns:
        States, heights, roads and profiles with their deviations.

    Raises:
        numpy.linalg.LinAlgError: if a P_{k+1|k} is singular, as with a deviation of 0 or a g of 0.
    """
    return profile(run, *backward(forward(run, c)), c.sigma_h)
