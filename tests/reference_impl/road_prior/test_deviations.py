"""The deviations against runs drawn from the differential equations by Euler and Maruyama."""

from typing import NamedTuple

import numpy as np
import pytest

from floatref_reference.road_prior.least_squares import deviation, least_squares
from floatref_reference.road_prior.smoother import Smoothed, smooth
from floatref_reference.road_prior.symbols import Constants, Recorded, recorded

C = Constants(
    sigma_a=0.05,
    sigma_b0=0.03,
    sigma_b1=0.05,
    sigma_h=0.004,
    q=2e-4,
    g=1e-4,
    lambda_p=5.0,
    sigma_r=0.1,
    sigma_v=0.1,
    sigma_b=0.05,
    sigma_kappa=0.05,
)
N, DT, FINER, DRAWS = 24, 0.1, 60, 200
MISSING = [3, 4, 5, 14]


class Drawn(NamedTuple):
    """True r, v, b, z and s, shape (DRAWS, N, 5), κ of each draw, and what the sensors read."""

    truth: np.ndarray
    kappa: np.ndarray
    runs: list[Recorded]


def speed(t: float) -> float:
    return 0.0 if 0.8 < t < 1.6 else 4.0


def u(t: np.ndarray) -> np.ndarray:
    return np.sin(4 * t)


def a_m(t: np.ndarray) -> np.ndarray:
    return 0.3 * np.cos(3 * t)


def along(z: np.ndarray, s: np.ndarray, dx: float, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    z_next = z + dx * (s - z / C.lambda_p) + np.sqrt(C.q) * w[0]
    return z_next, s - dx * s / C.lambda_p + np.sqrt(C.g) * w[1]


def road_of_the_past(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return z and s that a flat road has come to after ten times λ_p."""
    z, s, dx = np.zeros(DRAWS), np.zeros(DRAWS), C.lambda_p / 200
    for _ in range(2000):
        z, s = along(z, s, dx, np.sqrt(dx) * rng.normal(size=(2, DRAWS)))
    return z, s


@pytest.fixture(scope="module")
def draws() -> Drawn:
    """Return runs whose noise and constants are those of the model, in steps of DT / FINER."""
    rng, h = np.random.default_rng(11), DT / FINER
    start = [C.sigma_r, C.sigma_v, C.sigma_b]
    r, v, b = (sigma * rng.normal(size=DRAWS) for sigma in start)
    z, s = road_of_the_past(rng)
    kappa = C.sigma_kappa * rng.normal(size=DRAWS)
    states, x = [(r, v, b, z, s)], [0.0]
    for step in range((N - 1) * FINER):
        t = (step + 0.5) * h
        w_a, w_b, *w_road = np.sqrt(h) * rng.normal(size=(4, DRAWS))
        V, sigma_b = speed(t), np.hypot(C.sigma_b0, C.sigma_b1)
        r, v = r + h * v, v + h * (a_m(t) - b - kappa * u(t)) + C.sigma_a * w_a
        b, (z, s) = b + sigma_b * w_b, along(z, s, h * V, np.sqrt(V) * np.array(w_road))
        x.append(x[-1] + h * V)
        if step % FINER == FINER - 1:
            states.append((r, v, b, z, s))
    truth, t = np.transpose(states, (2, 0, 1)), np.arange(N) * DT
    heights = truth[:, :, 0] - truth[:, :, 3] + C.sigma_h * rng.normal(size=(DRAWS, N))
    heights[:, MISSING] = np.nan
    signals = [recorded(t, x[::FINER], a_m(t), y, u(t)[:, None], a_x=1.0) for y in heights]
    return Drawn(truth, kappa, signals)


@pytest.fixture(scope="module")
def smoothed(draws: Drawn) -> list[Smoothed]:
    return [smooth(run, C) for run in draws.runs]


@pytest.mark.slow
def test_every_state_errs_as_its_covariance_says(draws: Drawn, smoothed: list[Smoothed]) -> None:
    sigma = np.sqrt(np.diagonal(smoothed[0].P, axis1=1, axis2=2))
    error = np.array([run.x for run in smoothed])
    error[:, :, :5] -= draws.truth
    error[:, :, 5] -= draws.kappa[:, None]
    squares = np.mean((error / sigma) ** 2, axis=(0, 1))
    assert squares == pytest.approx(np.ones(6), abs=0.3)
    assert np.abs(np.mean(error / sigma, axis=0)).max() < 4 / np.sqrt(DRAWS)


@pytest.mark.slow
def test_states_err_together_as_their_covariance_says(
    draws: Drawn, smoothed: list[Smoothed]
) -> None:
    """The squares of errors, weighed by the inverse covariance, are one for each state."""
    squares = [
        np.mean([(e := run.x[k, :5] - truth[k]) @ np.linalg.inv(run.P[k, :5, :5]) @ e])
        for run, truth in zip(smoothed, draws.truth, strict=True)
        for k in range(0, N, 4)
    ]
    assert np.mean(squares) == pytest.approx(5, abs=0.4)


@pytest.mark.slow
def test_the_profile_errs_as_its_deviation_says(draws: Drawn, smoothed: list[Smoothed]) -> None:
    error = np.array([run.e[0] for run in smoothed]) - draws.truth[:, :, 3]
    squares = np.mean((error / smoothed[0].sigma_e[0]) ** 2, axis=0)
    there = np.setdiff1d(np.arange(N), MISSING)
    assert np.isnan(squares[MISSING]).all()
    assert np.mean(squares[there]) == pytest.approx(1, abs=0.15)
    assert squares[there].max() < 1 + 5 * np.sqrt(2 / DRAWS)


def test_differences_over_the_run_err_as_the_joint_covariance_says(
    draws: Drawn, smoothed: list[Smoothed]
) -> None:
    """The rise of r over the stop, and how far r is from a line through its ends."""
    weights = np.zeros((2, N, 6))
    weights[0, [6, 18], 0] = -1, 1
    weights[1, [0, N // 2, N - 1], 0] = -0.5, 1, -0.5
    sigma = deviation(least_squares(draws.runs[0], C), weights)
    error = np.array([run.r[0] for run in smoothed]) - draws.truth[:, :, 0]
    sums = error @ weights[:, :, 0].T
    assert np.mean((sums / sigma) ** 2, axis=0) == pytest.approx(np.ones(2), abs=0.4)
