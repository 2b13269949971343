"""The discrete system equations are the kinematics before them, put together."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_2_frames import (
    direction_cosines,
    pitch_rate,
    roll_rate,
)
from floatref_reference.chapter_6.section_6_3_2_inertial_sensors import (
    measured_acceleration,
    vertical_acceleration,
)
from floatref_reference.chapter_6.section_6_3_4_gps_height import (
    measured_height,
    measured_velocity,
)
from floatref_reference.chapter_6.section_6_3_5_gps_attitude import measured_pitch, measured_roll
from floatref_reference.chapter_6.section_6_3_6_system import f, h, random_walk

Vector = npt.NDArray[np.float64]
ANGLE = st.floats(-1.2, 1.2)
SMALL = st.floats(-0.5, 0.5)
STATES = st.tuples(SMALL, SMALL, ANGLE, ANGLE, SMALL, SMALL, SMALL).map(np.array)
INPUTS = st.tuples(*[st.floats(-20, 20)] * 3, *[st.floats(-2, 2)] * 3).map(np.array)
NOISE = st.tuples(*[SMALL] * 7).map(np.array)


@pytest.mark.cites("(6.38)", "(6.47)")
@settings(deadline=None, max_examples=50)
@given(x=STATES, u=INPUTS, w=NOISE, dt=st.floats(1e-4, 1))
def test_process_model_is_kinematics(x: Vector, u: Vector, w: Vector, dt: float) -> None:
    r, v, theta, phi, delta_a, delta_1, delta_2 = x
    a = vertical_acceleration(u[:3], theta, phi, delta_a, w[0])
    omega = u[3:] + np.array([delta_1, delta_2, 0]) + w[1:4]
    after = f(x, u, dt, w)
    assert after[0] == pytest.approx(r + v * dt + a * dt**2 / 2)
    assert after[1] == pytest.approx(v + a * dt)
    assert after[2] == pytest.approx(theta + pitch_rate(phi, *omega[1:]) * dt)
    assert after[3] == pytest.approx(phi + roll_rate(theta, phi, omega) * dt)
    assert after[4:] == pytest.approx(x[4:] + w[4:])
    assert after[4:] == pytest.approx(random_walk(x[4:], w[4:]))


@pytest.mark.cites("(6.48)")
@settings(deadline=None, max_examples=50)
@given(x=STATES, u=INPUTS, w=NOISE, lever=st.tuples(*[st.floats(-3, 3)] * 3))
def test_measurement_model_is_kinematics(x, u, w, lever) -> None:
    r, v, theta, phi, _, delta_1, delta_2 = x
    omega = u[3:] + np.array([delta_1, delta_2, 0])
    y = h(x, u, lever, w[:4])
    assert y[0] == pytest.approx(measured_height(r, theta, phi, lever, w[0]))
    assert y[1] == pytest.approx(measured_velocity(v, theta, phi, omega, lever, w[1]))
    assert y[2] == pytest.approx(measured_pitch(theta, w[2]))
    assert y[3] == pytest.approx(measured_roll(theta, phi, w[3]))


def angles_at(t: float) -> tuple[Vector, Vector]:
    """Return yaw, pitch and roll of a vehicle that sways in a curve, and their rates."""
    angles = np.array([0.3 * t, 0.05 * np.sin(5 * t), 0.08 * np.sin(4 * t + 1)])
    return angles, np.array([0.3, 0.25 * np.cos(5 * t), 0.32 * np.cos(4 * t + 1)])


def inputs_at(t: float) -> Vector:
    """Return what ideal sensors read while the point also rises by 0.1 sin 3t m and brakes."""
    (psi, theta, phi), (psi_dot, theta_dot, phi_dot) = angles_at(t)
    a_n = [-3.0 * np.cos(psi), 1.0, -0.9 * np.sin(3 * t)]
    u_a = measured_acceleration(a_n, direction_cosines(psi, theta, phi))
    s_phi, c_phi, c_theta = np.sin(phi), np.cos(phi), np.cos(theta)
    omega = [
        phi_dot - np.sin(theta) * psi_dot,
        c_phi * theta_dot + s_phi * c_theta * psi_dot,
        c_phi * c_theta * psi_dot - s_phi * theta_dot,
    ]
    return np.array([*u_a, *omega])


def final_error(dt: float) -> Vector:
    """Return by how much 1 s of the process model misses the motion."""
    _, theta, phi = angles_at(0.0)[0]
    x = np.array([0.0, 0.3, theta, phi, 0.0, 0.0, 0.0])
    for k in range(round(1 / dt)):
        x = f(x, inputs_at(k * dt), dt)
    _, theta, phi = angles_at(1.0)[0]
    return x[:4] - np.array([0.1 * np.sin(3), 0.3 * np.cos(3), theta, phi])


@pytest.mark.cites("(6.47)")
def test_process_model_follows_a_known_motion_in_first_order() -> None:
    coarse, fine = final_error(1 / 100), final_error(1 / 200)
    assert abs(fine).max() < 5e-3
    assert coarse == pytest.approx(2 * fine, rel=0.1)
