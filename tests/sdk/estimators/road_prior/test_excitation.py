"""Acceleration from the encoder, and the pitch response to it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.road_prior.excitation import SPREAD_S, Excitation
from floatref_reference.road_prior.pitch import pitch_response

laws = settings(deadline=None, max_examples=25)


def excited(distances, interval_s, hz=1.6, damping=0.3, cuts=()):
    excitation, found = Excitation.of(interval_s, hz, damping), []
    for piece in np.split(np.asarray(distances, float), sorted(cuts)):
        excitation.add(piece)
        found.append(excitation.take())
    excitation.end()
    return np.concatenate([*found, excitation.take()], axis=1)


@laws
@given(
    a=st.floats(-9.0, 9.0),
    v=st.floats(0.0, 30.0),
    interval_s=st.sampled_from([0.002, 0.004, 0.01, 0.02]),
)
def test_of_a_constant_acceleration_it_is_that(a, v, interval_s):
    times = np.arange(round(1.5 / interval_s)) * interval_s
    found, _ = excited(v * times + a * times**2 / 2, interval_s)
    inside = slice(round(0.2 / interval_s), -round(0.2 / interval_s))
    np.testing.assert_allclose(found[inside], a, atol=1e-6)
    assert found[0] == pytest.approx(0.0, abs=1e-6)


@laws
@given(hz=st.floats(0.2, 6.0), phase=st.floats(0.0, 6.28))
def test_waves_keep_their_phase_and_lose_what_a_gaussian_takes(hz, phase):
    times, omega = np.arange(1500) * 0.002, 2 * np.pi * hz
    found, _ = excited(np.sin(omega * times + phase), 0.002)
    kept = np.exp(-0.5 * (omega * SPREAD_S) ** 2)
    expected = -(omega**2) * kept * np.sin(omega * times + phase)
    np.testing.assert_allclose(found[200:-200], expected[200:-200], atol=5e-3 * omega**2)


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    hz=st.floats(0.5, 3.0),
    damping=st.floats(0.05, 0.9),
    interval_s=st.sampled_from([0.002, 0.01, 0.05]),
)
def test_the_response_is_the_literal_one(seed, hz, damping, interval_s):
    distances = np.cumsum(np.random.default_rng(seed).uniform(0.0, 0.1, 120))
    a, response = excited(distances, interval_s, hz, damping)
    times = np.arange(a.size) * interval_s
    expected = pitch_response(a, times, hz, damping, theta_0=0.0)
    # The stage begins at rest before its first acceleration, the reference under it.
    assert a[0] == pytest.approx(0.0, abs=1e-6 * np.abs(a).max())
    np.testing.assert_allclose(response, expected, atol=1e-7 * np.abs(expected).max())


@laws
@given(a=st.floats(0.5, 9.0), interval_s=st.sampled_from([0.002, 0.01, 0.02]))
def test_a_brake_fades_within_seconds_where_the_encoder_is_silent(a, interval_s):
    """It goes on at first, and e times less of it is left after every second; so of pitch."""
    times = np.arange(round(10.0 / interval_s)) * interval_s
    distances = np.where(times < 3.0, 40.0 * times - a * times**2 / 2, np.nan)
    found, response = excited(distances, interval_s)
    latest = np.flatnonzero(np.abs(found + a) < 1e-6)[-1]
    silent = times[latest:] - times[latest]
    assert 2.8 < times[latest] < 3.0
    np.testing.assert_allclose(found[latest:], -a * np.exp(-silent), rtol=1e-4)
    assert np.abs(response[-round(1.0 / interval_s) :]).max() < 0.01 * a


def test_half_of_a_wave_of_6_hz_is_left() -> None:
    """That is far above the pitching of a body and far below what an encoder's counts make."""
    times = np.arange(1500) * 0.002
    omega = 2 * np.pi * 6.0
    found, _ = excited(np.sin(omega * times), 0.002)
    assert np.abs(found[200:-200]).max() == pytest.approx(0.5 * omega**2, rel=0.1)
