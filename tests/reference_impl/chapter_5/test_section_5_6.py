"""Local suppression: speed from the encoder, the controller, the switch."""

import cmath
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a.cut_off import high_pass_cut_off
from floatref_reference.chapter_5 import section_5_6
from floatref_reference.chapter_5.section_5_3 import trapezoidal_rule
from floatref_reference.chapter_5.section_5_5 import temporal_high_pass
from floatref_reference.chapter_5.section_5_6 import (
    controlled_velocity,
    frequency_response,
    local_suppression,
    travel_speed,
)

K_P, K_I = 0.001, 0.834
SWITCHES = st.lists(st.tuples(st.booleans(), st.integers(1, 12)), min_size=1, max_size=8)


def fitted(x: np.ndarray, t: np.ndarray, frequency: float) -> complex:
    """Fit cosine and sine: complex amplitude."""
    phase = 2 * np.pi * frequency * t
    fit, *_ = np.linalg.lstsq(
        np.stack([np.cos(phase), -np.sin(phase)], axis=1), np.asarray(x, float), rcond=None
    )
    return complex(*fit)


@settings(deadline=None, max_examples=20)
@given(
    speed=st.floats(0.0, 40.0),
    f_s=st.sampled_from([100.0, 400.0, 1000.0]),
    start=st.floats(-9.0, 9.0),
)
def test_speed_is_the_progress_over_the_preceding_0_05_s(
    speed: float, f_s: float, start: float
) -> None:
    t = np.arange(120) / f_s
    v_xp = travel_speed(start + speed * t, f_s)
    assert v_xp == pytest.approx(speed * np.minimum(t / 0.05, 1), abs=1e-10)


def test_stop_is_seen_after_0_05_s() -> None:
    v_xp = travel_speed(np.minimum(np.arange(400) * 0.01, 2.0), 1000.0)
    assert v_xp[200] == pytest.approx(10)
    assert v_xp[225] == pytest.approx(5)
    assert (v_xp[250:] == 0).all()


def test_at_low_sampling_rates_one_step_is_the_window() -> None:
    assert list(travel_speed([0.0, 1.0, 3.0], 5.0)) == [0, 5, 10]


@pytest.mark.cites("(5.1)")
def test_settings_in_print_make_a_time_constant_of_1_2_s() -> None:
    assert section_5_6.time_constant() == pytest.approx(1.2, abs=0.001)


@pytest.mark.cites("(5.2)")
@pytest.mark.parametrize(("frequency", "gain", "degrees"), [(2.0, 0.996, 3.8), (14.0, 0.999, 0.54)])
def test_controller_has_the_gain_in_print_and_twice_its_phase(
    frequency: float, gain: float, degrees: float
) -> None:
    t = np.arange(16_000) / 1000
    d = np.cos(2 * np.pi * frequency * t)
    v = controlled_velocity(d, np.zeros(len(t)), 0.001)
    measured = fitted(v[-2000:], t[-2000:], frequency)
    assert measured == pytest.approx(frequency_response(2 * np.pi * frequency), abs=1e-4)
    assert abs(measured) == pytest.approx(gain, abs=1e-3)
    assert math.degrees(cmath.phase(measured)) == pytest.approx(degrees, abs=0.05)


@settings(deadline=None, max_examples=10)
@given(offset=st.floats(-3.0, 3.0))
def test_offset_decays_with_the_time_constant(offset: float) -> None:
    t = np.arange(3000) / 1000
    v = controlled_velocity(np.full(3000, offset), np.zeros(3000), 0.001)
    assert v == pytest.approx(offset / (1 + K_P) * np.exp(-t * K_I / (1 + K_P)), abs=1e-6)


@settings(deadline=None, max_examples=40)
@given(switches=SWITCHES, seed=st.integers(0, 99))
def test_control_acts_below_the_limit_and_leaves_no_step(
    switches: list[tuple[bool, int]], seed: int
) -> None:
    low = np.concatenate([[active] * length for active, length in switches])
    d = np.random.default_rng(seed).normal(size=len(low))
    v = controlled_velocity(d, np.where(low, 4.4, 4.5), 0.01)
    first, o = 0, np.longdouble(0)
    for k in range(len(low)):
        if low[k]:
            first = first if k > 0 and low[k - 1] else k
            integral = trapezoidal_rule(v[first : k + 1], 0.01)[-1]
            assert v[k] == pytest.approx(d[k] + o - K_P * v[k] - K_I * integral, abs=1e-14)
        else:
            step = v[k] - v[k - 1] if k > 0 else v[k]
            assert step == pytest.approx(d[k] - d[k - 1] if k > 0 else d[k], abs=1e-14)
            o = v[k] - d[k]


def test_at_the_limit_control_rests() -> None:
    d = np.linspace(0, 3, 50)
    assert (controlled_velocity(d, np.full(50, 4.4704), 0.01) == d).all()


def test_at_speed_the_pipeline_is_temporal_high_pass_filtering() -> None:
    rng = np.random.default_rng(4)
    a, h, x = rng.normal(size=300), 0.01 * rng.normal(size=300), np.arange(300) * 0.25
    _, expected = temporal_high_pass(a, h, x, 20.0, 0.25)
    _, profile = local_suppression(a, h, x, 20.0, 0.25)
    assert profile == pytest.approx(expected, abs=1e-15)


def test_when_crawling_the_reference_height_has_the_response_of_the_controller() -> None:
    frequency, f_s = 0.2, 20.0
    t = np.arange(4000) / f_s
    a = -((2 * np.pi * frequency) ** 2) * np.cos(2 * np.pi * frequency * t)
    _, profile = local_suppression(a, np.full(4000, 0.3), 1.25 * t, f_s, 0.0625)
    high_pass = 1 / (1 + (float(high_pass_cut_off(0.0489)) / frequency) ** 6)
    expected = high_pass * frequency_response(2 * np.pi * frequency)
    assert fitted(profile[1500:2500], t[1500:2500], frequency) == pytest.approx(expected, abs=1e-3)
