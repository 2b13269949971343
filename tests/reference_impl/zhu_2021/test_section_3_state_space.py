"""State and measurements are the equations of motion, put in other words."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.zhu_2021.section_2_vehicle import TABLE_1, forces, structure
from floatref_reference.zhu_2021.section_3_state_space import output_matrices, state_space


@pytest.mark.cites("(9) of Zhu", "(10) of Zhu", "(11) of Zhu")
@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 9999), nm=st.integers(1, 6))
def test_state_and_measurements_follow_the_equations(seed: int, nm: int) -> None:
    rng = np.random.default_rng(seed)
    X, u = rng.normal(size=10), rng.normal(size=2)
    S_a, S_v, S_d = rng.normal(size=(3, nm, 5))
    vehicle, F = structure(), TABLE_1.k_5 * u
    Y_ddot = np.array(forces(TABLE_1, X[:5], X[5:], *u)) / np.diag(vehicle.M)
    A, B = state_space(vehicle)
    X_dot = A @ X + B @ F
    assert X_dot == pytest.approx(np.concatenate([X[5:], Y_ddot]), rel=1e-9)
    G, J = output_matrices(vehicle, S_a, S_v, S_d)
    Z = G @ X + J @ F
    assert pytest.approx(S_a @ Y_ddot + S_v @ X[5:] + S_d @ X[:5], rel=1e-9, abs=1e-6) == Z
