"""Observer and estimator: their matrices are the equations, and their error obeys L."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.imine.section_2_trailer import TRAILER, Trailer, forces
from floatref_reference.imine.section_4_a_observer import estimator, observer
from floatref_reference.imine.section_4_b_convergence import (
    error_matrix,
    printed_conditions,
    slowest_rate,
)
from floatref_reference.imine.section_4_state_form import input_matrices, output_matrix, state_form

Matrix = npt.NDArray[np.float64]
TRAILERS = st.tuples(*[st.floats(0.3, 3.0)] * 16).map(
    lambda scales: Trailer(*(value * s for value, s in zip(TRAILER, scales, strict=True)))
)
SEEDS = st.integers(0, 9999)
POSITIONS = output_matrix([0, 1, 2, 3, 4])


def gains(omega: float) -> Matrix:
    """Return gains on the five displacements that settle each at the rate ω, undisturbed."""
    return np.vstack([2 * omega * np.eye(5), omega**2 * np.eye(5)])


@pytest.mark.cites("(8) of Imine", "(9) of Imine")
@settings(deadline=None, max_examples=30)
@given(trailer=TRAILERS, seed=SEEDS)
def test_state_form_is_the_equations_of_motion(trailer: Trailer, seed: int) -> None:
    """Forward: accelerations from the road. Backward: rates of the road from accelerations."""
    rng, form = np.random.default_rng(seed), state_form(trailer)
    x, (u, u_dot) = rng.normal(size=10), rng.normal(size=(2, 2))
    q_ddot = np.array(forces(x[:5], x[5:], u, u_dot, trailer)) / np.array(trailer[:5])
    x_dot = form.A @ x + form.C_1 @ u + form.D_1 @ u_dot
    scale = np.abs(form.A).max()
    assert x_dot == pytest.approx(np.concatenate([x[5:], q_ddot]), abs=1e-10 * scale)
    solved = form.A_2 @ x + form.C_2 @ u + form.D_2 @ q_ddot[:2]
    assert solved == pytest.approx(u_dot, abs=1e-10 * np.abs(form.A_2).max())


@pytest.mark.parametrize("damping", [{"B_3": 0.0}, {"B_4": 0.0}, {"B_4": -1.0}])
def test_tyres_without_damping_leave_nothing_to_integrate(damping: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="above zero"):
        input_matrices(TRAILER._replace(**damping))


@pytest.mark.cites("(10) of Imine", "(11) of Imine", "(12) to (15) of Imine")
@settings(deadline=None, max_examples=30)
@given(trailer=TRAILERS, seed=SEEDS)
def test_error_obeys_its_matrix(trailer: Trailer, seed: int) -> None:
    """Whatever trailer, road and estimate do, what the error does depends on the error alone."""
    rng, form = np.random.default_rng(seed), state_form(trailer)
    G = 100 * rng.normal(size=(10, 5))
    x, e_1 = rng.normal(size=(2, 10))
    u, u_dot, e_2 = rng.normal(size=(3, 2))
    x_dot = form.A @ x + form.C_1 @ u + form.D_1 @ u_dot
    u_bar_dot = estimator(x + e_1, u + e_2, x_dot[5:7], form)
    x_bar_dot = observer(x + e_1, u + e_2, u_bar_dot, POSITIONS @ x, form, G, POSITIONS)
    L = error_matrix(form, G, POSITIONS)
    found = np.concatenate([x_bar_dot - x_dot, u_bar_dot - u_dot])
    e = np.concatenate([e_1, e_2])
    assert found == pytest.approx(L @ e, abs=1e-9 * np.abs(form.A).max())


@pytest.mark.cites("(14) of Imine")
@settings(deadline=None, max_examples=30)
@given(trailer=TRAILERS, seed=SEEDS)
def test_error_matrix_is_block_triangular(trailer: Trailer, seed: int) -> None:
    """The road's error leaves the state's alone, and fades by the tyres' own rates."""
    form = state_form(trailer)
    G = 100 * np.random.default_rng(seed).normal(size=(10, 5))
    through_road = form.C_1 + form.D_1 @ form.C_2
    assert np.abs(through_road).max() <= 1e-12 * np.abs(form.C_1).max()
    L = error_matrix(form, G, POSITIONS)
    assert np.array_equal(L[:10, 10:], np.zeros((10, 2)))
    rates = [-trailer.k_3 / trailer.B_3, -trailer.k_4 / trailer.B_4]
    assert L[10:, 10:] == pytest.approx(np.diag(rates))
    assert np.array_equal(L[10:, :10], form.A_2)
    wheels = L[[5, 6], 5:10]
    assert wheels == pytest.approx(np.zeros((2, 5)), abs=1e-9 * np.abs(form.A).max())


@pytest.mark.cites("(15) of Imine")
@settings(deadline=None, max_examples=20)
@given(trailer=TRAILERS, omega=st.floats(5, 60))
def test_gains_decide_whether_errors_vanish(trailer: Trailer, omega: float) -> None:
    form = state_form(trailer)
    assert slowest_rate(error_matrix(form, gains(omega), POSITIONS)) < 0
    assert slowest_rate(error_matrix(form, 0 * gains(omega), POSITIONS)) > -1e-4
    assert slowest_rate(error_matrix(form, -gains(omega), POSITIONS)) > omega / 2


@pytest.mark.cites("(19) of Imine", "(20) of Imine")
def test_each_printed_condition_is_a_bound_of_its_own_gain() -> None:
    g = np.full(10, 1e3)
    assert printed_conditions(g, TRAILER)
    for i in range(10):
        below = g.copy()
        below[i] = -1e3
        assert not printed_conditions(below, TRAILER)
