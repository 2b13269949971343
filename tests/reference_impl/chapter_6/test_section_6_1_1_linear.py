"""The linear filter is the best linear estimate: least squares of all that is known so far."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_1_1_linear import measurement_update, time_update

Matrix = npt.NDArray[np.float64]


def covariance(rng: np.random.Generator, n: int) -> Matrix:
    root = rng.normal(size=(n, n))
    return root @ root.T + 0.1 * np.eye(n)


@pytest.mark.cites("(6.5)")
@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 999))
def test_prediction_has_the_moments_of_the_linear_system(seed: int) -> None:
    """Sigma points have exactly the mean and the covariance that the system maps linearly."""
    rng = np.random.default_rng(seed)
    A, B, Q, P = (
        rng.normal(size=(3, 3)),
        rng.normal(size=(3, 2)),
        covariance(rng, 3),
        covariance(rng, 3),
    )
    x, u = rng.normal(size=3), rng.normal(size=2)
    spread = math.sqrt(6) * np.linalg.cholesky(
        np.block([[P, np.zeros((3, 3))], [np.zeros((3, 3)), Q]])
    )
    points = np.array([sign * column for column in spread.T for sign in (-1, 1)])
    mapped = (x + points[:, :3]) @ A.T + B @ u + points[:, 3:]
    x_next, P_next = time_update(x, P, u, A, B, Q)
    assert x_next == pytest.approx(mapped.mean(axis=0))
    assert P_next == pytest.approx(np.cov(mapped.T, bias=True))


@pytest.mark.cites("(6.7)")
@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 999), nm=st.integers(1, 4))
def test_correction_adds_information(seed: int, nm: int) -> None:
    """Inverse covariances add up, and so do inverse covariances times estimates."""
    rng = np.random.default_rng(seed)
    P, R, H = covariance(rng, 3), covariance(rng, nm), rng.normal(size=(nm, 3))
    x, y = rng.normal(size=3), rng.normal(size=nm)
    x_after, P_after = measurement_update(x, P, y, H, R)
    information = np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H
    assert P_after @ information == pytest.approx(np.eye(3), abs=1e-8)
    score = np.linalg.inv(P) @ x + H.T @ np.linalg.inv(R) @ y
    assert x_after == pytest.approx(np.linalg.solve(information, score), abs=1e-8)


@pytest.mark.cites("(6.5)", "(6.7)")
def test_random_walk_settles_at_the_golden_ratio() -> None:
    """With unit variances p = p - p²/(p + 1) + 1, so that p² = p + 1."""
    one, x, P = np.eye(1), np.zeros(1), np.eye(1)
    for _ in range(40):
        x, P_prior = time_update(x, P, np.zeros(1), one, one, one)
        x, P = measurement_update(x, P_prior, np.ones(1), one, one)
    assert float(P_prior[0, 0]) == pytest.approx((1 + math.sqrt(5)) / 2)
    assert float(x[0]) == pytest.approx(1)
