"""The basic spatial algorithm: time steps, integration, agreement with the temporal one."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_5.section_5_3 import basic_temporal
from floatref_reference.chapter_5.section_5_8 import basic_spatial, position, time_step, velocity

G = 9.80665


@pytest.mark.cites("(5.4) to (5.6)")
def test_stop_of_10_7_seconds_gives_the_printed_steps() -> None:
    dt = time_step([0.0, 10.7643])
    v_zp = velocity([-0.01865 * G, 0.00910 * G], dt, -0.00319)
    assert v_zp[1] == pytest.approx(-0.50744, abs=5e-4)
    assert position(v_zp, dt)[1] == pytest.approx(-2.748, abs=2e-3)


@pytest.mark.cites("(5.5)", "(5.6)")
@settings(deadline=None, max_examples=20)
@given(
    a=st.floats(-2.0, 2.0),
    v_1=st.floats(-1.0, 1.0),
    steps=st.lists(st.floats(1e-4, 3.0), min_size=1, max_size=30),
)
def test_constant_acceleration_makes_a_parabola_whatever_the_time_steps(
    a: float, v_1: float, steps: list[float]
) -> None:
    t = np.concatenate([[0.0], np.cumsum(steps)])
    dt = time_step(t)
    v_zp = velocity(np.full(len(t), a), dt, v_1)
    r_zp = position(v_zp, dt, 0.3)
    assert v_zp == pytest.approx(v_1 + a * t, abs=1e-12)
    assert r_zp == pytest.approx(0.3 + v_1 * t + a * t**2 / 2, rel=1e-12, abs=1e-12)


@settings(deadline=None, max_examples=15)
@given(a=st.floats(-2.0, 2.0), speed=st.floats(2.0, 10.0), braking=st.floats(0.0, 8.0))
def test_motion_that_both_sensors_see_cancels_while_braking(
    a: float, speed: float, braking: float
) -> None:
    t = np.arange(200) / 1000
    x = 3.0 + speed * t - braking * t**2 / 2
    x_1, r_zr = basic_spatial(np.full(200, a), 0.3 + a * t**2 / 2, x, 1000.0, 0.02)
    assert x_1 == 3.0
    assert r_zr == pytest.approx(np.zeros(len(r_zr)), abs=1e-14)


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 99))
def test_one_sample_per_trigger_is_the_temporal_algorithm(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, h = rng.normal(size=300), 0.3 + 0.01 * rng.normal(size=300)
    x = np.arange(300) * 0.25
    _, temporal = basic_temporal(a, h, x, 1000.0, 0.25)
    _, spatial = basic_spatial(a, h, x, 1000.0, 0.25)
    assert spatial == pytest.approx(temporal, abs=1e-15)


@settings(deadline=None, max_examples=10)
@given(slope=st.floats(-0.1, 0.1), step=st.floats(0.11, 0.7))
def test_between_distant_samples_signals_are_linear_in_distance(slope: float, step: float) -> None:
    coarse = np.arange(40) * step
    _, r_zr = basic_spatial(np.zeros(40), 0.3 - slope * coarse, coarse, 1000.0, 0.1)
    fine = np.arange(len(r_zr)) * 0.1
    _, expected = basic_spatial(np.zeros(len(fine)), 0.3 - slope * fine, fine, 1000.0, 0.1)
    assert r_zr == pytest.approx(expected, abs=1e-12)
