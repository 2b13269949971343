"""Discrete time steps are the solutions of the continuous system."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.zhu_2021.section_2_vehicle import structure
from floatref_reference.zhu_2021.section_3_discretization import (
    first_order_hold,
    first_order_system,
    input_matrix,
    precise_integration,
    system,
    zero_order_hold,
)
from floatref_reference.zhu_2021.section_3_state_space import state_space

Matrix = npt.NDArray[np.float64]
SEEDS = st.integers(0, 9999)


def stable(rng: np.random.Generator, n: int) -> Matrix:
    """Draw a matrix whose eigenvalues lie left of -0.1."""
    A = rng.normal(size=(n, n))
    return A - (float(np.linalg.eigvals(A).real.max()) + 0.1) * np.eye(n)


def runge_kutta(A: Matrix, B: Matrix, x: Matrix, force: list[Matrix], dt: float) -> Matrix:
    """Integrate over dt in 400 steps while the force moves from the first to the second."""
    h, steps = dt / 400, 400

    def slope(s: float, x: Matrix) -> Matrix:
        return A @ x + B @ (force[0] + s * (force[1] - force[0]))

    for k in range(steps):
        s = k / steps
        one = slope(s, x)
        two = slope(s + 0.5 / steps, x + h / 2 * one)
        three = slope(s + 0.5 / steps, x + h / 2 * two)
        x = x + h / 6 * (one + 2 * two + 2 * three + slope(s + 1 / steps, x + h * three))
    return x


@pytest.mark.cites("(12) of Zhu")
@settings(deadline=None, max_examples=30)
@given(seed=SEEDS, n=st.integers(1, 8), t=st.floats(0.01, 3))
def test_exponential_forward_and_backward_is_one(seed: int, n: int, t: float) -> None:
    H = t * stable(np.random.default_rng(seed), n)
    there, back = precise_integration(H), precise_integration(-H)
    scale = np.abs(there).max() * np.abs(back).max() * n
    assert there @ back == pytest.approx(np.eye(n), abs=1e-11 * scale)


@pytest.mark.cites("(12) of Zhu")
@settings(deadline=None, max_examples=30)
@given(seed=SEEDS, n=st.integers(1, 8), t=st.floats(0.01, 1))
def test_exponential_is_its_series(seed: int, n: int, t: float) -> None:
    H = t * stable(np.random.default_rng(seed), n)
    term, series = np.eye(n), np.eye(n)
    for i in range(1, 80):
        term = term @ H / i
        series = series + term
    assert precise_integration(H) == pytest.approx(
        series, abs=1e-12 * math.exp(np.abs(H).sum(1).max())
    )


def test_increment_keeps_digits_that_squaring_the_whole_would_lose() -> None:
    """A decay of 1 in 1e9: near 1, exp(-1e-9/2^20) has no digit left of it."""
    T = precise_integration(np.array([[-1e-9]]))
    assert 1 - float(T[0, 0]) == pytest.approx(1e-9, rel=1e-6)
    squared = np.exp(-1e-9 / 2**20)
    for _ in range(20):
        squared = squared * squared
    assert abs(1 - squared - 1e-9) > 1e-11


@pytest.mark.cites("(12) of Zhu")
@pytest.mark.parametrize("dt", [1e-4, 1 / 1000, 1 / 200])
def test_printed_input_matrix_is_that_of_a_force_that_stays(dt: float) -> None:
    A, B = state_space(structure())
    B_c = zero_order_hold(A, B, dt)[1]
    assert input_matrix(A, B, dt) == pytest.approx(B_c, abs=1e-9 * np.abs(B_c).max())


@pytest.mark.cites("(12) of Zhu")
@settings(deadline=None, max_examples=8)
@given(seed=SEEDS, dt=st.floats(0.01, 1))
def test_holds_agree_with_fine_integration(seed: int, dt: float) -> None:
    rng = np.random.default_rng(seed)
    A, B, x = stable(rng, 4), rng.normal(size=(4, 2)), rng.normal(size=4)
    F_0, F_1 = rng.normal(size=(2, 2))
    A_c, B_c = zero_order_hold(A, B, dt)
    assert A_c @ x + B_c @ F_0 == pytest.approx(runge_kutta(A, B, x, [F_0, F_0], dt), abs=1e-8)
    A_c, Gamma_1, Gamma_2 = first_order_hold(A, B, dt)
    moved = A_c @ x + Gamma_1 @ F_0 + Gamma_2 @ (F_1 - F_0)
    assert moved == pytest.approx(runge_kutta(A, B, x, [F_0, F_1], dt), abs=1e-8)


@settings(deadline=None, max_examples=20)
@given(dt=st.floats(1e-3, 10))
def test_a_mass_without_a_spring_has_a_hold_and_no_inverse(dt: float) -> None:
    A, B = np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]])
    A_c, B_c = zero_order_hold(A, B, dt)
    assert A_c == pytest.approx(np.array([[1, dt], [0, 1]]))
    assert B_c[:, 0] == pytest.approx([dt**2 / 2, dt])
    assert first_order_hold(A, B, dt)[2][:, 0] == pytest.approx([dt**2 / 6, dt / 2])
    with pytest.raises(np.linalg.LinAlgError):
        input_matrix(A, B, dt)


@settings(deadline=None, max_examples=15)
@given(seed=SEEDS, dt=st.floats(0.01, 1))
def test_moved_state_reads_as_the_state_does(seed: int, dt: float) -> None:
    """Over drawn forces, ξ of the first-order model gives the states and readings of X."""
    rng = np.random.default_rng(seed)
    A, B = stable(rng, 4), rng.normal(size=(4, 2))
    G, J = rng.normal(size=(3, 4)), rng.normal(size=(3, 2))
    moving, Gamma_2 = first_order_system(A, B, G, J, dt)
    A_c, Gamma_1, _ = first_order_hold(A, B, dt)
    X, F = rng.normal(size=4), rng.normal(size=(10, 2))
    xi = X - Gamma_2 @ F[0]
    for k in range(9):
        assert xi + Gamma_2 @ F[k] == pytest.approx(X)
        assert moving.G @ xi + moving.J @ F[k] == pytest.approx(G @ X + J @ F[k])
        X = A_c @ X + Gamma_1 @ F[k] + Gamma_2 @ (F[k + 1] - F[k])
        xi = moving.A_c @ xi + moving.B_c @ F[k]


@pytest.mark.cites("(12) of Zhu", "(13) of Zhu")
def test_system_holds_the_force() -> None:
    A, B = np.array([[-2.0]]), np.array([[3.0]])
    found = system(A, B, np.array([[5.0]]), np.array([[7.0]]), 0.5)
    assert float(found.A_c[0, 0]) == pytest.approx(math.exp(-1))
    assert float(found.B_c[0, 0]) == pytest.approx(1.5 * (1 - math.exp(-1)))
    assert (found.G, found.J) == (5.0, 7.0)
