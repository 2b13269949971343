"""What the accelerometers read is turned back into the motion that they felt."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_2_frames import direction_cosines
from floatref_reference.chapter_6.section_6_3_2_inertial_sensors import (
    G,
    acceleration,
    measured_acceleration,
    measured_rate,
    specific_force,
    vertical_acceleration,
)
from floatref_reference.chapter_6.section_6_3_6_system import f

ANGLE = st.floats(-1.2, 1.2)
TRIPLES = st.tuples(*[st.floats(-5, 5)] * 3)


@pytest.mark.cites("(6.32)", "(6.33)", "(6.34)", "(6.35)")
@settings(deadline=None, max_examples=30)
@given(psi=ANGLE, theta=ANGLE, phi=ANGLE, a_n=TRIPLES, delta=TRIPLES, e=TRIPLES)
def test_acceleration_comes_back(psi, theta, phi, a_n, delta, e) -> None:
    C_nb = direction_cosines(psi, theta, phi)
    u_a = measured_acceleration(a_n, C_nb, delta, e)
    assert acceleration(u_a, C_nb, delta, e) == pytest.approx(np.array(a_n), abs=1e-12)


@pytest.mark.cites("(6.36)", "(6.37)")
@settings(deadline=None, max_examples=30)
@given(psi=ANGLE, theta=ANGLE, phi=ANGLE, a_n=TRIPLES, bias=TRIPLES)
def test_drift_is_minus_the_vertical_part_of_the_biases(psi, theta, phi, a_n, bias) -> None:
    C_nb = direction_cosines(psi, theta, phi)
    u_a = measured_acceleration(a_n, C_nb, bias)
    delta_a = -(C_nb @ np.array(bias))[2]
    assert vertical_acceleration(u_a, theta, phi, delta_a) == pytest.approx(a_n[2], abs=1e-12)


@pytest.mark.cites("(6.33)")
def test_at_rest_and_level_it_is_1_g_upward() -> None:
    assert specific_force([0, 0, 0], np.eye(3)) == pytest.approx(np.array([0, 0, 9.80665]))
    assert G == 9.80665


@pytest.mark.cites("(6.37)")
def test_braking_nose_down_reads_low_without_the_pitch() -> None:
    C_nb = direction_cosines(0.0, 0.03, 0.0)
    u_a = measured_acceleration([-3.0, 0.0, 0.0], C_nb)
    assert vertical_acceleration(u_a, 0.0, 0.0) < -0.08
    assert vertical_acceleration(u_a, 0.03, 0.0) == pytest.approx(0, abs=1e-12)


@pytest.mark.cites("(6.30)")
@settings(deadline=None, max_examples=30)
@given(omega=TRIPLES, delta=TRIPLES, e=TRIPLES)
def test_model_adds_what_the_gyroscopes_lack(omega, delta, e) -> None:
    """At level, the angles turn by the true rates of roll and pitch."""
    u_omega = measured_rate(omega, [delta[0], delta[1], 0.0], [e[0], e[1], 0.0])
    x, w = np.array([0, 0, 0, 0, 0, delta[0], delta[1]]), np.array([0, e[0], e[1], 0, 0, 0, 0])
    after = f(x, [0, 0, G, *u_omega], 0.1, w)
    assert after[3] == pytest.approx(0.1 * omega[0])
    assert after[2] == pytest.approx(0.1 * omega[1])
