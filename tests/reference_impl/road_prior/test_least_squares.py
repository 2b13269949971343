"""The independent solution: its noise is white, and its root holds all covariances."""

from math import factorial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_prior.least_squares import (
    advance,
    deviation,
    least_squares,
    noise_of_road,
    start_of_road,
    white_noise,
)
from floatref_reference.road_prior.symbols import Constants, recorded


@settings(deadline=None, max_examples=20)
@given(dt=st.floats(1e-3, 10.0))
def test_integrals_of_white_noise_vary_together_as_its_kernels_do(dt: float) -> None:
    """∫ (Δt - s)^i (Δt - s)^j / (i! j!) ds for every pair of integrals."""
    rows = np.array(white_noise(np.eye(3, 4), dt))
    expected = [
        [dt ** (i + j + 1) / ((i + j + 1) * factorial(i) * factorial(j)) for j in range(3)]
        for i in range(3)
    ]
    assert rows @ rows.T == pytest.approx(np.array(expected), rel=1e-12)


def test_noise_of_acceleration_and_bias_and_road_is_apart() -> None:
    """Each of the eight unknowns of a step moves what it may move."""
    run = recorded([0, 0.5], [0, 2], [0, 0], [0, 0], a_x=1.0)
    moved = advance(np.zeros((5, 9)), np.zeros((2, 9)), run, 0, Constants(), np.eye(8, 9))
    pattern = np.zeros((5, 8), bool)
    pattern[0, :5], pattern[1, [0, 2, 3]], pattern[2, 2] = True, True, True
    pattern[3, 5:], pattern[4, 6] = True, True
    assert np.array_equal(moved[:, :8] != 0, pattern)


@settings(deadline=None, max_examples=20)
@given(dx=st.floats(1e-6, 300), q=st.floats(1e-7, 1e-3), g=st.floats(1e-9, 1e-3))
def test_noise_of_the_road_is_that_of_many_short_steps(dx: float, q: float, g: float) -> None:
    """Rectangles of a hundred thousand steps, each of which has its own white noise."""
    c = Constants(q=q, g=g, lambda_p=20.0)
    rows = np.array(noise_of_road(np.eye(3, 4), dx, c))
    tau = dx * (np.arange(100_000) + 0.5) / 100_000
    decay = np.exp(-2 * tau / 20.0) * dx / 100_000
    zz, zs, ss = np.sum(decay * (q + g * tau**2)), np.sum(decay * g * tau), np.sum(decay * g)
    assert rows @ rows.T == pytest.approx(np.array([[zz, zs], [zs, ss]]), rel=1e-6)


@settings(deadline=None, max_examples=20)
@given(q=st.floats(1e-7, 1e-3), g=st.floats(1e-9, 1e-3), lambda_p=st.floats(1, 1000))
def test_the_start_of_the_road_is_all_the_noise_before_it(
    q: float, g: float, lambda_p: float
) -> None:
    c = Constants(q=q, g=g, lambda_p=lambda_p)
    start = np.array(start_of_road(np.eye(3, 4), c))
    long = np.array(noise_of_road(np.eye(3, 4), 30 * lambda_p, c))
    assert start @ start.T == pytest.approx(long @ long.T, rel=1e-9)


def test_without_a_height_nothing_is_learned(drawn) -> None:
    c = Constants()
    posterior = least_squares(drawn(1, n=2, J=2, N=8, share=0.0), c)
    sigma = np.sqrt(np.diag(posterior.root[0] @ posterior.root[0].T))
    z_2, s_2 = c.q * c.lambda_p / 2 + c.g * c.lambda_p**3 / 4, c.g * c.lambda_p / 2
    track = [c.sigma_r, c.sigma_v, c.sigma_b, np.sqrt(z_2), np.sqrt(s_2)]
    assert sigma == pytest.approx([*track, *track, 0.05, 0.05])
    assert posterior.x[0] == pytest.approx(np.zeros(12), abs=1e-12)


def test_two_heights_of_a_standing_vehicle_by_hand() -> None:
    """One sample of r - z has the prior σ_r² + σ_z² and is measured with σ_h; z tells of s."""
    c = Constants(sigma_r=0.2, sigma_h=0.1, q=0.018, g=0.004, lambda_p=1.0)
    posterior = least_squares(recorded([0, 1], [0, 0], [0, 0], [0.5, np.nan]), c)
    total = 0.2**2 + 0.1**2 + 0.1**2
    assert posterior.x[0, [0, 3]] == pytest.approx([0.5 * 0.04 / total, -0.5 * 0.01 / total])
    variance = 0.04 * (1 - 0.04 / total)
    assert np.sum(posterior.root[0, 0] ** 2) == pytest.approx(variance)
    assert posterior.x[0, 4] == pytest.approx(-0.5 * 0.001 / total)
    assert posterior.x[1, 3:5] == pytest.approx(posterior.x[0, 3:5])


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 999), n=st.integers(1, 2))
def test_sums_over_the_run_deviate_as_their_parts_vary_together(drawn, seed: int, n: int) -> None:
    posterior = least_squares(drawn(seed, n=n, N=10), Constants())
    N, ns, M = posterior.root.shape
    joint = posterior.root.reshape(N * ns, M) @ posterior.root.reshape(N * ns, M).T
    weights = np.random.default_rng(seed).normal(size=(3, N, ns))
    flat = weights.reshape(3, N * ns)
    expected = np.sqrt(np.diag(flat @ joint @ flat.T))
    assert deviation(posterior, weights) == pytest.approx(expected, rel=1e-9)
