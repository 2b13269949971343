"""The antenna is a point of the body: its height and velocity follow from the rotation."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_2_frames import (
    direction_cosine_rates,
    direction_cosines,
)
from floatref_reference.chapter_6.section_6_3_4_gps_height import (
    antenna_offset,
    antenna_velocity,
    measured_height,
    measured_velocity,
)

ANGLE = st.floats(-1.2, 1.2)
TRIPLES = st.tuples(*[st.floats(-3, 3)] * 3)


@pytest.mark.cites("(6.39)", "(6.41)")
@settings(deadline=None, max_examples=30)
@given(theta=ANGLE, phi=ANGLE, lever=TRIPLES, height=st.floats(-5, 5), e=st.floats(-1, 1))
def test_height_is_the_third_coordinate_of_the_antenna(theta, phi, lever, height, e) -> None:
    offset = (direction_cosines(0.7, theta, phi) @ np.array(lever))[2]
    assert antenna_offset(theta, phi, lever) == pytest.approx(offset)
    assert measured_height(height, theta, phi, lever, e) == pytest.approx(height + offset + e)


@pytest.mark.cites("(6.40)", "(6.42)")
@settings(deadline=None, max_examples=30)
@given(theta=ANGLE, phi=ANGLE, omega=TRIPLES, lever=TRIPLES, v=st.floats(-5, 5), e=st.floats(-1, 1))
def test_velocity_is_its_rate(theta, phi, omega, lever, v, e) -> None:
    rates = direction_cosine_rates(direction_cosines(0.7, theta, phi), omega)
    velocity = (rates @ np.array(lever))[2]
    assert antenna_velocity(theta, phi, omega, lever) == pytest.approx(velocity)
    assert measured_velocity(v, theta, phi, omega, lever, e) == pytest.approx(v + velocity + e)
