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
    """Each of the six unknowns of a step moves what it may move."""
    run = recorded([0, 0.5], [0, 2], [0, 0], [0, 0], a_x=1.0)
    moved = advance(np.zeros((4, 7)), np.zeros((2, 7)), run, 0, Constants(), np.eye(6, 7))
    pattern = [[1, 1, 1, 1, 1, 0], [1, 0, 1, 1, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 0, 0, 1]]
    assert np.array_equal(moved[:, :6] != 0, np.array(pattern, bool))


def test_without_a_height_nothing_is_learned(drawn) -> None:
    c = Constants()
    posterior = least_squares(drawn(1, n=2, J=2, N=8, share=0.0), c)
    sigma = np.sqrt(np.diag(posterior.root[0] @ posterior.root[0].T))
    track = [c.sigma_r, c.sigma_v, c.sigma_b, np.sqrt(c.q * c.lambda_p / 2)]
    assert sigma == pytest.approx([*track, *track, 0.05, 0.05])
    assert posterior.x[0] == pytest.approx(np.zeros(10), abs=1e-12)


def test_two_heights_of_a_standing_vehicle_by_hand() -> None:
    """One sample of r - z has the prior σ_r² + σ_z² and is measured with σ_h."""
    c = Constants(sigma_r=0.2, sigma_h=0.1, q=0.02, lambda_p=1.0)
    posterior = least_squares(recorded([0, 1], [0, 0], [0, 0], [0.5, np.nan]), c)
    total = 0.2**2 + 0.1**2 + 0.1**2
    assert posterior.x[0, [0, 3]] == pytest.approx([0.5 * 0.04 / total, -0.5 * 0.01 / total])
    variance = 0.04 * (1 - 0.04 / total)
    assert np.sum(posterior.root[0, 0] ** 2) == pytest.approx(variance)
    assert posterior.x[1, 3] == pytest.approx(posterior.x[0, 3])


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
