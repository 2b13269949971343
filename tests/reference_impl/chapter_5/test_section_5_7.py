"""Adaptive high-pass filtering: the schedule, and what is left at a constant cut-off."""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a.cut_off import THIRD_ORDER_RATIO
from floatref_reference.chapter_5.section_5_5 import temporal_high_pass
from floatref_reference.chapter_5.section_5_7 import (
    Schedule,
    adaptive_high_pass,
    adaptive_high_pass_spatial_backward,
    cut_off_frequency,
    cut_off_wave_number,
)

MPH_10 = 4.470
Pipeline = Callable[..., tuple[float, npt.NDArray[np.longdouble]]]
PIPELINES: list[Pipeline] = [adaptive_high_pass, adaptive_high_pass_spatial_backward]


@pytest.mark.cites("(5.3)")
def test_cut_off_at_16_km_h_is_the_one_in_print() -> None:
    f_c = cut_off_frequency([MPH_10])[0]
    assert round(float(f_c), 4) == 0.0481
    assert 1 / cut_off_wave_number([MPH_10], 0.00508)[0] == pytest.approx(93.04, abs=0.03)


@pytest.mark.cites("(5.3)")
@settings(deadline=None, max_examples=50)
@given(
    v=st.floats(0.0, 60.0),
    f_ls=st.floats(0.01, 2.0),
    lambda_c=st.floats(10.0, 300.0),
    v_0=st.floats(0.0, 10.0),
    alpha=st.floats(0.1, 8.0),
)
def test_cut_off_is_the_printed_quotient(
    v: float, f_ls: float, lambda_c: float, v_0: float, alpha: float
) -> None:
    e = math.exp(alpha * (v - v_0))
    printed = (f_ls + v / lambda_c * e) / (1 + e)
    f_c = cut_off_frequency([v], Schedule(f_ls, lambda_c, v_0, alpha))[0]
    assert f_c == pytest.approx(printed, rel=1e-12)


def test_standing_vehicle_has_the_frequency_and_any_fast_one_the_wavelength() -> None:
    f_c = cut_off_frequency([0.0, 30.0, 1e6])
    assert f_c[0] == pytest.approx(0.45, rel=1e-3)
    assert f_c[1:] == pytest.approx(np.array([30.0, 1e6]) / 105.91, rel=1e-12)


@settings(deadline=None, max_examples=30)
@given(v=st.floats(0.0, 40.0), dx=st.floats(0.001, 1.0))
def test_wavelength_is_the_distance_of_one_cycle_but_at_least_four_points(
    v: float, dx: float
) -> None:
    wave_number = cut_off_wave_number([v], dx)[0]
    f_c = cut_off_frequency([v])[0]
    assert wave_number <= 1 / (4 * dx) * (1 + 1e-15)
    if v >= 4 * dx * f_c * (1 + 1e-12):
        assert wave_number * v == pytest.approx(f_c, rel=1e-12)
    else:
        assert wave_number * 4 * dx == pytest.approx(1, rel=1e-9)


@pytest.mark.parametrize("pipeline", PIPELINES)
def test_at_16_km_h_profiles_have_the_printed_gains(pipeline: Pipeline) -> None:
    f_s = 10.0
    x = np.arange(3600) * MPH_10 / f_s
    waves = np.stack([np.cos(2 * np.pi * x / wavelength) for wavelength in (42.9, 65.6)])
    quadrature = np.stack([np.sin(2 * np.pi * x / wavelength) for wavelength in (42.9, 65.6)])
    _, profile = pipeline(np.zeros(len(x)), 0.3 - waves.sum(axis=0), x, f_s, MPH_10 / f_s)
    middle = slice(1500, 2100)
    basis = np.concatenate([waves, quadrature])[:, middle].T
    fit, *_ = np.linalg.lstsq(basis, np.asarray(profile, float)[middle], rcond=None)
    assert fit == pytest.approx([0.991, 0.891, 0, 0], abs=1.5e-3)


@settings(deadline=None, max_examples=10)
@given(f_c=st.floats(0.02, 2.0), seed=st.integers(0, 99))
def test_at_a_constant_cut_off_the_filter_does_not_adapt(f_c: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, h = rng.normal(size=300), 0.3 + 0.01 * rng.normal(size=300)
    x = np.cumsum(rng.uniform(0, 1, 300))
    _, expected = temporal_high_pass(a, h, x, 20.0, 0.5, f_c / float(THIRD_ORDER_RATIO))
    _, profile = adaptive_high_pass(a, h, x, 20.0, 0.5, Schedule(f_ls=f_c, v_0=1e6))
    assert profile == pytest.approx(expected, abs=1e-13)


@settings(deadline=None, max_examples=10)
@given(speed=st.floats(1.0, 30.0), seed=st.integers(0, 99))
def test_at_constant_speed_backward_passes_agree_in_time_and_distance(
    speed: float, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    a, h = rng.normal(size=200), 0.3 + 0.01 * rng.normal(size=200)
    x = np.arange(200) * (speed / 20)
    _, in_time = adaptive_high_pass(a, h, x, 20.0, speed / 20)
    _, in_distance = adaptive_high_pass_spatial_backward(a, h, x, 20.0, speed / 20)
    # The vehicle is taken to stand before the first sample.
    assert in_distance[1:] == pytest.approx(in_time[1:], abs=1e-12)


def test_each_point_is_filtered_at_the_speed_it_was_passed_with() -> None:
    f_s, slow, fast = 20.0, 2.0, 16.0
    x = np.concatenate([np.arange(400) * slow, 400 * slow + np.arange(400) * fast]) / f_s
    h = np.where(np.arange(800) == 200, 0.31, 0.3)
    _, profile = adaptive_high_pass_spatial_backward(np.zeros(800), h, x, f_s, slow / f_s)
    alone = slice(1, 390)
    _, expected = adaptive_high_pass_spatial_backward(
        np.zeros(400), h[:400], x[:400], f_s, slow / f_s
    )
    assert profile[alone] == pytest.approx(expected[alone], abs=1e-7)
