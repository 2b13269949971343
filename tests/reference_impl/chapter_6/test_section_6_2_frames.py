"""Direction cosines are three rotations, and their rates are those of a turning body."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_2_frames import (
    direction_cosine_rates,
    direction_cosines,
    in_body_frame,
    pitch_rate,
    roll_rate,
)

Matrix = npt.NDArray[np.float64]
ANGLE = st.floats(-1.2, 1.2)
RATES = st.tuples(*[st.floats(-2, 2)] * 3)
MINUTE = 1e-6


def turn(axis: int, angle: float) -> Matrix:
    """Return the right-handed rotation about one axis."""
    cosine, sine = np.cos(angle), np.sin(angle)
    after, before = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.zeros((3, 3))
    matrix[axis, axis] = 1
    matrix[after, after] = matrix[before, before] = cosine
    matrix[before, after], matrix[after, before] = sine, -sine
    return matrix


@pytest.mark.cites("(6.23)", "(6.24)")
@settings(deadline=None, max_examples=30)
@given(psi=ANGLE, theta=ANGLE, phi=ANGLE)
def test_yaw_pitch_roll(psi: float, theta: float, phi: float) -> None:
    C_nb = direction_cosines(psi, theta, phi)
    assert C_nb == pytest.approx(turn(2, psi) @ turn(1, theta) @ turn(0, phi))
    a_n = np.array([1.0, -2.0, 3.0])
    assert C_nb @ in_body_frame(a_n, C_nb) == pytest.approx(a_n)


@pytest.mark.cites("(6.23)")
def test_positive_pitch_is_nose_down_and_positive_roll_left_side_up() -> None:
    forward, left = np.eye(3)[0], np.eye(3)[1]
    assert (direction_cosines(0.3, 0.1, 0) @ forward)[2] < 0
    assert (direction_cosines(0.3, 0, 0.1) @ left)[2] > 0


@pytest.mark.cites("(6.25)", "(6.26)", "(6.27)", "(6.28)")
@settings(deadline=None, max_examples=30)
@given(psi=ANGLE, theta=ANGLE, phi=ANGLE, omega=RATES)
def test_a_body_that_turns(psi: float, theta: float, phi: float, omega: tuple[float, ...]) -> None:
    """Turned by a small ω t about its own axes, it has the Euler angles of the printed rates."""
    C_nb = direction_cosines(psi, theta, phi)
    small = np.asarray(omega) * MINUTE
    turned = C_nb @ turn(0, small[0]) @ turn(1, small[1]) @ turn(2, small[2])
    assert (turned - C_nb) / MINUTE == pytest.approx(direction_cosine_rates(C_nb, omega), abs=2e-5)
    pitch, roll = np.arcsin(-turned[2, 0]), np.arctan2(turned[2, 1], turned[2, 2])
    assert (pitch - theta) / MINUTE == pytest.approx(pitch_rate(phi, *omega[1:]), abs=5e-5)
    assert (roll - phi) / MINUTE == pytest.approx(roll_rate(theta, phi, omega), abs=5e-5)
