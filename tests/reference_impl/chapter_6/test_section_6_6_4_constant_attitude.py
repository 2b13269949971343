"""A constant attitude takes nothing from GPS attitude, and removes slow tilt as a high-pass."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_4_4_tuning import densities, per_step
from floatref_reference.chapter_6.section_6_5_implementation import kalman_filter, rts_smoother
from floatref_reference.chapter_6.section_6_6_4_constant_attitude import constant_attitude

X = np.zeros(7)
STEPS = np.arange(0, 100, 5)
G = 9.80665


@pytest.mark.cites("(6.62)", "(6.63)", "(6.64)")
@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 999))
def test_what_is_observed_when(seed: int) -> None:
    rng = np.random.default_rng(seed)
    y, h, v = rng.normal(size=(20, 4)), rng.uniform(0.2, 0.4, 100), np.full(100, 5.0)
    v[50:70] = 0.1 / 3.6
    observe = constant_attitude(STEPS, y, h, np.arange(100) % 3 == 0, v)
    for k in range(100):
        found = observe(k, X)
        at_rest = 50 <= k < 70
        assert (found is None) == (k % (3 if at_rest else 5) > 0)
        if found is None:
            continue
        expected = [y[9, 0] + h[k] - h[48], y[9, 1]] if at_rest else y[k // 5, :2]
        sigma = [0.07, 0.3, 50, 2] if at_rest else [0.012, 0.03, 5, 2]
        assert found[0] == pytest.approx(np.array([*expected, 0, 0]))
        deviations = np.sqrt(found[1])
        assert [*deviations[:2], *np.degrees(deviations[2:])] == pytest.approx(sigma)


@pytest.mark.cites("(6.62)")
def test_attitude_of_gps_does_not_count() -> None:
    rng = np.random.default_rng(1)
    y, h, v = rng.normal(size=(20, 4)), np.full(100, 0.3), np.full(100, 5.0)
    blind = y.copy()
    blind[:, 2:] = np.nan
    seen, unseen = (constant_attitude(STEPS, r, h, np.ones(100, bool), v) for r in (y, blind))
    for k in STEPS:
        assert (seen(int(k), X)[0] == unseen(int(k), X)[0]).all()


@pytest.mark.cites("(6.62)", "(6.63)")
def test_gyroscope_bias_ends_as_a_bounded_tilt() -> None:
    """A pitch rate of 0.2 deg/s that is not there would tilt the vehicle by 6 degrees in 30 s."""
    N, dt = 300, 0.1
    u = np.tile([0, 0, G, 0, np.radians(0.2), 0], (N, 1))
    flat, v, P_0 = (
        np.zeros((N, 4)),
        np.full(N, 5.0),
        np.diag([0.1, 0.1, 0.1, 0.1, 0.01, 0.01, 0.01]),
    )
    observe = constant_attitude(np.arange(N), flat, flat[:, 0], np.zeros(N, bool), v)
    sigma = per_step(densities(), dt)
    run = kalman_filter(u, dt, np.zeros(7), P_0**2, sigma, observe, np.zeros(3))
    states, _ = rts_smoother(run)
    assert np.degrees(np.abs(states[:, 2])).max() < 0.6
    assert np.degrees(states[:, 6]) == pytest.approx(np.full(N, -0.2), abs=0.1)
