"""What a wrong attitude, or a receiver that is back, adds to a profile."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording
from floatref_conformance.mutants.in_fusion import IN_FUSION, Attitude, add_tilt_error

INTERVAL, SPEED, RATE = 0.05, 20.0, 1000.0
TIMES = np.arange(20000) / RATE
BRAKE = (TIMES > 8.0) & (TIMES < 11.0)
PITCH, FORCE = 0.02, -2.0
angles = st.floats(-1.0, 1.0)


def spoilt(name, profile, recording):
    after = next(mutation.after for mutation in IN_FUSION if mutation.name == name)
    return after(profile, recording).track("left").elevation


@pytest.fixture
def recording():
    """A brake that pitches the body while the speed, for simplicity's sake, stays."""
    clock, fixes = UniformClock.of(RATE), UniformClock.of(20.0)
    quality = np.full(400, 4.0)
    quality[100:140] = 0.0
    values = {
        "distance": (SPEED * TIMES, clock, None),
        "height": (0.3 + 1e-9 * np.sin(TIMES), clock, "left"),
        "vertical_specific_force": (np.full(TIMES.size, STANDARD_GRAVITY), clock, "left"),
        "longitudinal_specific_force": (np.where(BRAKE, FORCE, 0.0), clock, "left"),
        "lateral_specific_force": (np.zeros(TIMES.size), clock, "left"),
        "gnss_pitch": (np.where(BRAKE[::50], PITCH, 0.0), fixes, None),
        "gnss_roll": (np.zeros(400), fixes, None),
        "gnss_quality": (quality, fixes, None),
    }
    return Recording(tuple(Channel.of(name, v, c, t) for name, (v, c, t) in values.items()))


@pytest.fixture
def profile():
    x = INTERVAL * np.arange(round(SPEED * TIMES[-1] / INTERVAL))
    return Profile(INTERVAL, (ProfileTrack.of("left", 0.001 * np.sin(x)),))


@given(pitch=angles, roll=angles)
def test_up_is_a_direction(pitch, roll):
    up = Attitude(np.array([pitch]), np.array([roll])).up
    assert np.linalg.norm(up) == pytest.approx(1.0)
    assert np.sign(up[0, 0]) == -np.sign(pitch)
    assert np.sign(up[1, 0]) == np.sign(roll)


def test_a_right_attitude_changes_nothing(profile, recording):
    same = add_tilt_error(lambda attitude: attitude)(profile, recording).track("left").elevation
    np.testing.assert_array_equal(same, profile.track("left").elevation)


def test_a_wrong_sign_of_the_pitch_lets_the_brake_into_the_profile(profile, recording):
    false = spoilt("pitch-sign", profile, recording) - profile.track("left").elevation
    there = np.abs(profile.distance_m - 9.5 * SPEED) < 30.0
    assert np.ptp(false[there]) > 0.01
    assert np.ptp(false[there]) > 3.0 * np.ptp(false[profile.distance_m < 60.0])


def test_degrees_for_radians_are_so_many_times_worse(profile, recording):
    z = profile.track("left").elevation
    sign, degrees = (
        np.ptp(spoilt(name, profile, recording) - z) for name in ("pitch-sign", "rates-in-degrees")
    )
    assert degrees > 10.0 * sign


def test_a_receiver_that_is_back_leaves_a_step(profile, recording):
    false = spoilt("steps-after-an-outage", profile, recording) - profile.track("left").elevation
    rises = np.diff(false)
    assert rises.max() == pytest.approx(0.02, rel=0.02)
    assert profile.distance_m[np.argmax(rises)] == pytest.approx(140 / 20 * SPEED, abs=0.1)
    assert np.sum(rises > 0.001) == 1
