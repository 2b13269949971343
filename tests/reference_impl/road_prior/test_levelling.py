"""Levelling in its own words: motions whose attitude is known, made from the equations."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2.section_2_3_1_kinematics import body_fixed_acceleration
from floatref_reference.road_prior.levelling import (
    G,
    Smoothing,
    Unit,
    attitude,
    integrated,
    level,
    slow_angles,
)
from floatref_reference.road_prior.lines import between, bins, local_line

RATE, N = 40, 480
T = np.arange(N) / RATE
HOW = Smoothing(every=2, near_s=1.0, far_s=1.5, patience=2)
laws = settings(deadline=None, max_examples=3)
ANGLES = st.floats(-0.15, 0.15)


def carried(theta: np.ndarray, phi: np.ndarray, a_w: np.ndarray) -> np.ndarray:
    """Return the specific force of a body with these angles and accelerations."""
    seen = body_fixed_acceleration(a_w, theta, phi).astype(float)
    seen[2] += G
    return seen


@pytest.mark.slow
@pytest.mark.cites("(2.20)")
@laws
@given(theta=ANGLES, v=st.floats(10.0, 30.0), a=st.floats(-3.0, -0.1))
def test_a_brake_on_a_hill_is_level_to_the_last_digit(theta: float, v: float, a: float) -> None:
    """The body stays parallel to the road; V changes by a along it."""
    along = np.where(T > 6.0, a, 0.0)
    distance = v * T + a * np.maximum(T - 6.0, 0.0) ** 2 / 2
    a_w = np.stack([along * np.cos(theta), np.zeros(N), -along * np.sin(theta)])
    f = carried(np.full(N, theta), np.zeros(N), a_w)
    unit = Unit(f, np.zeros((3, N)), distance, 1 / RATE)
    # Where the brake begins, a bin holds some of both.
    assert level(unit, HOW) == pytest.approx(a_w[2], abs=2e-3 * abs(a))
    steady = Unit(f[:, :200], np.zeros((3, 200)), distance[:200], 1 / RATE)
    assert level(steady, HOW) == pytest.approx(np.zeros(200), abs=1e-9)


@pytest.mark.slow
@pytest.mark.cites("(2.20)", "(6.27)", "(6.28)")
@laws
@given(v=st.floats(5.0, 30.0), yaw=st.floats(-0.3, 0.3), phi=ANGLES)
def test_a_banked_curve_is_level(v: float, yaw: float, phi: float) -> None:
    """V and the yaw rate are steady: the body's rates are those about the vertical."""
    a_w = np.stack([np.zeros(N), np.full(N, v * yaw), np.zeros(N)])
    f = carried(np.zeros(N), np.full(N, phi), a_w)
    omega = yaw * np.stack([np.zeros(N), np.full(N, np.sin(phi)), np.full(N, np.cos(phi))])
    # In body axes V ω_z is all of the lateral acceleration along Y; of the rest some is along Z.
    unit = Unit(f, omega, v * T, 1 / RATE)
    angles, known = attitude(unit, HOW)
    assert all(known)
    assert angles[0] == pytest.approx(np.zeros(N), abs=1e-9)
    assert angles[1] == pytest.approx(np.full(N, phi), abs=1e-9)
    assert level(unit, HOW) == pytest.approx(np.zeros(N), abs=1e-7)


@pytest.mark.slow
@laws
@given(bias=st.floats(-0.01, 0.01), amplitude=st.floats(0.0, 0.03), hz=st.floats(1.0, 2.0))
def test_a_bias_of_the_gyro_is_nothing_and_fast_pitch_is_as_it_is(
    bias: float, amplitude: float, hz: float
) -> None:
    """Gravity is masked by a surge that the encoder does not see, as fast as the body pitches.

    It is sampled four times as often as elsewhere: the trapezoidal rule, by which rates become
    angles, errs by (ω/rate)²/12 of the pitch, which has to be small beside the bound.
    """
    rate, how = 4 * RATE, HOW._replace(every=4 * HOW.every)
    t = np.arange(4 * N) / rate
    omega = 2 * np.pi * hz
    theta, turning = amplitude * np.sin(omega * t), amplitude * omega * np.cos(omega * t)
    zeros = np.zeros(t.size)
    surge = np.sin(omega * t + 1.0)
    f = np.stack([-G * np.sin(theta) + surge, zeros, np.full(t.size, G)])
    rates = np.stack([zeros, turning + bias, zeros])
    angles, _ = attitude(Unit(f, rates, 10.0 * t, 1 / rate), how)
    inside = slice(5 * rate, -5 * rate)
    assert angles[0][inside] == pytest.approx(theta[inside], abs=1e-3 * (amplitude + 0.1))


@pytest.mark.cites("(6.27)", "(6.28)")
@laws
@given(seed=st.integers(0, 999))
def test_integrated_rates_are_the_angles_of_a_turning_body(seed: int) -> None:
    """The rates of the body are made from those of the angles by the inverse of the equations."""
    rng = np.random.default_rng(seed)
    theta, phi = (0.02 * np.sin(rng.uniform(1, 3) * T + rng.uniform(0, 6)) for _ in range(2))
    psi_rate = 0.2
    theta_rate, phi_rate = (np.gradient(x, 1 / RATE) for x in (theta, phi))
    omega = np.stack(
        [
            phi_rate - psi_rate * np.sin(theta),
            theta_rate * np.cos(phi) + psi_rate * np.cos(theta) * np.sin(phi),
            psi_rate * np.cos(theta) * np.cos(phi) - theta_rate * np.sin(phi),
        ]
    )
    unit = Unit(np.zeros((3, N)), omega, T, 1 / RATE)
    found = integrated(unit, list(zip(theta, phi, strict=True)), 1)
    assert found[0] - found[0][0] == pytest.approx(theta - theta[0], abs=2e-4)
    assert found[1] - found[1][0] == pytest.approx(phi - phi[0], abs=2e-4)


@laws
@given(a=st.floats(-1, 1), b=st.floats(-1, 1), seed=st.integers(0, 999))
def test_a_line_passes_as_it_is(a: float, b: float, seed: int) -> None:
    known = np.random.default_rng(seed).uniform(size=60) < 0.6
    y = np.where(known, a + b * np.arange(60), np.nan)
    for place in range(10, 50):
        found = local_line(y, place, 5.0, np.zeros(60), 99)
        assert found == pytest.approx(a + b * place, abs=1e-9)


def test_nothing_crosses_silence() -> None:
    y = np.where(np.arange(40) < 20, 1.0, 5.0)
    silent = np.zeros(40)
    silent[19:21] = 1
    y[silent > 0] = np.nan
    assert local_line(y, 18, 5.0, silent, 2) == pytest.approx(1.0)
    assert local_line(y, 22, 5.0, silent, 2) == pytest.approx(5.0)
    assert 1.5 < local_line(y, 18, 5.0, silent, 3) < 4.5 or y[18] == 1.0
    assert np.isnan(local_line(np.full(5, np.nan), 2, 5.0, np.zeros(5), 2))


def test_bins_know_what_half_of_their_samples_tell() -> None:
    x = np.array([1.0, 3.0, np.nan, np.nan, np.nan, 7.0, 9.0])
    assert bins(x, 2) == pytest.approx([2.0, np.nan, 7.0, np.nan], nan_ok=True)
    assert between([1.0, 3.0], 1, 2) == pytest.approx(1.5)
    assert between([1.0, 3.0], 0, 2) == 1.0


@laws
@given(theta=ANGLES, phi=ANGLES)
def test_slow_angles_are_those_of_gravity(theta: float, phi: float) -> None:
    found = slow_angles(np.sin(theta), np.cos(theta) * np.sin(phi))
    assert found == pytest.approx((theta, phi), abs=1e-12)
    assert slow_angles(np.nan, np.nan) == (0.0, 0.0)
