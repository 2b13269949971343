"""Leaps and spikes of an encoder, and counts that no vehicle can make."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.sdk.screening.damage.encoders import CLOCK, COUNT, RATE, damage, laws, travel

import floatref
from floatref.screening.damage.encoder_damage import encoder_damage
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel


@laws
@given(
    at=st.integers(1, COUNT - 1),
    size_m=st.floats(0.3, 10.0),
    speed=st.floats(6.0, 30.0),
    stamped=st.booleans(),
)
def test_a_leap_is_void(at, size_m, speed, stamped):
    values = travel(speed)
    values[at:] += size_m
    clock = StampedClock.of(CLOCK.times(COUNT)) if stamped else CLOCK
    found = damage(values, clock)
    np.testing.assert_array_equal(found.void, [[at, at + 1]])
    np.testing.assert_array_equal(found.lasting, found.void)
    assert found.gone.size == 0


@laws
@given(at=st.integers(500, 15_000), length=st.integers(1, 200), size_m=st.floats(5.0, 30.0))
def test_a_leap_over_missing_samples_is_void_all_along(at, length, size_m):
    values = travel(12.0)
    values[at + length :] += size_m + 0.012 * length
    values[at : at + length] = np.nan
    np.testing.assert_array_equal(damage(values).void, [[at, at + length + 1]])


@laws
@given(
    rate=st.sampled_from([10.0, 50.0, 100.0, 4000.0]),
    places=st.sets(st.integers(2, 30), min_size=1, max_size=29),
    size_m=st.floats(6.0, 30.0),
)
def test_leaps_do_not_hide_each_other_nor_at_low_rates(rate, places, size_m):
    seconds = np.arange(int(34 * rate)) / rate
    values = 20.0 * seconds
    at = [int(k * rate) + 3 for k in sorted(places)]
    for k in at:
        values[k:] += size_m
    channel = Channel.of("distance", values, UniformClock.of(rate))
    np.testing.assert_array_equal(encoder_damage(channel).void, [[k, k + 1] for k in at])


@laws
@given(
    at=st.integers(500, 15_000),
    length=st.integers(100, 400),
    faster=st.floats(2.0, 4.0),
    speed=st.floats(10.0, 17.0),
)
def test_counts_beyond_what_a_vehicle_speeds_up_are_void(at, length, faster, speed):
    values = travel(speed)
    extra = faster * speed * np.clip(np.arange(COUNT) - at, 0, length) / RATE
    found = damage(values + extra)
    void = np.zeros(COUNT, np.bool_)
    for begin, end in found.void:
        void[begin:end] = True
    # Knots are 25 samples apart, a burst lasts 100 or more.
    assert void[at : at + length].mean() >= 0.75
    assert not void[: at - 51].any()
    # A way that holds the burst's end may pass, and make the next ones look slow.
    assert not void[at + length + 201 :].any()
    # One of a tenth of a second may as well be a leap.
    assert any("counts too much" in line or "leaps" in line for line in found.warnings)


@laws
@given(at=st.integers(500, 15_000), height_m=st.floats(0.5, 50.0))
def test_a_spike_is_bridged_and_what_follows_is_not_behind(at, height_m):
    values = travel()
    values[at] += height_m
    found = damage(values)
    np.testing.assert_array_equal(found.gone, [[at, at + 1]])
    assert found.void.size == 0


def test_a_missing_distance_is_no_leap():
    values = travel()
    values[3000:9000] = np.nan
    assert damage(values).warnings == ()


@pytest.mark.parametrize(
    "pipeline",
    ["temporal-adaptive-hpf-spatial-backward", "spatial-hpf-timer-distortion-reflection"],
)
def test_around_a_leap_no_point_is_valid_and_the_user_is_told(steady, pipeline):
    values = travel()
    values[10_000:] += 2.0
    recording = steady(seconds=20.0, distance=values)
    with pytest.warns(floatref.FloatrefWarning, match="distance: leaps for 1 samples in 1 places"):
        profile = floatref.process(recording, pipeline)
    x, valid = profile.distance_m, profile.tracks[0].valid
    assert not valid[(x > 186.0) & (x < 230.0)].any()
    assert valid[(x > 60.0) & (x < 180.0)].all()
    assert valid[(x > 250.0) & (x < 340.0)].all()
