"""Every change leaves what it does not name, and is undone in the result."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.sameness.changes import CHANGES, begins_later_m, change_of
from floatref_conformance.proving_ground.scenario import Scenario

laws = settings(deadline=None, max_examples=25)


def recorded():
    rng = np.random.default_rng(0)
    fixes = StampedClock.of(0.0125 + np.arange(80) / 20.0)
    return Recording(
        (
            Channel.of("distance", np.arange(4000) * 0.02, UniformClock.of(1000.0)),
            Channel.of("vertical_specific_force", rng.random(4000), UniformClock.of(1000.0, 0.2)),
            Channel.of("unsprung_specific_force", rng.random(4000), UniformClock.of(1000.0)),
            Channel.of("suspension_deflection", rng.random(4000), UniformClock.of(1000.0)),
            Channel.of("pitch_rate", rng.random(400), UniformClock.of(100.0)),
            Channel.of("lateral_specific_force", rng.random(4000), UniformClock.of(1000.0)),
            Channel.of("gnss_height", rng.random(80), fixes),
        )
    )


def changed(name, **numbers):
    return CHANGES[name].recording(recorded(), numbers)


def pairs(recording):
    return zip(recorded().channels, recording.channels, strict=True)


@laws
@given(samples=st.integers(1, 3000))
def test_a_later_start_leaves_what_was_recorded_from_then_on(samples):
    later = changed("later-start", samples=samples)
    begin_s = 0.2 + samples / 1000.0
    for before, after in pairs(later):
        kept = before.times_s >= begin_s - 1e-9
        np.testing.assert_array_equal(after.values, before.values[kept])
        np.testing.assert_allclose(after.times_s, before.times_s[kept], atol=1e-12)
    lost_m = begins_later_m(recorded(), later)
    assert lost_m == pytest.approx(np.ceil(begin_s * 1000.0 - 1e-6) * 0.02)


def test_other_storage_keeps_samples_and_times():
    for before, after in pairs(changed("clock-storage")):
        assert isinstance(after.clock, StampedClock)
        np.testing.assert_array_equal(after.values, before.values)
        np.testing.assert_array_equal(after.times_s, before.times_s)


@laws
@given(bias=st.floats(-1.0, 1.0), shift_s=st.floats(-1e6, 1e6), shift_m=st.floats(-1e5, 1e5))
def test_bias_time_and_place_move_what_they_name_alone(bias, shift_s, shift_m):
    forces = ("vertical_specific_force", "unsprung_specific_force")
    for name, numbers, named in (
        ("accelerometer-bias", {"bias": bias}, forces),
        ("distance-origin", {"shift_m": shift_m}, ("distance",)),
    ):
        (moved,) = numbers.values()
        for before, after in pairs(changed(name, **numbers)):
            by = moved if after.id.name in named else 0.0
            np.testing.assert_array_equal(after.values, before.values + by)
            np.testing.assert_array_equal(after.times_s, before.times_s)
    for before, after in pairs(changed("clock-origin", shift_s=shift_s)):
        np.testing.assert_array_equal(after.values, before.values)
        np.testing.assert_allclose(after.times_s, before.times_s + shift_s, atol=1e-9)


@laws
@given(factor=st.floats(0.2, 5.0), shift_m=st.floats(-1e5, 1e5))
def test_changes_are_undone_in_the_result(factor, shift_m):
    sound = Profile(0.1, (ProfileTrack.of("main", np.arange(5.0)),), 7.0)
    moved = Profile(0.1, sound.tracks, 7.0 + shift_m)
    back = CHANGES["distance-origin"].profile(moved, {"shift_m": shift_m})
    assert back.start_m == pytest.approx(7.0, abs=1e-9)
    higher = Profile(0.1, (ProfileTrack.of("main", factor * np.arange(5.0)),), 7.0)
    lower = CHANGES["road-height"].profile(higher, {"factor": factor})
    np.testing.assert_allclose(lower.tracks[0].elevation, np.arange(5.0), rtol=1e-12)
    scenario = CHANGES["road-height"].scenario(Scenario(), {"factor": factor})
    assert scenario.iri_m_per_km == pytest.approx(factor * Scenario().iri_m_per_km)


@laws
@given(shift_m=st.floats(-1e3, 1e3), bias=st.floats(-0.1, 0.1), rate_bias=st.floats(-0.01, 0.01))
def test_datum_and_biases_of_augmented_devices_move_what_they_name_alone(shift_m, bias, rate_bias):
    moved = {"gnss_height": shift_m, "pitch_rate": rate_bias, "lateral_specific_force": bias}
    datum = changed("gnss-datum", shift_m=shift_m)
    biased = changed("imu-bias", bias=bias, rate_bias=rate_bias)
    for recording, named in ((datum, "gnss"), (biased, "pitch_rate lateral")):
        for before, after in pairs(recording):
            by = moved.get(after.id.name, 0.0) if after.id.name.split("_")[0] in named else 0.0
            np.testing.assert_array_equal(after.values, before.values + by)


@laws
@given(every=st.integers(1, 5))
def test_of_a_receivers_readings_every_so_manyth_is_left(every):
    for before, after in pairs(changed("gnss-rate", every=every)):
        step = every if before.id.name.startswith("gnss") else 1
        np.testing.assert_array_equal(after.values, before.values[::step])
        np.testing.assert_array_equal(after.times_s, before.times_s[::step])


@laws
@given(
    gyro_rate_hz=st.floats(50.0, 500.0),
    grade=st.floats(-5.0, 5.0),
    cross_slope=st.floats(-5.0, 5.0),
)
def test_gyro_rate_and_slope_are_those_of_another_drive(gyro_rate_hz, grade, cross_slope):
    plain = Scenario()
    slope = {"grade_percent": grade, "cross_slope_percent": cross_slope}
    for name, numbers in (("gyro-rate", {"gyro_rate_hz": gyro_rate_hz}), ("slope", slope)):
        assert CHANGES[name].scenario(plain, numbers) == replace(plain, **numbers)


def test_a_variation_names_a_change_and_its_numbers():
    with pytest.raises(InputError, match="variation change 'colour': unknown; known: later-start"):
        change_of({"change": "colour"})
    with pytest.raises(InputError, match="variation bias is None; give a number"):
        changed("accelerometer-bias")
