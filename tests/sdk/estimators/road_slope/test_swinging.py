"""The answer at three nodes is that of the oscillator, integrated in fine steps."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.road_slope.swinging import Swing
from floatref.values.arrays import FloatArray
from floatref_reference.road_slope.swing import swing as literal_swing

HZ, DAMPING, INTERVAL = st.floats(0.7, 3.0), st.floats(0.05, 0.8), st.floats(0.01, 0.1)
SEEDS = st.integers(0, 2**32 - 1)
FINE = 300


def of(hz: float, damping: float, interval_s: float) -> Swing:
    return Swing.of(float(np.log(hz)), float(np.log(damping)), interval_s)


def integrate(
    hz: float, damping: float, step: float, u: FloatArray, state: FloatArray
) -> FloatArray:
    """Return θ after each of the steps of ``step`` s, by the implicit midpoint rule."""
    omega = 2 * np.pi * hz
    matrix = np.array([[0.0, 1.0], [-(omega**2), -2 * damping * omega]])
    ahead, behind = np.eye(2) - step / 2 * matrix, np.eye(2) + step / 2 * matrix
    forward = np.linalg.solve(ahead, behind)
    drive = np.linalg.solve(ahead, np.array([0.0, step * omega**2]))
    found = [state[0]]
    for middle in (u[1:] + u[:-1]) / 2:
        state = forward @ state + drive * middle
        found.append(state[0])
    return np.array(found)


@settings(max_examples=25, deadline=None)
@given(hz=HZ, damping=DAMPING, interval=INTERVAL, seed=SEEDS)
def test_any_motion_integrated_in_fine_steps_leaves_no_excess(
    hz: float, damping: float, interval: float, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    u, state = rng.normal(size=6), rng.normal(size=2) * [1.0, 5.0]
    fine = np.interp(np.arange(5 * FINE + 1) / FINE, np.arange(6), u)
    pitch = integrate(hz, damping, interval / FINE, fine, state)[::FINE]
    excess = of(hz, damping, interval).excess(pitch, u, np.arange(1, 5))
    np.testing.assert_allclose(excess, 0.0, atol=1e-4)
    shares = of(hz, damping, interval).excess(pitch, u + 1.0, np.arange(1, 5))
    np.testing.assert_allclose(shares, sum(of(hz, damping, interval).driven), atol=1e-4)


@given(hz=HZ, damping=DAMPING, interval=INTERVAL)
def test_the_static_gain_is_1(hz: float, damping: float, interval: float) -> None:
    swing = of(hz, damping, interval)
    assert abs(sum(swing.driven) - sum(swing.free)) < 1e-13


@given(hz=HZ, damping=DAMPING, interval=INTERVAL, rise=st.floats(-1, 1))
def test_a_line_is_followed_by_the_lag(
    hz: float, damping: float, interval: float, rise: float
) -> None:
    swing = of(hz, damping, interval)
    u = rise * interval * np.arange(5.0)
    excess = swing.excess(u - rise * swing.lag_s, u, np.arange(1, 4))
    np.testing.assert_allclose(excess, 0.0, atol=1e-13)


@given(hz=HZ, damping=DAMPING, interval=INTERVAL)
def test_coefficients_are_those_of_the_reference(
    hz: float, damping: float, interval: float
) -> None:
    found, by = (
        of(hz, damping, interval),
        literal_swing(np.asarray(hz), np.asarray(damping), interval),
    )
    ours = np.array([*found.free, *found.driven])
    expected = np.array([by.determinant, -by.trace, 1.0, by.before, by.now, by.after])
    np.testing.assert_allclose(ours, expected, atol=1e-13)
    assert abs(found.lag_s / (2 * damping / (2 * np.pi * hz)) - 1) < 1e-12


def test_only_the_nodes_about_a_middle_count() -> None:
    rng = np.random.default_rng(1)
    pitch, u = rng.normal(size=(2, 9))
    swing, far = of(1.6, 0.3, 0.05), np.arange(9) > 5
    (before,) = swing.excess(pitch, u, np.array([4]))
    (after,) = swing.excess(pitch + far, u - far, np.array([4]))
    assert before == after
    (other,) = swing.excess(pitch + far, u - far, np.array([5]))
    assert other != swing.excess(pitch, u, np.array([5]))[0]
