"""An encoder's leaps, silence, lost counts and steps back, and travel that looks like them."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import floatref
from floatref.architectures.encoder_damage import encoder_damage
from floatref.architectures.source import Source
from floatref.values.arrays import Flag
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

RATE, COUNT = 1000.0, 20_000
CLOCK = UniformClock.of(RATE)
DISTANCE = ChannelId("distance")
laws = settings(
    deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def travel(speed=20.0, count_m=0.0003, rate=RATE):
    return count_m * np.floor(speed * np.arange(COUNT) / rate / count_m)


def damage(values, clock=CLOCK):
    return encoder_damage(Channel.of("distance", values, clock))


def taken(steady, values, size=4096):
    """Distances and flags that the source makes of ``values``."""
    recording = steady(
        seconds=COUNT / RATE, distance=Channel.of("distance", values, UniformClock.of(RATE))
    )
    blocks = list(Source(recording).blocks(size))
    flags = [b.flags.get(DISTANCE, np.zeros(len(b), np.uint8)) for b in blocks]
    return np.concatenate([b[DISTANCE] for b in blocks]), np.concatenate(flags)


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
@given(at=st.integers(500, 15_000), length=st.integers(30, 1000), speed=st.floats(4.0, 30.0))
def test_silence_that_is_made_up_for_is_a_line(steady, at, length, speed):
    values, true = travel(speed), travel(speed)
    values[at : at + length] = values[at]
    distance, flags = taken(steady, values)
    np.testing.assert_allclose(distance, true, atol=0.001 * speed + 0.0006)
    assert (flags[at + 1 : at + length] & Flag.MISSING).all()
    assert not flags[:at].any()
    assert not flags[at + length + 1 :].any()
    assert bool(flags[at + 2] & Flag.SLOW) == (length - 1 > 500)


@laws
@given(at=st.integers(500, 15_000), length=st.integers(60, 1900), speed=st.floats(4.0, 30.0))
def test_lost_counts_are_unknown_and_slow(steady, at, length, speed):
    values = travel(speed)
    values[at + length :] -= values[at + length] - values[at]
    values[at : at + length] = values[at]
    distance, flags = taken(steady, values)
    unknown = np.flatnonzero(np.isnan(distance))
    assert unknown[0] == pytest.approx(at + 1, abs=1)
    assert unknown[-1] == pytest.approx(at + length - 1, abs=1)
    assert (flags[unknown] == Flag.MISSING | Flag.SLOW).all()
    assert not flags[~np.isnan(distance)].any()


@laws
@given(
    braking=st.floats(0.5, 12.0),
    speed=st.floats(3.0, 30.0),
    count_m=st.sampled_from([0.0003, 0.005, 0.05, 0.3]),
    dwell_s=st.floats(0.05, 5.0),
)
def test_a_stop_is_no_fault(braking, speed, count_m, dwell_s):
    times = np.arange(COUNT) / RATE
    slowing = np.clip(speed - braking * np.clip(times - 2.0, 0.0, None), 0.0, None)
    starts = 2.0 + speed / braking + dwell_s
    moving = slowing + np.clip(4.0 * (times - starts), 0.0, speed)
    values = count_m * np.floor(np.cumsum(moving) / RATE / count_m)
    assert damage(values).warnings == ()


@pytest.mark.parametrize("speed", [0.02, 0.3, 2.0, 20.0])
@pytest.mark.parametrize("every", [1, 10, 100])
def test_an_encoder_that_is_held_or_coarse_is_none(speed, every):
    values = np.repeat(travel(speed)[::every], every)[:COUNT]
    assert damage(values).warnings == ()
    coarse = travel(speed, count_m=0.1)
    assert damage(coarse).warnings == ()
    first = np.flatnonzero(np.diff(coarse, prepend=-1.0))
    assert damage(coarse[first], StampedClock.of(first / RATE)).warnings == ()


@laws
@given(
    at=st.integers(100, 15_000),
    length=st.integers(1, 400),
    back_m=st.floats(0.001, 0.9),
    size=st.sampled_from([977, 4096, COUNT]),
)
def test_what_lies_behind_is_bridged_and_never_goes_back(steady, at, length, back_m, size):
    values = travel()
    length = max(1, min(length, int(back_m / 0.02) - 1))
    values[at : at + length] -= back_m
    distance, flags = taken(steady, values, size)
    assert np.diff(distance).min() >= -1e-12
    behind = values < np.maximum.accumulate(values)
    assert (flags[behind] & Flag.MISSING).all()
    np.testing.assert_array_equal(distance[~behind], values[~behind])


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
    recording = steady(seconds=20.0, distance=Channel.of("distance", values, CLOCK))
    with pytest.warns(floatref.FloatrefWarning, match="distance: leaps for 1 samples in 1 places"):
        profile = floatref.process(recording, pipeline)
    x, valid = profile.distance_m, profile.tracks[0].valid
    assert not valid[(x > 186.0) & (x < 230.0)].any()
    assert valid[(x > 60.0) & (x < 180.0)].all()
    assert valid[(x > 250.0) & (x < 340.0)].all()
