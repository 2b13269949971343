"""Joint estimation is least squares of all that is known so far, with forces free at each step."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref_reference.zhu_2021.section_2_vehicle import structure
from floatref_reference.zhu_2021.section_3_discretization import first_order_system, system
from floatref_reference.zhu_2021.section_3_joint_estimation import (
    input_estimation,
    joint_input_state,
)
from floatref_reference.zhu_2021.section_3_state_space import output_matrices, state_space
from floatref_reference.zhu_2021.symbols import System

Matrix = npt.NDArray[np.float64]
SEEDS = st.integers(0, 9999)


def covariance(rng: np.random.Generator, n: int) -> Matrix:
    root = rng.normal(size=(n, n))
    return root @ root.T + 0.1 * np.eye(n)


def least_squares(
    Z: Matrix, model: System, Q: Matrix, R: Matrix, X_0: Matrix, P_0: Matrix
) -> tuple[Matrix, Matrix]:
    """Solve for the start, all noise and all forces at once: (X, F) at the last step and their P.

    The unknowns are X_0, w_0 ... w_{N-2}, F_0 ... F_{N-1}; forces have no prior.
    """
    A_c, B_c, G, J = model
    N, (ns, p) = len(Z), B_c.shape
    states, size = ns * N, ns * N + p * N
    to_state = np.zeros((ns, size))
    to_state[:, :ns] = np.eye(ns)
    start = np.linalg.inv(np.linalg.cholesky(P_0))
    rows, right = [np.hstack([start, np.zeros((ns, size - ns))])], [start @ X_0]
    for k in range(N):
        force = slice(states + p * k, states + p * (k + 1))
        weight, read = np.linalg.inv(np.linalg.cholesky(R)), G @ to_state
        read[:, force] += J
        rows.append(weight @ read)
        right.append(weight @ Z[k])
        if k < N - 1:
            to_state = A_c @ to_state
            to_state[:, force] += B_c
            noise = slice(ns * (k + 1), ns * (k + 2))
            to_state[:, noise] += np.eye(ns)
            prior = np.zeros((ns, size))
            prior[:, noise] = np.linalg.inv(np.linalg.cholesky(Q))
            rows.append(prior)
            right.append(np.zeros(ns))
    orthogonal, triangle = np.linalg.qr(np.vstack(rows))
    last = np.zeros((p, size))
    last[:, force] = np.eye(p)
    root = np.vstack([to_state, last]) @ np.linalg.inv(triangle)
    return root @ (orthogonal.T @ np.concatenate(right)), root @ root.T


@pytest.mark.cites("(13) of Zhu", "step (a) of Zhu", "step (b) of Zhu", "step (c) of Zhu")
@settings(deadline=None, max_examples=20, phases=[Phase.generate])
@given(seed=SEEDS, p=st.integers(1, 2), N=st.integers(1, 6))
def test_estimate_is_least_squares(seed: int, p: int, N: int) -> None:
    rng = np.random.default_rng(seed)
    A_c = rng.normal(size=(3, 3)) / 2
    model = System(A_c, *(rng.normal(size=shape) for shape in [(3, p), (4, 3), (4, p)]))
    Q, R, P_0 = (covariance(rng, n) for n in (3, 4, 3))
    Z, X_0 = rng.normal(size=(N, 4)), rng.normal(size=3)
    run = joint_input_state(Z, model, Q, R, X_0, P_0)
    expected, P = least_squares(Z, model, Q, R, X_0, P_0)
    assert np.concatenate([run.X[-1], run.F[-1]]) == pytest.approx(expected, rel=1e-6, abs=1e-7)
    joint = np.block([[run.P[-1], run.P_XF[-1]], [run.P_XF[-1].T, run.P_F[-1]]])
    assert joint == pytest.approx(P, rel=1e-6, abs=1e-7 * np.abs(P).max())


def half_car() -> tuple[Matrix, Matrix, Matrix, Matrix]:
    """Return A, B, G and J of Table 1, all accelerations and displacements measured."""
    vehicle, eye, none = structure(), np.eye(5), np.zeros((5, 5))
    S_a, S_d = np.vstack([eye, none]), np.vstack([none, eye])
    return *state_space(vehicle), *output_matrices(vehicle, S_a, np.zeros((10, 5)), S_d)


@pytest.mark.cites("(12) of Zhu", "(13) of Zhu")
@settings(deadline=None, max_examples=10)
@given(seed=SEEDS, first_order=st.booleans())
def test_noise_free_forces_and_states_are_found_exactly(seed: int, first_order: bool) -> None:
    rng, dt = np.random.default_rng(seed), 1 / 200
    matrices = half_car()
    model = first_order_system(*matrices, dt)[0] if first_order else system(*matrices, dt)
    F = 1e4 * rng.normal(size=(60, 2)).cumsum(axis=0)
    X = np.zeros((60, 10))
    for k in range(59):
        X[k + 1] = model.A_c @ X[k] + model.B_c @ F[k]
    Z = X @ model.G.T + F @ model.J.T
    R = np.diag([1e-2] * 5 + [1e-6] * 5)
    run = joint_input_state(Z, model, 1e-8 * np.eye(10), R, np.zeros(10), 5e-5 * np.eye(10))
    assert np.abs(run.F - F).max() <= 1e-6 * np.abs(F).max()
    assert np.abs(run.X - X).max() <= 1e-7 * np.abs(X).max()


def test_a_wrong_start_is_forgotten() -> None:
    dt = 1 / 200
    model = system(*half_car(), dt)
    R = np.diag([1e-2] * 5 + [1e-6] * 5)
    X_0 = np.full(10, 0.01)
    run = joint_input_state(
        np.zeros((400, 10)), model, 1e-8 * np.eye(10), R, X_0, 1e-4 * np.eye(10)
    )
    assert np.abs(run.F[-1]).max() < 1e-3 * np.abs(run.F[0]).max()
    assert np.abs(run.X[-1]).max() < 1e-4


def test_covariances_stay_symmetric_and_positive() -> None:
    dt = 1 / 200
    Q, R = 1e-8 * np.eye(10), np.diag([1e-2] * 5 + [1e-6] * 5)
    model = system(*half_car(), dt)
    run = joint_input_state(np.zeros((300, 10)), model, Q, R, np.zeros(10), 5e-5 * np.eye(10))
    for P in (*run.P, *run.P_F):
        assert np.array_equal(P, P.T)
        assert np.linalg.eigvalsh(P)[0] > -1e-9 * np.abs(P).max()


@pytest.mark.cites("step (a) of Zhu")
def test_forces_that_no_measurement_feels_are_refused() -> None:
    eye, J = np.eye(2), np.array([[1.0, 1.0], [2.0, 2.0]])
    with pytest.raises(ValueError, match="wheel accelerations"):
        input_estimation(np.zeros(2), np.zeros(2), eye, J, eye)
