"""The chirp of section V.A, followed from the wheels' accelerations and five displacements."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.imine.section_4_b_convergence import error_matrix, slowest_rate
from floatref_reference.imine.section_4_state_form import output_matrix, state_form
from floatref_reference.imine.section_5_simulation import (
    F_S,
    POINTS,
    chirp,
    observe,
    runge_kutta,
    sub_steps,
)

Matrix = npt.NDArray[np.float64]
FORM, POSITIONS = state_form(), output_matrix([0, 1, 2, 3, 4])
GAINS = np.vstack([60 * np.eye(5), 900 * np.eye(5)])
DURATION = (POINTS - 1) / F_S


def drive(road, N: int, fine: int = 4) -> tuple[Matrix, Matrix, Matrix]:
    """Drive the trailer from rest: road (N, 2), state (N, 10), wheel accelerations (N, 2)."""

    def derivative(t: float, x: Matrix) -> Matrix:
        u, u_dot = road(t)
        return FORM.A @ x + FORM.C_1 @ u + FORM.D_1 @ u_dot

    x, h = np.zeros(10), 1 / F_S / fine
    roads, states, wheels = [], [], []
    for k in range(N):
        t = k / F_S
        roads.append(road(t)[0])
        states.append(x)
        wheels.append(derivative(t, x)[5:7])
        for step in range(fine):
            x = runge_kutta(derivative, t + step * h, x, h)
    return np.array(roads), np.array(states), np.array(wheels)


def both(t: float) -> tuple[Matrix, Matrix]:
    """Return the chirp under the left wheel and half of it, later, under the right one."""
    (u_1, w_1), (u_2, w_2) = chirp(t, DURATION), chirp(max(t - 0.2, 0), DURATION, 5e-4)
    return np.array([u_1, u_2]), np.array([w_1, w_2 if t > 0.2 else 0.0])


@pytest.fixture(scope="module")
def driven() -> tuple[Matrix, Matrix, Matrix]:
    return drive(both, POINTS)


@pytest.fixture(scope="module")
def observed(driven) -> tuple[Matrix, Matrix]:
    _, x, wheels = driven
    steps = sub_steps(error_matrix(FORM, GAINS, POSITIONS), 1 / F_S, reach=1.0)
    return observe(wheels, x @ POSITIONS.T, 1 / F_S, FORM, GAINS, POSITIONS, steps)


@pytest.mark.slow
@pytest.mark.cites("(10) of Imine", "(11) of Imine")
def test_chirp_is_followed_within_half_a_per_cent(driven, observed) -> None:
    """Figure 5: an error of 5e-6 m, 0.5 %, once the start is forgotten, here after 1 s."""
    u, u_bar = driven[0][128:], observed[1][128:]
    for side, amplitude in ((0, 1e-3), (1, 5e-4)):
        assert np.abs(u_bar[:, side] - u[:, side]).max() <= 0.005 * amplitude


def test_straight_lines_between_samples_flatten_fast_waves() -> None:
    """A sine on straight lines is lower by (ωΔt)²/12, at 8 Hz 1.3 %."""
    omega = 16 * math.pi

    def sine(t: float) -> tuple[Matrix, Matrix]:
        return np.full(2, 1e-3 * math.sin(omega * t)), np.full(
            2, 1e-3 * omega * math.cos(omega * t)
        )

    u, x, wheels = drive(sine, 256)
    _, u_bar = observe(wheels, x @ POSITIONS.T, 1 / F_S, FORM, GAINS, POSITIONS, 5)
    error = np.abs(u_bar[128:] - u[128:]).max() / 1e-3
    assert error == pytest.approx((omega / F_S) ** 2 / 12, rel=0.2)


@pytest.mark.slow
def test_states_that_are_not_measured_are_found(driven, observed) -> None:
    """The rates of all five freedoms, of which only displacements are given."""
    rates, found = driven[1][128:, 5:], observed[0][128:, 5:]
    assert np.abs(found - rates).max(axis=0) == pytest.approx(
        np.zeros(5), abs=0.005 * np.abs(rates).max()
    )


def test_wrong_start_fades_at_the_rate_of_the_slowest_eigenvalue() -> None:
    w_0 = np.concatenate([np.full(5, 1e-3), np.zeros(5), [1e-3, -1e-3]])
    L = error_matrix(FORM, GAINS, POSITIONS)
    zero = np.zeros((129, 2)), np.zeros((129, 5))
    x, u = observe(*zero, 1 / F_S, FORM, GAINS, POSITIONS, sub_steps(L, 1 / F_S, 0.5), w_0)
    found = np.hstack([x, u])
    lambdas, V = np.linalg.eig(L)
    assert float(lambdas.real.max()) == pytest.approx(slowest_rate(L))
    for k in (16, 64):
        decayed = (V * np.exp(lambdas * k / F_S)) @ np.linalg.solve(V, w_0)
        assert found[k] == pytest.approx(decayed.real, abs=1e-5 * np.abs(found[:k]).max())
    assert np.abs(found[-1]).max() < 1e-5


@settings(deadline=None, max_examples=20)
@given(rate=st.floats(-3, -0.1), h=st.floats(0.01, 0.2))
def test_integration_is_of_order_four(rate: float, h: float) -> None:
    """One step has the series of the exponential up to h⁴."""
    w = runge_kutta(lambda t, w: rate * w, 0.0, np.array([1.0]), h)
    series = sum((rate * h) ** i / math.factorial(i) for i in range(5))
    assert float(w[0]) == pytest.approx(series, rel=1e-13)


@settings(deadline=None, max_examples=20)
@given(dt=st.floats(1e-3, 0.1), reach=st.floats(0.05, 2))
def test_sub_steps_are_the_fewest_within_reach(dt: float, reach: float) -> None:
    L = np.diag([-600.0, -30.0])
    steps = sub_steps(L, dt, reach)
    assert 600 * dt / steps <= reach * (1 + 1e-12)
    assert steps == 1 or 600 * dt / (steps - 1) > reach


@settings(deadline=None, max_examples=20)
@given(t=st.floats(0.1, 19.9))
def test_chirp_gives_its_own_rate(t: float) -> None:
    h = 1e-5
    slope = (chirp(t + h, 20.0)[0] - chirp(t - h, 20.0)[0]) / (2 * h)
    assert chirp(t, 20.0)[1] == pytest.approx(slope, abs=1e-8)
