"""The quarter car: its response in frequency and its transition in distance are one system."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from floatref.measures import GOLDEN_CAR, RIDE_NUMBER_CAR, QuarterCar
from floatref.measures.roughness.quarter_car import Modes

CARS = [GOLDEN_CAR, RIDE_NUMBER_CAR]


def unpacked(modes: Modes) -> tuple[np.ndarray, np.ndarray]:
    poles = np.array([mode.pole_re + 1j * mode.pole_im for mode in modes])
    return poles, np.array([mode.gain_re + 1j * mode.gain_im for mode in modes])


@pytest.mark.parametrize("car", CARS)
@given(step=st.floats(1e-5, 0.1))
@settings(deadline=None, max_examples=20)
def test_modes_are_the_matrix_exponential_of_the_equations_of_motion(
    car: QuarterCar, step: float
) -> None:
    k1, k2, c, mu = (
        car.tyre_stiffness,
        car.suspension_stiffness,
        car.damping,
        car.mass_ratio,
    )
    held = np.zeros((5, 5))
    held[0, 1] = held[2, 3] = 1.0
    held[1, :4] = [-k2, -c, k2, c]
    held[3] = [k2 / mu, c / mu, -(k1 + k2) / mu, -c / mu, k1 / mu]
    exact = expm(held * step)
    state, expected = np.zeros(5), []
    state[4] = 1.0
    poles, gains = unpacked(car.modes(step))
    modal, found = np.zeros(2, dtype=complex), []
    for _ in range(6):
        state = exact @ state
        expected.append(state[0] - state[2])
        modal = poles * modal + gains
        found.append(modal.real.sum())
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-12)


@pytest.mark.cites("(2.9)")
@given(frequency=st.floats(0.05, 30.0))
@settings(deadline=None, max_examples=20)
def test_modes_at_a_short_step_have_the_stroke_response(frequency: float) -> None:
    omega, step = 2 * np.pi * frequency, 1e-6
    poles, gains = unpacked(GOLDEN_CAR.modes(step))
    z = np.exp(1j * omega * step)
    # A sum of real parts is the mean of each mode and its conjugate.
    response = 0.5 * sum(
        g / (z - p) + np.conj(g) / (z - np.conj(p)) for p, g in zip(poles, gains, strict=True)
    )
    expected = -GOLDEN_CAR.stroke_response(np.array([omega]))[0]
    assert abs(abs(response) / abs(expected) - 1) < 1e-3


def test_a_road_of_constant_slope_leaves_the_suspension_at_rest() -> None:
    assert abs(GOLDEN_CAR.stroke_response(np.array([0.0]))[0]) == 0.0


def test_the_corrected_damping_vanishes_where_the_tyre_carries_both_masses() -> None:
    omega = np.sqrt(GOLDEN_CAR.tyre_stiffness / (1 + GOLDEN_CAR.mass_ratio))
    response = GOLDEN_CAR.stroke_response(np.array([omega]))[0]
    assert response.imag == pytest.approx(0.0, abs=1e-9)
    # There the damper does no work on the response, whatever its constant: an invariant point.
    soft = QuarterCar(653.0, 63.3, 1.0, 0.15).stroke_response(np.array([omega]))[0]
    assert response == pytest.approx(soft, rel=1e-9)
