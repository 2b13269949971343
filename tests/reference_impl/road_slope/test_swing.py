"""Three nodes of the oscillator against its own solutions and the matrix exponential."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from floatref_reference.road_slope.swing import Swing, line_from_rest, swing

HZ, DAMPING, INTERVAL = st.floats(0.7, 3.0), st.floats(0.05, 0.8), st.floats(0.01, 0.15)
SMALL = st.floats(-1, 1)


def remains(by: Swing, theta: np.ndarray, u: np.ndarray) -> float:
    swung = theta[2] - by.trace * theta[1] + by.determinant * theta[0]
    return float(swung - (by.before * u[0] + by.now * u[1] + by.after * u[2]))


@given(hz=HZ, damping=DAMPING, interval=INTERVAL, phase=st.floats(0, 7))
def test_free_decay(hz: float, damping: float, interval: float, phase: float) -> None:
    t, omega = interval * np.arange(3), 2 * np.pi * hz
    theta = np.exp(-damping * omega * t) * np.cos(omega * np.sqrt(1 - damping**2) * t + phase)
    assert remains(swing(hz, damping, interval), theta, np.zeros(3)) == pytest.approx(0, abs=1e-13)


@given(hz=HZ, damping=DAMPING, interval=INTERVAL, level=SMALL, rise=SMALL)
def test_a_line_is_followed_late_with_a_gain_of_1(
    hz: float, damping: float, interval: float, level: float, rise: float
) -> None:
    u = level + rise * interval * np.arange(3)
    theta = u - rise * 2 * damping / (2 * np.pi * hz)
    assert remains(swing(hz, damping, interval), theta, u) == pytest.approx(0, abs=1e-13)


@given(
    hz=HZ,
    damping=DAMPING,
    interval=INTERVAL,
    u=st.tuples(SMALL, SMALL, SMALL),
    at_first=st.tuples(SMALL, st.floats(-5, 5)),
)
def test_any_motion_under_any_three_values(
    hz: float,
    damping: float,
    interval: float,
    u: tuple[float, float, float],
    at_first: tuple[float, float],
) -> None:
    """By the exponential of the oscillator together with u and its constant rate."""
    omega = 2 * np.pi * hz
    matrix = np.zeros((4, 4))
    matrix[0, 1] = matrix[2, 3] = 1
    matrix[1, :3] = -(omega**2), -2 * damping * omega, omega**2
    over, state, theta = expm(matrix * interval), np.array(at_first), [at_first[0]]
    for now, then in ((u[0], u[1]), (u[1], u[2])):
        state = (over @ [*state, now, (then - now) / interval])[:2]
        theta.append(state[0])
    left = remains(swing(hz, damping, interval), np.array(theta), np.array(u))
    assert left == pytest.approx(0, abs=1e-12)


@given(hz=HZ, damping=DAMPING)
def test_a_line_begins_at_rest(hz: float, damping: float) -> None:
    """It begins as ω² t³/6."""
    t = 1e-3
    expected = (2 * np.pi * hz) ** 2 * t**3 / 6
    assert line_from_rest(hz, damping, 0.0) == pytest.approx(0, abs=1e-15)
    assert line_from_rest(hz, damping, t) == pytest.approx(expected, rel=0.02)


@given(hz=HZ, damping=DAMPING)
def test_a_complex_step_gives_its_derivatives(hz: float, damping: float) -> None:
    h = 1e-6
    for d_hz, d_damping in ((1, 0), (0, 1)):
        by_step = swing(hz + 1e-30j * d_hz, damping + 1e-30j * d_damping, 0.03)
        above = swing(hz + h * d_hz, damping + h * d_damping, 0.03)
        below = swing(hz - h * d_hz, damping - h * d_damping, 0.03)
        expected = (np.array(above) - np.array(below)) / (2 * h)
        assert np.imag(by_step) / 1e-30 == pytest.approx(expected, abs=1e-8)
