"""The quarter car with masses: the Golden Car of the dissertation, and a damped tyre."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.beyond.quarter_car_response import ResponseCar, structure
from floatref_reference.chapter_2.section_2_1_1_golden_car import GOLDEN_CAR, state_matrices
from floatref_reference.zhu_2021.section_3_state_space import state_space

CARS = st.builds(
    ResponseCar,
    m_s=st.floats(100, 5000),
    m_u=st.floats(10, 900),
    k_s=st.floats(1e3, 1e6),
    c_s=st.floats(0, 1e5),
    k_t=st.floats(1e4, 1e7),
    c_t=st.floats(0, 1e4),
)


@settings(deadline=None, max_examples=20)
@given(m_s=st.floats(100, 5000))
def test_golden_car_of_any_mass_is_that_of_the_dissertation(m_s: float) -> None:
    """Its state is (z_s, z_s', z_u, z_u') and its input the road, not the force."""
    K_1, K_2, C, mu = GOLDEN_CAR
    car = ResponseCar(m_s, mu * m_s, K_2 * m_s, C * m_s, K_1 * m_s)
    A, B = state_space(structure(car))
    order = [0, 2, 1, 3]
    expected, by_road = state_matrices()
    assert A[np.ix_(order, order)] == pytest.approx(expected.astype(float))
    assert B[order, 0] * car.k_t == pytest.approx(by_road.astype(float))


@settings(deadline=None, max_examples=30)
@given(car=CARS, z=st.tuples(*[st.floats(-1, 1)] * 2), rate=st.tuples(*[st.floats(-1, 1)] * 2))
def test_forces_between_the_masses_are_equal_and_opposite(car: ResponseCar, z, rate) -> None:
    """What is left over is the tyre's; lifted with the road as one, nothing is pushed."""
    _, C, K, S_p = structure(car)
    inner = -K @ np.array(z) - C @ np.array(rate)
    tyre = -car.k_t * z[1] - car.c_t * rate[1]
    assert inner.sum() == pytest.approx(tyre, abs=1e-9 * (car.k_t + car.k_s + car.c_s))
    lifted = S_p[:, 0] * (car.k_t * z[0] + car.c_t * rate[0])
    lifted -= K @ np.full(2, z[0]) + C @ np.full(2, rate[0])
    assert lifted == pytest.approx(np.zeros(2), abs=1e-9 * (car.k_t + car.c_t))
