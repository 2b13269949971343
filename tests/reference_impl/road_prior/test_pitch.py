"""The pitch response against the oscillator's own solutions, and the tilt error."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_prior.pitch import pitch_response, tilt_input

FREQUENCY, DAMPING = st.floats(0.5, 4.0), st.floats(0.0, 0.95)


def times(seed: int, N: int = 80) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).uniform(0.001, 0.1, N))


@settings(deadline=None, max_examples=20)
@given(f_p=FREQUENCY, zeta=DAMPING, seed=st.integers(0, 999))
def test_step_response(f_p: float, zeta: float, seed: int) -> None:
    t = times(seed)
    phase, rest = 2 * np.pi * f_p * (t - t[0]), np.sqrt(1 - zeta**2)
    swing = np.cos(rest * phase) + zeta / rest * np.sin(rest * phase)
    expected = 1 - np.exp(-zeta * phase) * swing
    response = pitch_response(np.ones(80), t, f_p, zeta, theta_0=0.0)
    assert response == pytest.approx(expected, abs=1e-11)


@settings(deadline=None, max_examples=20)
@given(f_p=FREQUENCY, zeta=DAMPING, seed=st.integers(0, 999))
def test_samples_on_a_straight_line_change_nothing(f_p: float, zeta: float, seed: int) -> None:
    t, a_x = times(seed), np.random.default_rng(seed + 1).normal(size=80)
    finer = np.sort(np.concatenate([t, (0.3 * t[1:] + 0.7 * t[:-1])]))
    response = pitch_response(np.interp(finer, t, a_x), finer, f_p, zeta)
    assert response[::2] == pytest.approx(pitch_response(a_x, t, f_p, zeta), abs=1e-10)


@pytest.mark.slow
@settings(deadline=None, max_examples=10)
@given(f_p=FREQUENCY, zeta=st.floats(0.2, 0.9), f=st.floats(0.2, 5.0))
def test_a_sinusoid_is_amplified_as_the_oscillator_does(f_p: float, zeta: float, f: float) -> None:
    t = np.arange(20000) / 1000
    ratio = f / f_p
    answer = np.exp(2j * np.pi * f * t) / (1 - ratio**2 + 2j * zeta * ratio)
    response = pitch_response(np.sin(2 * np.pi * f * t), t, f_p, zeta)
    assert response[-2000:] == pytest.approx(answer.imag[-2000:], abs=5e-4)


@given(a=st.floats(-8, 8), f_p=FREQUENCY, zeta=DAMPING)
@settings(deadline=None, max_examples=20)
def test_steady_braking_is_rest(a: float, f_p: float, zeta: float) -> None:
    response = pitch_response(np.full(80, a), times(1), f_p, zeta)
    assert response == pytest.approx(np.full(80, a), abs=1e-12)


@pytest.mark.cites("(1.5)")
@settings(deadline=None, max_examples=30)
@given(a_x=st.floats(-8, 8), a_z=st.floats(-3, 3), theta_hat=st.floats(-10, 10))
def test_tilt_error_but_for_higher_powers_of_the_angle(
    a_x: float, a_z: float, theta_hat: float
) -> None:
    kappa = -0.009
    theta = kappa * theta_hat
    error = a_x * np.sin(theta) + (a_z + 9.80665) * (np.cos(theta) - 1)
    bound = abs(a_x * theta**3) / 6 + (a_z + 9.80665) * theta**2 / 2
    assert abs(error - kappa * tilt_input(a_x, theta_hat)) <= bound + 1e-12


@pytest.mark.parametrize(("f_p", "zeta"), [(1.6, 1.0), (1.6, -0.1), (0.0, 0.3)])
def test_what_does_not_swing_is_refused(f_p: float, zeta: float) -> None:
    with pytest.raises(ValueError, match="no oscillator"):
        pitch_response([0.0, 1.0], [0.0, 0.1], f_p, zeta)
