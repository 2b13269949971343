"""6.5 Implementation for Profile Calculation (figure 6.6)."""

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.measurement_model import matrix_h
from floatref_reference.appendix_c.process_model import matrix_a, matrix_q, matrix_w
from floatref_reference.appendix_c.symbols import Matrix, Vector
from floatref_reference.chapter_5.section_5_3 import capture, trigger
from floatref_reference.chapter_6.section_6_1_2_extended import predicted_covariance
from floatref_reference.chapter_6.section_6_1_3_multi_rate import multi_rate_update
from floatref_reference.chapter_6.section_6_1_4_smoother import (
    smoothed_covariance,
    smoothed_state,
    smoother_gain,
)
from floatref_reference.chapter_6.section_6_3_6_system import f, h
from floatref_reference.signals import Signal

Observation: TypeAlias = tuple[Vector, Vector]
"""y_rz, y_vz, y_θ, y_φ (C.7), NaN where one is missing, and their four variances (C.10)."""
Observe: TypeAlias = Callable[[int, Vector], Observation | None]
"""Tells what is observed at step k, given x̂_{k|k-1}; asked once at every step, in order."""


class Run(NamedTuple):
    """What the Kalman filter leaves for the smoother.

    Equation:
        Section 6.1.4: inputs, and states and covariances before and after each measurement.

    Attributes:
        u: inputs u_k, shape (N, 6).
        dt: time step Δt, s.
        sigma: standard deviations of the process noise, shape (N, 7).
        x_prior: x̂_{k|k-1}, shape (N, 7).
        P_prior: P_{k|k-1}, shape (N, 7, 7).
        x: x̂_{k|k}, shape (N, 7).
        P: P_{k|k}, shape (N, 7, 7).
    """

    u: Matrix
    dt: float
    sigma: Matrix
    x_prior: Matrix
    P_prior: npt.NDArray[np.float64]
    x: Matrix
    P: npt.NDArray[np.float64]


def time_update(x: Vector, P: Matrix, u: Vector, dt: float, sigma: Vector) -> tuple[Vector, Matrix]:
    """Advance the state and its covariance by one time step.

    Equation:
        (6.9) x̂_{k|k-1} = f(x̂_{k-1|k-1}, u_{k-1}, 0), and (6.10) with (C.3) to (C.6)

    Args:
        x: x̂_{k-1|k-1}, shape (7,).
        P: P_{k-1|k-1}, shape (7, 7).
        u: u_{k-1}, shape (6,).
        dt: time step Δt, s.
        sigma: standard deviations in the order of (C.5), shape (7,).

    Returns:
        x̂_{k|k-1}, shape (7,), and P_{k|k-1}, shape (7, 7).
    """
    A, W, Q = matrix_a(x, u, dt), matrix_w(x, dt), matrix_q(sigma)
    return f(x, u, dt), predicted_covariance(P, A, W, Q)


def kalman_filter(
    u: npt.ArrayLike,
    dt: float,
    x_0: npt.ArrayLike,
    P_0: npt.ArrayLike,
    sigma: npt.ArrayLike,
    observe: Observe,
    lever: npt.ArrayLike,
    u_at: npt.ArrayLike | None = None,
) -> Run:
    """Run the multi-rate extended Kalman filter.

    Equation:
        Section 6.5: (6.9) and (6.10) at every time step, from k-1 to k with u_{k-1}; (6.13) where
        there is an observation, else (6.16). Steps count from 0 here: x_0 and P_0 mean
        x̂_{0|-1}, no time update leads to them, and an observation at k = 0 corrects them.

    Args:
        u: u_ax, u_ay, u_az in m/s² and u_ω1, u_ω2, u_ω3 in rad/s at each step, shape (N, 6).
        dt: time step Δt, s.
        x_0: state at k = 0, shape (7,).
        P_0: its covariance, shape (7, 7).
        sigma: standard deviations of the process noise from k to k+1 in the order of (C.5), shape
            (7,) or, one row per step, (N, 7).
        observe: the observations.
        lever: lever arm l_x, l_y, l_z of the antenna, m, shape (3,).
        u_at: inputs that the measurement model takes at k, shape (N, 6); u if None.

    Returns:
        States and covariances of all N steps.
    """
    u_k = np.asarray(u, np.float64)
    u_y = u_k if u_at is None else np.asarray(u_at, np.float64)
    sigma_k = np.broadcast_to(np.asarray(sigma, np.float64), (len(u_k), 7))
    x, P = np.asarray(x_0, np.float64), np.asarray(P_0, np.float64)
    priors, posteriors = [], []
    for k in range(len(u_k)):
        if k > 0:
            x, P = time_update(x, P, u_k[k - 1], dt, sigma_k[k - 1])
        priors.append((x, P))
        y, R = observe(k, x.copy()) or (None, np.zeros(4))
        h_x, H = h(x, u_y[k], lever), matrix_h(x, u_y[k], lever)
        x, P = multi_rate_update(x, P, y, h_x, H, np.diag(R))
        posteriors.append((x, P))
    stored = [np.array(part) for pairs in (priors, posteriors) for part in zip(*pairs, strict=True)]
    return Run(u_k, dt, sigma_k, *stored)


def rts_smoother(run: Run) -> tuple[Matrix, npt.NDArray[np.float64]]:
    """Run the fixed-interval smoother backward over what the filter left.

    Equation:
        (6.17) and (6.22), with A_k of (6.18), and (6.19) and (6.20) as the filter stored them,
        from the last step but one to the first.

    Args:
        run: the filter's states and covariances.

    Returns:
        x̂_{k|N}, shape (N, 7), and P_{k|N}, shape (N, 7, 7).

    Raises:
        numpy.linalg.LinAlgError: if a P_{k+1|k} is singular.
    """
    x_smoothed, P_smoothed = run.x.copy(), run.P.copy()
    for k in range(len(run.x) - 2, -1, -1):
        x_next, P_next = run.x_prior[k + 1], run.P_prior[k + 1]
        L = smoother_gain(run.P[k], matrix_a(run.x[k], run.u[k], run.dt), P_next)
        x_smoothed[k] = smoothed_state(run.x[k], L, x_smoothed[k + 1], x_next)
        P_smoothed[k] = smoothed_covariance(run.P[k], L, P_smoothed[k + 1], P_next)
    return x_smoothed, P_smoothed


def most_recent(steps: npt.ArrayLike, readings: npt.ArrayLike, N: int) -> npt.NDArray[np.float64]:
    """Hold each reading of a slower sensor until the next.

    Equation:
        Section 6.5: at each time step, the most recent reading of each sensor. Before the first
        reading, the first one is used.

    Args:
        steps: time steps at which the readings came, increasing, shape (M,).
        readings: what was read, shape (M,) or (M, n).
        N: number of time steps.

    Returns:
        The reading in force at each step, shape (N,) or (N, n).
    """
    came = np.searchsorted(np.asarray(steps), np.arange(N), side="right") - 1
    held: npt.NDArray[np.float64] = np.asarray(readings, np.float64)[np.maximum(came, 0)]
    return held


def profile(r_zp: npt.ArrayLike, height: npt.ArrayLike) -> Vector:
    """Compute the temporal profile.

    Equation:
        (6.57) r_zr,k = r_zp,k - h_k

    Args:
        r_zp: floating reference height from the smoother, m, shape (N,).
        height: height-sensor reading h_k, m, shape (N,).

    Returns:
        Road elevation over time, m, shape (N,).
    """
    return np.subtract(r_zp, height, dtype=np.float64)


def spatial_profile(r_zr: npt.ArrayLike, r_xp: npt.ArrayLike, dx: float) -> Signal:
    """Decimate the temporal profile to a constant distance interval.

    Equation:
        Section 6.5: r_zr(x_k), by encoder distance as in section 5.3.

    Args:
        r_zr: temporal profile of (6.57), m, shape (N,).
        r_xp: travel distance, m, shape (N,), non-decreasing.
        dx: distance interval Δx, m.

    Returns:
        Road elevation at each point, m.
    """
    return capture(r_zr, trigger(r_xp, dx))
