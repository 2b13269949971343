"""Temporal high-pass filtering: collective gain, cancellation, datum, bias."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a.cut_off import high_pass_cut_off
from floatref_reference.chapter_5 import section_5_5
from floatref_reference.chapter_5.section_5_5 import temporal_high_pass

F_S = 20.0
N = 6000
T = np.arange(N) / F_S
X = np.arange(N) * 0.25
MIDDLE = slice(2000, 4000)


def response(profile: np.ndarray, frequency: float) -> complex:
    """Fit the middle of a profile with a cosine and a sine: gain and phase lead."""
    phase = 2 * np.pi * frequency * T
    basis = np.stack([np.cos(phase), -np.sin(phase)], axis=1)
    fit, *_ = np.linalg.lstsq(basis[MIDDLE], np.asarray(profile, float)[MIDDLE], rcond=None)
    return complex(*fit)


@pytest.mark.parametrize("sensed_by", ["accelerometer", "height sensor"])
def test_forward_and_backward_passes_lose_3_db_at_0_0489_hz(sensed_by: str) -> None:
    z = np.cos(2 * np.pi * 0.0489 * T)
    a, h = np.zeros(N), 0.3 - z
    if sensed_by == "accelerometer":
        a, h = -((2 * np.pi * 0.0489) ** 2) * z, np.full(N, 0.3)
    _, profile = temporal_high_pass(a, h, X, F_S, 0.25)
    assert response(profile, 0.0489) == pytest.approx(math.sqrt(0.5), abs=2e-4)


@pytest.mark.parametrize("frequency", [0.03, 0.08, 0.5])
def test_phase_cancels_and_the_gain_is_that_of_two_third_order_passes(frequency: float) -> None:
    _, profile = temporal_high_pass(np.zeros(N), -np.cos(2 * np.pi * frequency * T), X, F_S, 0.25)
    ratio = float(high_pass_cut_off(0.0489)) / frequency
    assert response(profile, frequency) == pytest.approx(1 / (1 + ratio**6), abs=2e-4)


def test_vehicle_bouncing_from_rest_on_a_flat_road_measures_a_flat_road() -> None:
    f_s, omega = 1000.0, 4 * np.pi
    t = np.arange(8000) / f_s
    lift = 0.02 * ((1 - np.cos(omega * t)) - (1 - np.cos(2 * omega * t)) / 4)
    a = 0.02 * omega**2 * (np.cos(omega * t) - np.cos(2 * omega * t))
    _, profile = temporal_high_pass(a, 0.3 + lift, 10 * t, f_s, 0.25)
    assert profile == pytest.approx(np.zeros(len(profile)), abs=5e-6)
    _, unseen = temporal_high_pass(np.zeros(len(t)), 0.3 + lift, 10 * t, f_s, 0.25)
    assert np.ptp(unseen) > 0.03


@settings(deadline=None, max_examples=10)
@given(datum=st.floats(-5.0, 5.0), seed=st.integers(0, 99))
def test_datum_of_the_height_changes_nothing(datum: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, h = rng.normal(size=200), 0.01 * rng.normal(size=200)
    _, expected = temporal_high_pass(a, h, X[:200], F_S, 0.25)
    _, profile = temporal_high_pass(a, h + datum, X[:200], F_S, 0.25)
    assert profile == pytest.approx(expected, abs=1e-13)


@settings(deadline=None, max_examples=5)
@given(bias=st.floats(0.01, 2.0))
def test_constant_bias_lifts_the_reference_for_a_while_and_then_no_more(bias: float) -> None:
    v_zp = section_5_5.integrated_acceleration(np.full(N, bias), 0.0422, 1 / F_S)
    r_zp = section_5_5.floating_reference_height(v_zp, 0.0422, 1 / F_S)
    # Laplace transform bias / ((s + ω) (s² + ω s + ω²)), whose integral is bias/ω³.
    assert sum(r_zp) / F_S == pytest.approx(bias / (2 * np.pi * 0.0422) ** 3, rel=0.02)
    assert abs(r_zp[-1]) < 1e-12 * max(r_zp)


def test_backward_passes_run_from_the_end() -> None:
    step = np.where(np.arange(N) < N // 2, 1.0, 0.0)
    y = section_5_5.backward_passes(step, 0.0422, 1 / F_S)
    assert (y[N // 2 :] == 0).all()
    assert y[N // 2 - 1] == pytest.approx(1, abs=0.03)
