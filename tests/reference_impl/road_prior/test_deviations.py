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
    lambda_p=5.0,
    sigma_r=0.1,
    sigma_v=0.1,
    sigma_b=0.05,
    sigma_kappa=0.05,
)
N, DT, FINER, DRAWS = 24, 0.1, 60, 200
MISSING = [3, 4, 5, 14]


class Drawn(NamedTuple):
    """True r, v, b and z, shape (DRAWS, N, 4), κ of each draw, and what the sensors read."""

    truth: np.ndarray
    kappa: np.ndarray
    runs: list[Recorded]


def speed(t: float) -> float:
    return 0.0 if 0.8 < t < 1.6 else 4.0


def u(t: np.ndarray) -> np.ndarray:
    return np.sin(4 * t)


def a_m(t: np.ndarray) -> np.ndarray:
    return 0.3 * np.cos(3 * t)


@pytest.fixture(scope="module")
def draws() -> Drawn:
    """Return runs whose noise and constants are those of the model, in steps of DT / FINER."""
    rng, h = np.random.default_rng(11), DT / FINER
    sigma_z = np.sqrt(C.q * C.lambda_p / 2)
    start = [C.sigma_r, C.sigma_v, C.sigma_b, sigma_z]
    r, v, b, z = (sigma * rng.normal(size=DRAWS) for sigma in start)
    kappa = C.sigma_kappa * rng.normal(size=DRAWS)
    states, x = [(r, v, b, z)], [0.0]
    for step in range((N - 1) * FINER):
        t = (step + 0.5) * h
        w_a, w_b, w_z = np.sqrt(h) * rng.normal(size=(3, DRAWS))
        V, sigma_b = speed(t), np.hypot(C.sigma_b0, C.sigma_b1)
        r, v = r + h * v, v + h * (a_m(t) - b - kappa * u(t)) + C.sigma_a * w_a
        b, z = b + sigma_b * w_b, z - h * V / C.lambda_p * z + np.sqrt(C.q * V) * w_z
        x.append(x[-1] + h * V)
        if step % FINER == FINER - 1:
            states.append((r, v, b, z))
    truth, t = np.transpose(states, (2, 0, 1)), np.arange(N) * DT
    heights = truth[:, :, 0] - truth[:, :, 3] + C.sigma_h * rng.normal(size=(DRAWS, N))
    heights[:, MISSING] = np.nan
    signals = [recorded(t, x[::FINER], a_m(t), y, u(t)[:, None], a_x=1.0) for y in heights]
    return Drawn(truth, kappa, signals)


@pytest.fixture(scope="module")
def smoothed(draws: Drawn) -> list[Smoothed]:
    return [smooth(run, C) for run in draws.runs]


def test_every_state_errs_as_its_covariance_says(draws: Drawn, smoothed: list[Smoothed]) -> None:
    sigma = np.sqrt(np.diagonal(smoothed[0].P, axis1=1, axis2=2))
    error = np.array([run.x for run in smoothed])
    error[:, :, :4] -= draws.truth
    error[:, :, 4] -= draws.kappa[:, None]
    squares = np.mean((error / sigma) ** 2, axis=(0, 1))
    assert squares == pytest.approx(np.ones(5), abs=0.3)
    assert np.abs(np.mean(error / sigma, axis=0)).max() < 4 / np.sqrt(DRAWS)


def test_states_err_together_as_their_covariance_says(
    draws: Drawn, smoothed: list[Smoothed]
) -> None:
    """The squares of errors, weighed by the inverse covariance, are one for each state."""
    squares = [
        np.mean([(e := run.x[k, :4] - truth[k]) @ np.linalg.inv(run.P[k, :4, :4]) @ e])
        for run, truth in zip(smoothed, draws.truth, strict=True)
        for k in range(0, N, 4)
    ]
    assert np.mean(squares) == pytest.approx(4, abs=0.4)


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
    weights = np.zeros((2, N, 5))
    weights[0, [6, 18], 0] = -1, 1
    weights[1, [0, N // 2, N - 1], 0] = -0.5, 1, -0.5
    sigma = deviation(least_squares(draws.runs[0], C), weights)
    error = np.array([run.r[0] for run in smoothed]) - draws.truth[:, :, 0]
    sums = error @ weights[:, :, 0].T
    assert np.mean((sums / sigma) ** 2, axis=0) == pytest.approx(np.ones(2), abs=0.4)
