"""Body and wander axes: a rotation and its inverses."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2 import section_2_3_1_kinematics as section

G = 9.80665
ANGLES = st.floats(-0.5, 0.5)
ACCELERATIONS = st.tuples(*[st.floats(-10.0, 10.0)] * 3)


@pytest.mark.cites("(2.19)", "(2.20)")
@settings(deadline=None, max_examples=40)
@given(a_w=ACCELERATIONS, theta=ANGLES, phi=ANGLES)
def test_both_corrections_recover_the_true_vertical_acceleration(
    a_w: tuple[float, float, float], theta: float, phi: float
) -> None:
    a_b = section.body_fixed_acceleration(a_w, theta, phi)
    from_body = section.vertical_acceleration_from_body(a_b, theta, phi)
    from_horizontal = section.vertical_acceleration_from_horizontal(
        a_b[2], a_w[0], a_w[1], theta, phi
    )
    assert float(from_body) == pytest.approx(a_w[2], abs=1e-13)
    assert float(from_horizontal) == pytest.approx(a_w[2], abs=1e-13)


@pytest.mark.cites("(2.17)")
@settings(deadline=None, max_examples=40)
@given(a_w=ACCELERATIONS, theta=ANGLES, phi=ANGLES)
def test_tilt_turns_the_specific_force_without_stretching_it(
    a_w: tuple[float, float, float], theta: float, phi: float
) -> None:
    up = np.array([0.0, 0.0, G])
    a_b = section.body_fixed_acceleration(a_w, theta, phi)
    expected = np.linalg.norm(np.asarray(a_w) + up)
    assert float(np.sqrt(((a_b + up) ** 2).sum())) == pytest.approx(expected, rel=1e-12)


@settings(deadline=None, max_examples=20)
@given(angle=ANGLES)
def test_at_rest_a_tilted_accelerometer_reads_gravity(angle: float) -> None:
    nose_down = section.body_fixed_acceleration([0, 0, 0], angle, 0)
    left_up = section.body_fixed_acceleration([0, 0, 0], 0, angle)
    s, c = math.sin(angle), math.cos(angle)
    assert nose_down == pytest.approx(np.array([-G * s, 0, G * c - G]), abs=1e-14)
    assert left_up == pytest.approx(np.array([0, G * s, G * c - G]), abs=1e-14)


def test_braking_nose_down_reads_too_low() -> None:
    assert section.body_fixed_acceleration([-3.0, 0.0, 0.0], 0.03, 0.0)[2] < -0.09


def test_signals_over_time_are_taken_sample_by_sample() -> None:
    a_w = np.arange(12.0).reshape(3, 4)
    theta, phi = np.linspace(-0.2, 0.2, 4), np.linspace(0.1, 0.3, 4)
    together = section.body_fixed_acceleration(a_w, theta, phi)
    for k in range(4):
        assert (
            section.body_fixed_acceleration(a_w[:, k], theta[k], phi[k]) == together[:, k]
        ).all()


@pytest.mark.cites("(2.18)")
@settings(deadline=None, max_examples=20)
@given(height=st.floats(0.1, 1.0), theta=ANGLES, phi=ANGLES)
def test_tilted_ray_meets_flat_ground_farther_away(height: float, theta: float, phi: float) -> None:
    down = math.cos(theta) * math.cos(phi)
    measured = float(section.body_fixed_height(height, theta, phi))
    assert measured * down == pytest.approx(height, rel=1e-12)
    assert measured >= height
