"""What is levelled is what a level accelerometer would read."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_reference.road_slope.levelled import Found, Samples, levelled

G = 9.80665
ANGLE, FORCE = st.floats(-0.05, 0.05), st.floats(-5, 5)


LEAN = st.floats(-0.02, 0.02)


@given(theta=ANGLE, lean=LEAN, grade=ANGLE, along=FORCE, up=st.floats(-1, 1))
def test_but_for_a_constant_a_grade_and_higher_powers_of_the_pitch(
    theta: float, lean: float, grade: float, along: float, up: float
) -> None:
    """At a pitch P it reads (z'' + g) cos P - a sin P; g λ²/2 of it is the bias of a level road.

    Over a grade s̄ a vehicle rises by a s̄.
    """
    P, one = theta + lean, np.ones(1)
    reading = (up + G) * np.cos(P) - along * np.sin(P) - G
    samples = Samples(0 * one, reading * one, along * one, 0 * one)
    found = Found(np.array([-1.0, 1.0]), theta * np.ones(2), lean, grade)
    level = levelled(samples, found, 1.0, G)
    bound = abs(along * P**3) / 6 + abs(up) * P**2 / 2 + G * P**4 / 24
    assert abs(level.vertical[0] - (up - along * grade - G / 2 * lean**2)) <= bound + 1e-12


@given(pitch=st.lists(ANGLE, min_size=2, max_size=5), lever=st.floats(-2, 2))
def test_heights_are_those_under_the_accelerometer(pitch: list[float], lever: float) -> None:
    """Between nodes the pitch is a line."""
    t = np.arange(len(pitch), dtype=float)
    between, mean = (t[1:] + t[:-1]) / 2, (np.array(pitch[1:]) + pitch[:-1]) / 2
    zero = np.zeros(len(between))
    samples = Samples(between, zero, zero, 0.3 + lever * mean)
    level = levelled(samples, Found(t, np.array(pitch), 0.0, 0.0), lever, G)
    assert level.height == pytest.approx(np.full(len(between), 0.3))
