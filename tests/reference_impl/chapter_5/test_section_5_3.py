"""The basic temporal algorithm: integration, decimation, cancellation, filter gain."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_5 import section_5_3

G = 9.80665
STEPS = st.lists(st.integers(0, 40), min_size=1, max_size=40)


@settings(deadline=None, max_examples=30)
@given(bias=st.floats(-1.0, 1.0), start=st.floats(-5.0, 5.0), dt=st.floats(1e-4, 0.1))
def test_trapezoidal_rule_is_exact_for_a_straight_line(
    bias: float, start: float, dt: float
) -> None:
    t = np.arange(30) * dt
    integral = section_5_3.trapezoidal_rule(start + bias * t, dt, 2.0)
    assert integral == pytest.approx(2.0 + start * t + bias * t**2 / 2, abs=1e-13)


def test_bias_of_the_10_7_second_stop_raises_the_profiler_by_0_644_m() -> None:
    dt = 1 / 1000
    a = np.full(10_701, 0.00115 * G)
    r = section_5_3.trapezoidal_rule(section_5_3.trapezoidal_rule(a, dt), dt)
    assert r[-1] == pytest.approx(0.644, rel=0.005)


def test_anti_alias_filter_is_left_out_at_4_khz_and_below() -> None:
    x = np.random.default_rng(1).normal(size=50)
    assert (section_5_3.anti_alias(x, 4000.0) == x).all()
    assert not np.allclose(np.asarray(section_5_3.anti_alias(x, 16_000.0), float), x)


def test_anti_alias_filter_keeps_what_matters() -> None:
    t = np.arange(3200) / 16_000
    y = section_5_3.anti_alias(np.sin(2 * np.pi * 20 * t), 16_000.0)
    assert y[-800:].max() == pytest.approx(1, abs=1e-4)


@settings(deadline=None, max_examples=60)
@given(steps=STEPS, dx=st.sampled_from([0.5, 0.25, 2.0]), first=st.integers(-8, 8))
def test_each_point_takes_the_first_sample_that_reaches_it(
    steps: list[int], dx: float, first: int
) -> None:
    d = first + np.concatenate([[0], np.cumsum(steps)]) / 16
    points = section_5_3.trigger(d, dx)
    reached = section_5_3.capture(d, points)
    assert len(points) == math.floor((d[-1] - d[0]) / dx) + 1
    for k, (i, fraction) in enumerate(points):
        x_k = d[0] + k * dx
        assert d[i] >= x_k
        assert i == 0 or d[i - 1] < x_k
        coarse = i > 0 and d[i] - d[i - 1] > dx
        assert reached[k] == (pytest.approx(x_k, abs=1e-15) if coarse else d[i])
        assert 0 < fraction <= 1


@pytest.mark.parametrize("first", [0.0, 100.3, -7.7])
def test_encoder_counts_on_the_points_are_taken_though_they_round_differently(
    first: float,
) -> None:
    d = first + np.arange(5001) * 0.04
    points = section_5_3.trigger(d, 0.2)
    assert points == [(5 * k, 1) for k in range(1001)]


def test_a_stop_yields_no_points() -> None:
    d = np.concatenate([np.arange(10), np.full(50, 9.0), np.arange(10, 20)])
    points = section_5_3.trigger(d, 1.0)
    assert [i for i, _ in points] == [*range(10), *range(60, 70)]


@pytest.mark.parametrize(("d", "dx"), [([0.0, 1.0, 0.5], 0.1), ([0.0, 1.0], 0.0)])
def test_travel_that_makes_no_profile_is_refused(d: list[float], dx: float) -> None:
    with pytest.raises(ValueError, match="distance"):
        section_5_3.trigger(d, dx)


@settings(deadline=None, max_examples=20)
@given(bias=st.floats(-1.0, 1.0), height=st.floats(0.1, 0.5), f_s=st.floats(100.0, 4000.0))
def test_accelerometer_bias_becomes_a_parabola(bias: float, height: float, f_s: float) -> None:
    t = np.arange(60) / f_s
    r_zr = section_5_3.temporal_profile(np.full(60, bias), np.full(60, height), f_s)
    assert r_zr == pytest.approx(bias * t**2 / 2, abs=1e-15)


@settings(deadline=None, max_examples=15)
@given(a=st.floats(-2.0, 2.0), height=st.floats(0.1, 0.5), speed=st.floats(0.5, 30.0))
def test_motion_that_both_sensors_see_cancels(a: float, height: float, speed: float) -> None:
    t = np.arange(400) / 1000
    h = height + a * t**2 / 2
    assume(np.ptp(speed * t) > 0.1)
    x_1, r_zr = section_5_3.basic_temporal(np.full(400, a), h, 7.0 + speed * t, 1000.0, 0.02)
    assert x_1 == 7.0
    assert len(r_zr) == math.floor(np.ptp(7.0 + speed * t) / 0.02) + 1
    assert r_zr == pytest.approx(np.zeros(len(r_zr)), abs=1e-14)


@pytest.mark.parametrize(("wavelength", "gain"), [(20.0, 1.0), (42.9, 0.996), (65.6, 0.947)])
def test_sinusoidal_road_comes_out_with_the_printed_gain(wavelength: float, gain: float) -> None:
    x = np.arange(36_000) / 32
    h = 0.3 - 0.01 * np.cos(2 * np.pi * x / wavelength)
    _, r_zr = section_5_3.basic_temporal(np.zeros(len(x)), h, x, 500.0, 0.25)
    middle = slice(len(r_zr) // 2 - 500, len(r_zr) // 2 + 500)
    position = np.arange(len(r_zr))[middle] * 0.25
    expected = 0.01 * gain * np.cos(2 * np.pi * position / wavelength)
    assert r_zr[middle] == pytest.approx(expected, abs=1e-5)
