"""Spatial high-pass filtering: at constant speed the temporal algorithm, at any the same datum."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a.cut_off import THIRD_ORDER_RATIO
from floatref_reference.chapter_5.section_5_5 import temporal_high_pass
from floatref_reference.chapter_5.section_5_9 import spatial_high_pass

F_S = 100.0


@settings(deadline=None, max_examples=10)
@given(speed=st.floats(0.5, 40.0), lambda_c=st.floats(2.0, 200.0), seed=st.integers(0, 99))
def test_at_constant_speed_distance_is_time(speed: float, lambda_c: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, h = rng.normal(size=200), 0.3 + 0.01 * rng.normal(size=200)
    dx = speed / F_S
    x = 12.0 + np.arange(200) * dx
    f_3db = speed / lambda_c / float(THIRD_ORDER_RATIO)
    _, expected = temporal_high_pass(a, h, x, F_S, dx, f_3db)
    x_1, profile = spatial_high_pass(a, h, x, F_S, dx, lambda_c)
    assert x_1 == 12.0
    assert profile == pytest.approx(expected, abs=1e-12)


def test_wave_of_91_44_m_loses_3_db() -> None:
    x = np.arange(5000) * 0.25
    z = np.cos(2 * np.pi * (x - x[2500]) / 91.44)
    _, profile = spatial_high_pass(np.zeros(5000), 0.3 - z, x, F_S, 0.25)
    assert profile[2500] == pytest.approx(math.sqrt(0.5), abs=2e-4)


@settings(deadline=None, max_examples=10)
@given(datum=st.floats(-5.0, 5.0), seed=st.integers(0, 99))
def test_datum_of_the_height_changes_nothing(datum: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, h = rng.normal(size=200), 0.01 * rng.normal(size=200)
    x = np.cumsum(rng.uniform(0, 1, 200))
    _, expected = spatial_high_pass(a, h, x, F_S, 0.5)
    _, profile = spatial_high_pass(a, h + datum, x, F_S, 0.5)
    assert profile == pytest.approx(expected, abs=1e-13)


@pytest.mark.parametrize("stop", [1.0, 10.0])
def test_between_the_points_around_a_stop_the_reference_moves_by_their_mean(stop: float) -> None:
    before = np.arange(100) * 0.25
    x = np.concatenate([before, np.full(int(stop * F_S), before[-1]), before[-1] + before[1:]])
    a = np.where(np.arange(len(x)) == 99 + int(stop * F_S) + 1, 0.1, 0.0)
    flat = np.full(len(x), 0.3)
    _, profile = spatial_high_pass(a, flat, x, F_S, 0.25, 1e9)
    dt = stop + 1 / F_S
    assert profile[99] == pytest.approx(0, abs=1e-6)
    assert profile[100] == pytest.approx(0.1 / 2 * dt**2 / 2, rel=1e-4)
