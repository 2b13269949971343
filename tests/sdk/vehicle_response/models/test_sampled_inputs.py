"""Sampled systems are exact for polynomial inputs, and their spread under noise is that told."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.vehicle_response.models.state_space import Sampled, sample, stationary_sigma

FEW = settings(deadline=None, max_examples=25)


@FEW
@given(
    rate=st.floats(0.01, 1e7),
    step=st.floats(1e-3, 0.1),
    degree=st.integers(1, 3),
    seed=st.integers(0, 2**32 - 1),
)
def test_a_lag_of_any_stiffness_follows_a_polynomial_exactly(rate, step, degree, seed):
    polynomial = np.polynomial.Polynomial(np.random.default_rng(seed).normal(size=degree + 1))
    # x' = rate·(w - x) has the solution Σ (-1/rate)^i w^(i), whatever w is.
    solution = sum((-1.0 / rate) ** i * polynomial.deriv(i) for i in range(degree + 1))
    system = sample(np.array([[-rate]]), np.array([[rate]]), step, degree)
    t = step * np.arange(10.0)
    w, x = polynomial(t), solution(t)
    for k in range(degree, 10):
        newest = w[k - degree : k + 1][::-1]
        found = system.transition[0, 0] * x[k - 1] + system.taps[:, 0, 0] @ newest
        scale = np.abs(w).max() + np.abs(x).max()
        assert abs(found - x[k]) <= 1e-8 * scale


def test_a_system_without_springs_integrates():
    system = sample(np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]]), 0.5, 1)
    np.testing.assert_allclose(system.transition, [[1.0, 0.5], [0.0, 1.0]])
    # Of an acceleration that goes from 1 to 0 and from 0 to 1 in half a second.
    np.testing.assert_allclose(system.taps[1, :, 0], [0.25 / 3.0, 0.25])
    np.testing.assert_allclose(system.taps[0, :, 0], [0.25 / 6.0, 0.25])


@FEW
@given(pole=st.floats(-0.95, 0.95), taps=st.lists(st.floats(-2.0, 2.0), min_size=2, max_size=4))
def test_the_spread_is_that_of_the_response_to_one_sample_of_noise(pole, taps):
    system = Sampled(np.array([[pole]]), np.array(taps)[:, None, None])
    response = np.zeros(600)
    state = 0.0
    for k in range(600):
        state = pole * state + (taps[k] if k < len(taps) else 0.0)
        response[k] = 3.0 * state
    response[0] += 0.5
    expected = 0.2 * np.sqrt((response**2).sum())
    found = stationary_sigma(system, np.array([0.2]), np.array([[3.0]]), np.array([[0.5]]))
    assert found[0] == pytest.approx(expected, rel=1e-6, abs=1e-9)
