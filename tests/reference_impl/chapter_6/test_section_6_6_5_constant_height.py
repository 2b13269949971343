"""Zeros at every step make a high-pass filter of the smoother; a stop hangs on its own height."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_3_6_system import h as measurement
from floatref_reference.chapter_6.section_6_4_4_tuning import densities, per_step
from floatref_reference.chapter_6.section_6_5_implementation import kalman_filter, rts_smoother
from floatref_reference.chapter_6.section_6_6_5_constant_height import ConstantHeightAndAttitude

G = 9.80665
LEVER = np.array([0.5, -0.6, 2.0])
DRIVING = [0.5, 1.0, 5, 2]
STOPPED = [0.07, 10.0, 50, 2]


def deviations(variances: np.ndarray) -> list[float]:
    sigma = np.sqrt(variances)
    return [*sigma[:2], *np.degrees(sigma[2:])]


def antenna(x: np.ndarray) -> float:
    return float(measurement(x, np.zeros(6), LEVER)[0])


@pytest.mark.cites("(6.58)", "(6.65)", "(6.66)")
@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 999), start=st.integers(20, 40))
def test_what_is_observed_when(seed: int, start: int) -> None:
    rng = np.random.default_rng(seed)
    h, v, states = rng.uniform(0.2, 0.4, 100), np.full(100, 5.0), 0.1 * rng.normal(size=(100, 7))
    v[start : start + 30] = 0.0
    fresh = np.arange(100) % 3 == 0
    observe = ConstantHeightAndAttitude(h, fresh, v, LEVER)
    h_ref = h[start - 1 - (start - 1) % 3]
    for repeat in range(2):
        for k, x in enumerate(states):
            found = observe(k, x)
            at_rest = start <= k < start + 30
            assert (found is None) == (at_rest and k % 3 > 0), repeat
            if found is not None:
                y_rz = antenna(states[start]) + h[k] - h_ref if at_rest else 0.0
                assert found[0] == pytest.approx(np.array([y_rz, 0, 0, 0]))
                assert deviations(found[1]) == pytest.approx(STOPPED if at_rest else DRIVING)


@pytest.mark.cites("(6.58)", "(6.65)")
def test_start_at_a_stop_counts_from_the_first_reading() -> None:
    h, states = 0.3 + 0.001 * np.arange(10.0), 0.01 * np.arange(70.0).reshape(10, 7)
    observe = ConstantHeightAndAttitude(h, np.arange(10) >= 4, np.zeros(10), LEVER)
    for run in (states, states[::-1]):
        found = [observe(k, x) for k, x in enumerate(run)]
        assert all(not y.any() and deviations(R) == pytest.approx(DRIVING) for y, R in found[:4])
        y_rz = [y[0] for y, _ in found[4:]]
        assert y_rz == pytest.approx(antenna(run[4]) + 0.001 * np.arange(6))


@pytest.mark.cites("(6.58)", "(6.65)")
def test_each_stop_counts_from_its_own_height() -> None:
    v, states = np.array([5.0, 0, 0, 5, 0, 0]), 0.01 * np.arange(42.0).reshape(6, 7)
    observe = ConstantHeightAndAttitude(np.full(6, 0.3), np.ones(6, bool), v, LEVER)
    y_rz = [observe(k, x)[0][0] for k, x in enumerate(states)]
    first, second = antenna(states[1]), antenna(states[4])
    assert y_rz == pytest.approx([0, first, first, 0, second, second])


@pytest.mark.cites("(6.65)", "(6.66)")
def test_bias_of_the_accelerometer_ends_as_a_bounded_height() -> None:
    """Integrated twice, 0.1 m/s² would be 45 m after 30 s."""
    N, dt = 300, 0.1
    u = np.tile([0, 0, G + 0.1, 0, 0, 0], (N, 1))
    observe = ConstantHeightAndAttitude(
        np.zeros(N), np.zeros(N, bool), np.full(N, 5.0), np.zeros(3)
    )
    P_0 = np.diag([0.1, 0.1, 0.01, 0.01, 0.1, 0.01, 0.01]) ** 2
    run = kalman_filter(u, dt, np.zeros(7), P_0, per_step(densities(), dt), observe, np.zeros(3))
    states, _ = rts_smoother(run)
    assert np.abs(states[:, 0]).max() < 0.2
    assert states[:, 4] == pytest.approx(np.full(N, -0.1), abs=0.02)
