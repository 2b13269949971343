"""The half car: the matrices are those of its equations, and its springs and dampers are real."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.zhu_2021.section_2_vehicle import (
    TABLE_1,
    HalfCar,
    delay,
    forces,
    rear_road,
    structure,
    structure_of_equations,
)
from floatref_reference.zhu_2021.section_3_discretization import precise_integration
from floatref_reference.zhu_2021.section_3_state_space import state_space

Vector = npt.NDArray[np.float64]
CARS = st.tuples(*[st.floats(0.3, 3.0)] * 13).map(
    lambda scales: HalfCar(*(value * s for value, s in zip(TABLE_1, scales, strict=True)))
)
MOTIONS = st.tuples(*[st.floats(-1, 1)] * 5).map(np.array)


def potential(car: HalfCar, Y: Vector, u: Vector) -> float:
    """Return the energy in the springs: one below the equipment, four suspensions, two tyres."""
    y_1, y_2, y_3, y_4, theta = Y
    equipment = car.k_3 * (y_1 - (y_2 + car.e * theta)) ** 2
    suspensions = 2 * car.k_4 * (y_2 - car.L_1 * theta - y_3) ** 2
    suspensions += 2 * car.k_4 * (y_2 + car.L_2 * theta - y_4) ** 2
    tyres = car.k_5 * ((y_3 - u[0]) ** 2 + (y_4 - u[1]) ** 2)
    return float(equipment + suspensions + tyres) / 2


@pytest.mark.cites("(7) of Zhu")
@settings(deadline=None, max_examples=40)
@given(car=CARS)
def test_matrices_as_written_are_those_of_the_equations(car: HalfCar) -> None:
    for written, read_off in zip(structure(car), structure_of_equations(car), strict=True):
        assert written == pytest.approx(read_off, rel=1e-12, abs=1e-9 * np.abs(written).max())


@pytest.mark.cites("(2) to (6) of Zhu")
@settings(deadline=None, max_examples=40)
@given(car=CARS, Y=MOTIONS, u=st.tuples(*[st.floats(-1, 1)] * 2).map(np.array))
def test_forces_are_what_the_springs_lose_in_energy(car: HalfCar, Y: Vector, u: Vector) -> None:
    """Central differences are exact on squares, whatever their step."""
    found = np.array(forces(car, Y, np.zeros(5), *u))
    lost = [potential(car, Y - unit, u) - potential(car, Y + unit, u) for unit in np.eye(5)]
    assert found == pytest.approx(np.array(lost) / 2, abs=1e-9 * car.k_4 * car.L_2**2)


@pytest.mark.cites("(7) of Zhu")
@settings(deadline=None, max_examples=40)
@given(car=CARS)
def test_matrices_are_symmetric_and_make_no_energy(car: HalfCar) -> None:
    for matrix in structure(car)[:3]:
        assert np.array_equal(matrix, matrix.T)
        lowest = np.linalg.eigvalsh(matrix)[0]
        assert lowest >= -1e-9 * np.abs(matrix).max()


@pytest.mark.cites("(7) of Zhu", "(9) of Zhu")
@settings(deadline=None, max_examples=20)
@given(car=CARS, Y=MOTIONS, Y_dot=MOTIONS, dt=st.floats(1e-4, 1e-2))
def test_energy_is_kept_without_damping(car: HalfCar, Y: Vector, Y_dot: Vector, dt: float) -> None:
    vehicle = structure(car._replace(c_3=0.0, c_4=0.0))
    A_c = precise_integration(state_space(vehicle)[0] * dt)
    X = np.concatenate([0.01 * Y, 0.1 * (Y_dot + 2)])
    energies = []
    for _ in range(50):
        energies.append(X[5:] @ vehicle.M @ X[5:] + X[:5] @ vehicle.K @ X[:5])
        X = A_c @ X
    assert energies == pytest.approx(np.full(50, energies[0]), rel=1e-8)


@pytest.mark.cites("(8) of Zhu")
@settings(deadline=None, max_examples=30)
@given(v=st.floats(1.0, 40.0), slope=st.floats(-0.1, 0.1), dt=st.floats(1e-3, 0.05))
def test_rear_wheels_meet_a_slope_later_by_the_wheelbase(v: float, slope: float, dt: float) -> None:
    """On a straight slope in distance the rear wheels are lower by slope times wheelbase."""
    u_2 = slope * v * dt * np.arange(600)
    u_1 = rear_road(u_2, dt, v)
    there = np.arange(600) * dt >= delay(v)
    assert u_2[there] - u_1[there] == pytest.approx(np.full(there.sum(), slope * 9.38), abs=1e-12)
    assert np.array_equal(u_1[~there], np.full((~there).sum(), u_2[0]))


@pytest.mark.parametrize("v", [0.0, -1.0, float("nan")])
def test_a_vehicle_that_stands_has_no_delay(v: float) -> None:
    with pytest.raises(ValueError, match="never come"):
        delay(v)
