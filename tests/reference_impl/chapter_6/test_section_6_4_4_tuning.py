"""Densities give the same covariance at any time step; Table 6.1 is theirs at 16 kHz."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_4_2_gyroscopes import N_A
from floatref_reference.chapter_6.section_6_4_4_tuning import (
    DEGREE,
    DT,
    SIGMA_GPS,
    SIGMA_PROCESS,
    densities,
    per_step,
    per_step_walk,
    per_step_white,
)
from floatref_reference.chapter_6.section_6_5_implementation import kalman_filter

G = 9.80665


def final_covariance(sigma: np.ndarray, rate: int, duration: float) -> np.ndarray:
    steps = round(rate * duration) + 1
    u = np.tile([0, 0, G, 0, 0, 0], (steps, 1))
    run = kalman_filter(
        u, 1 / rate, np.zeros(7), np.zeros((7, 7)), sigma, lambda k, x: None, np.zeros(3)
    )
    return run.P[-1]


@settings(deadline=None, max_examples=10)
@given(
    S=st.floats(1e-6, 1), rate=st.sampled_from([20, 50, 100]), duration=st.sampled_from([0.5, 1.0])
)
def test_white_noise_grows_with_time_whatever_the_rate(
    S: float, rate: int, duration: float
) -> None:
    sigma = np.array([*[per_step_white(S, 1 / rate)] * 3, 0, 0, 0, 0])
    P = final_covariance(sigma, rate, duration)
    assert np.diag(P)[1:4] == pytest.approx(np.full(3, S**2 * duration))


@settings(deadline=None, max_examples=10)
@given(
    K=st.floats(1e-6, 1), rate=st.sampled_from([20, 50, 100]), duration=st.sampled_from([0.5, 1.0])
)
def test_drift_grows_with_time_whatever_the_rate(K: float, rate: int, duration: float) -> None:
    sigma = np.array([0, 0, 0, 0, *[per_step_walk(K, 1 / rate)] * 3])
    P = final_covariance(sigma, rate, duration)
    assert np.diag(P)[4:] == pytest.approx(np.full(3, K**2 * duration))


@settings(deadline=None, max_examples=10)
@given(dt=st.floats(1e-5, 1))
def test_densities_and_steps_are_inverse(dt: float) -> None:
    assert per_step(densities(SIGMA_PROCESS, dt), dt) == pytest.approx(np.array(SIGMA_PROCESS))


def test_values_in_the_units_of_print() -> None:
    assert SIGMA_GPS[:2] == (0.012, 0.03)
    assert np.degrees(SIGMA_GPS[2:]) == pytest.approx(np.array([0.12, 0.2]))
    assert SIGMA_PROCESS[0] / G == pytest.approx(6e-4)
    assert np.degrees(SIGMA_PROCESS[1:4]) == pytest.approx(np.array([7.7e-3, 7.7e-3, 0]))
    assert SIGMA_PROCESS[4] == 5e-8
    assert np.degrees(SIGMA_PROCESS[5:]) == pytest.approx(np.array([4.2e-6, 2.2e-4]))
    assert 1 / DT == 16_000


def test_rate_noise_is_that_of_100_hz_readings() -> None:
    """Taken at 100 Hz, 7.7e-3 deg/s are the angle random walk of (6.54); at 16 kHz √160 less."""
    sigma = SIGMA_PROCESS[1]
    assert sigma * math.sqrt(0.01) == pytest.approx(N_A * DEGREE, rel=0.02)
    assert densities()[1] * math.sqrt(160) == pytest.approx(N_A * DEGREE, rel=0.02)
