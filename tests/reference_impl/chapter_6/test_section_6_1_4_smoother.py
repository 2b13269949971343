"""Filter and smoother of a drawn linear system are least squares over the whole of it."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_1_1_linear import measurement_update, time_update
from floatref_reference.chapter_6.section_6_1_4_smoother import (
    smoothed_covariance,
    smoothed_state,
    smoother_gain,
)

Matrix = npt.NDArray[np.float64]
N, NS = 12, 3


class System(NamedTuple):
    A: Matrix
    B: Matrix
    H: Matrix
    Q: Matrix
    R: Matrix
    u: Matrix
    y: Matrix


def drawn(seed: int) -> System:
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(NS, NS))
    A = np.eye(NS) + 0.3 * rng.normal(size=(N, NS, NS))
    H, R = rng.normal(size=(N, 2, NS)), np.diag(rng.uniform(0.1, 1, 2))
    Q = 0.1 * root @ root.T + 0.01 * np.eye(NS)
    return System(
        A, rng.normal(size=(NS, 2)), H, Q, R, rng.normal(size=(N, 2)), rng.normal(size=(N, 2))
    )


def least_squares(s: System) -> tuple[Matrix, Matrix]:
    """Weigh start, dynamics and measurements by their inverse roots, and solve for all states."""
    rows, right = [], []

    def weigh(block: Matrix, target: Matrix, covariance: Matrix) -> None:
        whiten = np.linalg.inv(np.linalg.cholesky(covariance))
        rows.append(whiten @ block)
        right.append(whiten @ target)

    at = [np.eye(NS, N * NS, k * NS) for k in range(N)]
    weigh(at[0], np.zeros(NS), np.eye(NS))
    for k in range(N):
        weigh(s.H[k] @ at[k], s.y[k], s.R)
        if k:
            weigh(at[k] - s.A[k - 1] @ at[k - 1], s.B @ s.u[k - 1], s.Q)
    design = np.vstack(rows)
    states = np.linalg.lstsq(design, np.concatenate(right), rcond=None)[0]
    return states.reshape(N, NS), np.linalg.inv(design.T @ design)


@pytest.mark.cites("(6.5)", "(6.7)", "(6.17)", "(6.22)")
@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 9999))
def test_smoother_is_least_squares(seed: int) -> None:
    s = drawn(seed)
    x, P, filtered, predicted = np.zeros(NS), np.eye(NS), [], []
    for k in range(N):
        if k:
            x, P = time_update(x, P, s.u[k - 1], s.A[k - 1], s.B, s.Q)
        predicted.append((x, P))
        x, P = measurement_update(x, P, s.y[k], s.H[k], s.R)
        filtered.append((x, P))
    states, joint = least_squares(s)
    for k in range(N - 1, -1, -1):
        if k < N - 1:
            x_next, P_next = predicted[k + 1]
            x_k, P_k = filtered[k]
            L = smoother_gain(P_k, s.A[k], P_next)
            x = smoothed_state(x_k, L, x, x_next)
            P = smoothed_covariance(P_k, L, P, P_next)
        assert x == pytest.approx(states[k], abs=1e-8)
        block = slice(k * NS, (k + 1) * NS)
        assert joint[block, block] == pytest.approx(P, abs=1e-8)
