"""Slips in the print of Zhu et al. (2021): the printed form fails, the mended one holds."""

import math

import numpy as np
import numpy.typing as npt
import pytest

from floatref_reference.zhu_2021.section_2_vehicle import TABLE_1, HalfCar, forces, structure
from floatref_reference.zhu_2021.section_3_discretization import precise_integration
from floatref_reference.zhu_2021.section_3_joint_estimation import input_estimation, time_update
from floatref_reference.zhu_2021.section_3_state_space import output_matrices, state_space
from floatref_reference.zhu_2021.section_4_1_random_road import SAMPLING_RATE, SPEED, TABLE_2
from floatref_reference.zhu_2021.section_4_3_speed import calculation_rate

Matrix = npt.NDArray[np.float64]


def half_lives(car: HalfCar) -> list[float]:
    """Return the time in s in which each mode falls to half, the longest first."""
    rates = -np.linalg.eigvals(state_space(structure(car))[0]).real
    return [math.log(2) / rate for rate in sorted(rates)]


def test_damping_of_the_rear_wheel_7() -> None:
    """At 1 m/s of the rear wheel alone its force is that of (4), and energy is lost, not made."""
    mended = structure()
    printed = mended._replace(C=mended.C.copy())
    printed.C[2, 2] = -2 * TABLE_1.c_4
    wheel = np.array([0, 0, 1.0, 0, 0])
    force = forces(TABLE_1, np.zeros(5), wheel, 0.0, 0.0)[2]
    assert -(mended.C @ wheel)[2] == pytest.approx(force)
    assert -(printed.C @ wheel)[2] == pytest.approx(-force)
    growth = [np.linalg.eigvals(state_space(v)[0]).real.max() for v in (printed, mended)]
    assert growth[0] == pytest.approx(6.61, abs=0.01)
    assert growth[1] < 0


def test_unit_of_the_dampings_table_1() -> None:
    """The longest half-life, of the body on its springs, in days and in minutes."""
    printed = half_lives(TABLE_1._replace(c_3=0.79, c_4=0.0012))
    assert printed[0] / 86_400 == pytest.approx(15.8, abs=0.1)
    assert half_lives(TABLE_1)[0] / 60 == pytest.approx(1.5, abs=0.1)


def test_shape_of_the_input_matrix_9() -> None:
    """Two forces act: beside them n columns of zeros do not fit, two do."""
    M, _, _, S_p = structure()
    by_force = np.linalg.inv(M) @ S_p
    with pytest.raises(ValueError, match="dimension"):
        np.vstack([np.zeros((5, 5)), by_force])
    assert state_space(structure())[1] == pytest.approx(np.vstack([np.zeros((5, 2)), by_force]))


def test_order_of_the_state_9() -> None:
    """A free motion differentiates to A X with displacements first, and not the other way."""
    A = state_space(structure())[0]
    X, h = np.array([0.01, 0.02, -0.01, 0.0, 0.001, 0.1, -0.2, 0.3, 0.1, 0.02]), 1e-6
    X_dot = (precise_integration(A * h) @ X - precise_integration(-A * h) @ X) / (2 * h)
    scale = np.abs(X_dot).max()
    assert pytest.approx(X_dot, abs=1e-5 * scale) == A @ X
    velocities_first = np.roll(X, 5)
    assert np.abs(A @ velocities_first - np.roll(X_dot, 5)).max() > scale


def measured(acceleration: bool) -> tuple[Matrix, Matrix]:
    eye, none = np.eye(5), np.zeros((5, 5))
    S_a, S_d = (eye, none) if acceleration else (none, eye)
    return output_matrices(structure(), S_a, none, S_d)


def test_measurements_without_accelerations_step_a() -> None:
    (G, J), (G_a, J_a) = measured(acceleration=False), measured(acceleration=True)
    assert not J.any()
    with pytest.raises(ValueError, match="wheel accelerations"):
        input_estimation(np.zeros(10), np.zeros(5), G, J, np.eye(5))
    F = np.array([1e4, -2e4])
    found, _ = input_estimation(np.zeros(10), J_a @ F, G_a, J_a, np.eye(5))
    assert found == pytest.approx(F)


def test_cross_covariance_step_c() -> None:
    """Of 10 states and 2 forces the corners of the joint covariance are not the same matrix."""
    rng = np.random.default_rng(2)
    root = rng.normal(size=(12, 12))
    joint = root @ root.T
    P, P_XF, P_F = joint[:10, :10], joint[:10, 10:], joint[10:, 10:]
    with pytest.raises(ValueError, match="dimension"):
        np.block([[P, P_XF], [P_XF, P_F]])
    A_c, B_c = rng.normal(size=(10, 10)), rng.normal(size=(10, 2))
    _, P_next = time_update(np.zeros(10), P, np.zeros(2), P_F, P_XF, A_c, B_c, np.zeros((10, 10)))
    spread = np.hstack([A_c, B_c]) @ root
    assert P_next == pytest.approx(spread @ spread.T)


def test_calculation_rate_4_3() -> None:
    assert calculation_rate(SPEED) == pytest.approx(SAMPLING_RATE)
    assert calculation_rate(20.0) == pytest.approx(400.0)
    printed = 1 / (20 * SPEED)
    assert printed * SAMPLING_RATE == pytest.approx(1.0)


def test_less_than_ten_per_cent_6() -> None:
    assert max(TABLE_2) > 10
    assert np.mean(TABLE_2) < 10
