"""Mean removal takes out what is constant, and nothing else."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_5 import section_5_3
from floatref_reference.chapter_5.section_5_4 import mean_removal

F_S = 1000.0
N = 600
X = np.arange(N) * 0.03


def signals(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.normal(size=N), 0.3 + 0.01 * rng.normal(size=N)


@settings(deadline=None, max_examples=10)
@given(bias=st.floats(-5.0, 5.0), seed=st.integers(0, 99))
def test_accelerometer_bias_changes_nothing(bias: float, seed: int) -> None:
    a, h = signals(seed)
    _, expected = mean_removal(a, h, X, F_S, 0.05)
    x_1, r_zr = mean_removal(a + bias, h, X, F_S, 0.05)
    assert x_1 == 0.0
    assert r_zr == pytest.approx(expected, abs=1e-12)


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 99))
def test_floating_reference_height_ends_where_it_began(seed: int) -> None:
    a, _ = signals(seed)
    r_zp = section_5_3.temporal_profile(a, np.zeros(N), F_S, mean_removal=True)
    v_zp = np.diff(r_zp) * F_S
    half_sample = 0.5 * (abs(v_zp[0]) + abs(v_zp[-1]) + np.abs(a).max() / F_S) / F_S
    assert abs(r_zp[-1] - r_zp[0]) <= half_sample * 1.01


def test_signals_without_a_mean_pass_as_in_the_basic_algorithm() -> None:
    t = np.arange(N) / F_S
    a = np.cos(2 * np.pi * 5 * t)
    h = np.full(N, 0.3)
    _, removed = mean_removal(a, h, X, F_S, 0.05)
    _, basic = section_5_3.basic_temporal(a, h, X, F_S, 0.05)
    assert removed == pytest.approx(basic, abs=1e-9)
