"""The matched high-pass filter: an observer's equations, and motion that cancels."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a.filters import hpf_b3
from floatref_reference.appendix_a.varying import substitutions
from floatref_reference.beyond.matched_high_pass import matched_filter, matched_high_pass
from floatref_reference.chapter_5.section_5_3 import temporal_profile
from floatref_reference.chapter_5.section_5_7 import (
    Schedule,
    adaptive_high_pass,
    adaptive_high_pass_spatial_backward,
)

F_S = 4000.0
DX = 0.05


def stop_and_go() -> tuple[np.ndarray, np.ndarray]:
    """Brake from 20 m/s at 4 m/s², stand for a second, drive off: time and travel."""
    t = np.arange(int(13 * F_S)) / F_S
    braking, moving_off = np.clip(t - 1, 0, 5), np.clip(t - 7, 0, 5)
    travel = 20 * np.clip(t, 0, 1) + 20 * braking - 2 * braking**2
    return t, travel + 2 * moving_off**2 + 20 * np.clip(t - 12, 0, None)


def bounce(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Bounce by 50 mm at 2 Hz, from rest: acceleration and lift."""
    omega = 4 * np.pi
    lift = 0.025 * ((1 - np.cos(omega * t)) - (1 - np.cos(2 * omega * t)) / 4)
    return 0.025 * omega**2 * (np.cos(omega * t) - np.cos(2 * omega * t)), lift


@pytest.mark.cites("(A.1)")
@settings(deadline=None, max_examples=20)
@given(f_c=st.floats(0.001, 0.3), seed=st.integers(0, 99))
def test_constant_cut_off_is_the_third_order_filter_of_the_profile(f_c: float, seed: int) -> None:
    z = np.concatenate([[0], np.random.default_rng(seed).normal(size=200).cumsum()])
    expected = hpf_b3(z, f_c, 1.0)
    assert matched_filter(z, np.full(201, f_c), 1.0) == pytest.approx(expected, abs=1e-12)


@settings(deadline=None, max_examples=15)
@given(seed=st.integers(0, 999), dt=st.floats(1e-3, 0.1))
def test_the_observer_holds_at_every_sample(seed: int, dt: float) -> None:
    rng = np.random.default_rng(seed)
    a, h = rng.normal(size=60).astype(np.longdouble), rng.normal(size=60).astype(np.longdouble)
    f_c = rng.uniform(0.001, 0.3, 60) / dt
    e = matched_filter(temporal_profile(a, h, 1 / np.longdouble(dt)), f_c, dt)
    omega = 2 / np.longdouble(dt) * np.array(substitutions(f_c, dt))
    r, v, b = h[0], np.longdouble(0), np.longdouble(0)
    for k in range(1, 60):
        now, past = slice(k, k + 1), slice(k - 1, k)
        b_past, v_past = b, v
        b = b - dt / 2 * sum(omega[i] ** 3 * e[i] for i in (now, past))[0]
        v = v + dt / 2 * (a[k] + b + a[k - 1] + b_past)
        v = v - dt / 2 * sum(2 * omega[i] ** 2 * e[i] for i in (now, past))[0]
        r = r + dt / 2 * (v + v_past) - dt / 2 * sum(2 * omega[i] * e[i] for i in (now, past))[0]
        assert r - h[k] == pytest.approx(e[k], rel=1e-13, abs=1e-12)


@settings(deadline=None, max_examples=8)
@given(seed=st.integers(0, 99))
def test_whatever_both_sensors_see_cancels_under_any_cut_off(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, x = rng.normal(size=500), np.cumsum(rng.uniform(0, 0.02, 500))
    h = 0.3 + temporal_profile(a, np.zeros(500), 1000.0)
    _, profile = matched_high_pass(a, h, x, 1000.0, DX)
    assert profile == pytest.approx(np.zeros(len(profile)), abs=1e-15)


@pytest.mark.slow
def test_bounce_under_a_sweeping_cut_off_cancels_in_the_observer_and_not_in_the_cascade() -> None:
    t, x = stop_and_go()
    a, lift = bounce(t)
    x_1, profile = matched_high_pass(a, 0.3 + lift, x, F_S, DX)
    assert x_1 == 0
    assert len(profile) == 2800
    assert np.abs(profile).max() <= 1e-6
    for cascade in (adaptive_high_pass, adaptive_high_pass_spatial_backward):
        _, residue = cascade(a[::4], 0.3 + lift[::4], x[::4], F_S / 4, DX)
        assert np.abs(residue).max() > 1e-3


@pytest.mark.slow
def test_bump_survives_the_bounce() -> None:
    t, x = stop_and_go()
    a, lift = bounce(t)
    bump = np.where(np.abs(x - 30) < 0.5, 0.02 * np.cos(np.pi * (x - 30)) ** 2, 0)
    _, profile = matched_high_pass(a, 0.3 + lift - bump, x, F_S, DX)
    assert profile[600] - (profile[585] + profile[615]) / 2 == pytest.approx(0.02, rel=0.01)


@settings(deadline=None, max_examples=8)
@given(speed=st.floats(5.0, 30.0), seed=st.integers(0, 99))
def test_at_constant_cut_off_observer_and_cascade_differ_by_their_start_alone(
    speed: float, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    a, h = rng.normal(size=200), 0.3 + 0.01 * rng.normal(size=200)
    a[0] = 0
    x, schedule = np.arange(200) * speed / 20, Schedule(f_ls=0.3, v_0=1e6)
    _, cascade = adaptive_high_pass_spatial_backward(a, h, x, 20.0, speed / 20, schedule)
    _, profile = matched_high_pass(a, h, x, 20.0, speed / 20, schedule)
    # The speed at the first point is 0, and with it the cut-off another one.
    assert profile[1:] == pytest.approx(cascade[1:], abs=1e-12)


@pytest.mark.parametrize(("z", "f_c"), [([0.1, 0.2], [0.1, 0.1]), ([0.0, 0.2], [0.1])])
def test_signals_the_observer_cannot_start_on_are_refused(z: list[float], f_c: list[float]) -> None:
    with pytest.raises(ValueError, match=r"at 0|do not fit"):
        matched_filter(z, f_c, 1.0)
