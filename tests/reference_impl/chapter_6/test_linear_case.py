"""Level and without rotation the system is linear: filter and smoother are least squares.

The least squares solve for the start and for every noise, over the whole run at once, with
matrices written down here.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_5_implementation import kalman_filter, rts_smoother

Matrix = npt.NDArray[np.float64]
N, DT, G = 40, 0.02, 9.80665
SCALES = np.array([1.0, 0.5, 0.05, 0.05, 0.1, 0.01, 0.01])


class Case(NamedTuple):
    """Accelerations, noise of every step, observations with gaps and their deviations."""

    a: Matrix
    sigma: Matrix
    y: Matrix
    sigma_y: Matrix
    lever: Matrix


def transition() -> Matrix:
    """Return the matrix of x, v and δ_a, of φ and δ_ω1, and of θ and δ_ω2."""
    A = np.eye(7)
    A[0, 1] = A[1, 4] = A[3, 5] = A[2, 6] = DT
    A[0, 4] = DT**2 / 2
    return A


def entry() -> Matrix:
    """Return how e_a, e_ω1, e_ω2, e_ω3 and the three walks enter; yaw does not count at level."""
    W = np.zeros((7, 7))
    W[0, 0], W[1, 0], W[3, 1], W[2, 2] = DT**2 / 2, DT, DT, DT
    W[4, 4] = W[5, 5] = W[6, 6] = 1
    return W


def observation(lever: Matrix) -> Matrix:
    """Return how a level body moves the antenna: r - l_x θ + l_y φ, and its rate."""
    H = np.zeros((4, 7))
    H[0, 0] = H[1, 1] = H[2, 2] = H[3, 3] = 1
    H[0, 2], H[0, 3] = -lever[0], lever[1]
    H[1, 6], H[1, 5] = -lever[0], lever[1]
    return H


def least_squares(case: Case) -> tuple[Matrix, Matrix]:
    """Return all states, shape (N, 7), and their covariances, shape (N, 7, 7)."""
    to_state = np.zeros((N, 7, 7 * N))
    to_state[0, :, :7] = np.diag(SCALES)
    known = np.zeros((N, 7))
    for k in range(1, N):
        to_state[k] = transition() @ to_state[k - 1]
        to_state[k, :, 7 * k : 7 * k + 7] = entry() * case.sigma[k - 1]
        lift = np.array([DT**2 / 2, DT, 0, 0, 0, 0, 0])
        known[k] = transition() @ known[k - 1] + lift * case.a[k - 1]
    H, offset = observation(case.lever), np.array([case.lever[2], 0, 0, 0])
    design, right = [np.eye(7 * N)], [np.zeros(7 * N)]
    for k in range(N):
        there = ~np.isnan(case.y[k])
        weight = 1 / case.sigma_y[k][there]
        design.append(weight[:, None] * (H @ to_state[k])[there])
        right.append(weight * (case.y[k] - offset - H @ known[k])[there])
    whole = np.vstack(design)
    Q, triangle = np.linalg.qr(whole)
    root = to_state @ np.linalg.inv(triangle)
    return known + root @ (Q.T @ np.concatenate(right)), root @ root.transpose(0, 2, 1)


def smoothed(case: Case) -> tuple[Matrix, Matrix]:
    u = np.zeros((N, 6))
    u[:, 2] = G + case.a

    def observe(k: int, x: Matrix) -> tuple[Matrix, Matrix] | None:
        return None if np.isnan(case.y[k]).all() else (case.y[k], case.sigma_y[k] ** 2)

    run = kalman_filter(u, DT, np.zeros(7), np.diag(SCALES**2), case.sigma, observe, case.lever)
    return rts_smoother(run)


def drawn(seed: int) -> tuple[np.random.Generator, Matrix, Matrix]:
    rng = np.random.default_rng(seed)
    sigma = np.array([0.05, 0.01, 0.01, 0.01, 0.003, 0.001, 0.001]) * rng.uniform(0.3, 3, (N, 7))
    return rng, sigma, np.array([0.012, 0.03, 0.002, 0.003]) * rng.uniform(0.5, 2, (N, 4))


@pytest.mark.slow
@pytest.mark.cites("(6.9)", "(6.13)", "(6.16)", "(6.17)", "(6.22)", "(6.47)", "(6.48)")
@settings(deadline=None, max_examples=8, phases=[Phase.generate])
@given(seed=st.integers(0, 9999), share=st.floats(0.1, 1.0), l_z=st.floats(-3, 3))
def test_height_observed_at_level(seed: int, share: float, l_z: float) -> None:
    """Readings of height and velocity that agree with nothing, some of them missing."""
    rng, sigma, sigma_y = drawn(seed)
    y = np.hstack([0.1 * rng.normal(size=(N, 2)) + [l_z, 0], np.zeros((N, 2))])
    y[rng.uniform(size=(N, 4)) > share] = np.nan
    case = Case(rng.normal(size=N), sigma, y, sigma_y, np.array([0, 0, l_z]))
    states, covariances = least_squares(case)
    x_smoothed, P_smoothed = smoothed(case)
    assert x_smoothed == pytest.approx(states, abs=1e-8)
    assert P_smoothed / np.outer(SCALES, SCALES) == pytest.approx(
        covariances / np.outer(SCALES, SCALES), abs=1e-8
    )


@pytest.mark.slow
@pytest.mark.cites("(6.10)", "(6.13)", "(6.22)", "(C.3)", "(C.6)", "(C.8)")
@settings(deadline=None, max_examples=8, phases=[Phase.generate])
@given(seed=st.integers(0, 9999), share=st.floats(0.1, 1.0))
def test_covariance_with_any_lever_arm(seed: int, share: float) -> None:
    """Readings that the filter expects leave the body level, while all seven states interact."""
    rng, sigma, sigma_y = drawn(seed)
    lever = rng.uniform(-3, 3, 3)
    y = np.tile([lever[2], 0, 0, 0], (N, 1))
    y[rng.uniform(size=(N, 4)) > share] = np.nan
    case = Case(np.zeros(N), sigma, y, sigma_y, lever)
    states, covariances = least_squares(case)
    x_smoothed, P_smoothed = smoothed(case)
    assert x_smoothed == pytest.approx(states, abs=1e-9)
    assert P_smoothed / np.outer(SCALES, SCALES) == pytest.approx(
        covariances / np.outer(SCALES, SCALES), abs=1e-8
    )
