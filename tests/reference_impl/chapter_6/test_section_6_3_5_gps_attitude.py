"""Inclinations are those of the body's axes, nose down and left side up."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_2_frames import direction_cosines
from floatref_reference.chapter_6.section_6_3_5_gps_attitude import (
    measured_pitch,
    measured_roll,
    pitch_inclination,
    roll_inclination,
)

ANGLE = st.floats(-1.2, 1.2)


@pytest.mark.cites("(6.43)", "(6.44)", "(6.45)", "(6.46)")
@settings(deadline=None, max_examples=30)
@given(psi=ANGLE, theta=ANGLE, phi=ANGLE, e=st.floats(-0.1, 0.1))
def test_inclination_of_the_axes(psi: float, theta: float, phi: float, e: float) -> None:
    downward, upward = (
        -direction_cosines(psi, theta, phi)[2, 0],
        direction_cosines(psi, theta, phi)[2, 1],
    )
    assert pitch_inclination(theta) == pytest.approx(math.asin(downward))
    assert roll_inclination(theta, phi) == pytest.approx(math.asin(upward))
    assert measured_pitch(theta, e) == pytest.approx(math.asin(downward) + e)
    assert measured_roll(theta, phi, e) == pytest.approx(math.asin(upward) + e)
