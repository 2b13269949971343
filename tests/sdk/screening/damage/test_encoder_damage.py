"""An encoder's silence, lost counts and steps back, and travel that looks like them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.sdk.screening.damage.encoders import COUNT, RATE, damage, laws, travel

from floatref.intake.blocks import Source
from floatref.screening.damage.encoder_damage import encoder_damage
from floatref.screening.findings import Screening
from floatref.values.arrays import Flag
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

DISTANCE = ChannelId("distance")


def taken(steady, values, size=4096):
    """Distances and flags that the source makes of ``values``."""
    recording = steady(seconds=COUNT / RATE, distance=values)
    blocks = list(Source(Screening.of(recording)).blocks(size))
    flags = [b.flags.get(DISTANCE, np.zeros(len(b), np.uint8)) for b in blocks]
    return np.concatenate([b[DISTANCE] for b in blocks]), np.concatenate(flags)


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


def counts_only(values, rate=RATE):
    """The counts of a held encoder, each with its time, as a channel."""
    first = np.flatnonzero(np.diff(values, prepend=-1.0))
    return Channel.of("distance", values[first], StampedClock.of(first / rate))


def spanned_s(channel, spans):
    """Time from the last sample before each stretch to its last one, in s."""
    times = channel.times_s
    return [(times[first - 1], times[end - 1]) for first, end in spans]


@laws
@given(
    at_s=st.floats(1.0, 10.0),
    length_s=st.floats(0.3, 6.0),
    speed=st.floats(10.0, 30.0),
    count_m=st.sampled_from([0.02, 0.1, 0.25, 0.5]),
)
def test_lost_counts_are_found_alike_sampled_and_stamped(at_s, length_s, speed, count_m):
    times = np.arange(COUNT) / RATE
    moved = np.where(times < at_s, times, np.maximum(times - length_s, at_s))
    values = count_m * np.floor(speed * moved / count_m)
    stamped = counts_only(values)
    found = encoder_damage(stamped)
    assert found.gone.size == 0
    (begin_s, end_s), *more = spanned_s(stamped, found.void)
    assert not more
    assert begin_s == pytest.approx(at_s, abs=count_m / speed + 0.002)
    assert end_s - length_s == pytest.approx(at_s, abs=count_m / speed + 0.002)
    ((first, end),) = damage(values).void
    np.testing.assert_allclose([(first - 1) / RATE, end / RATE], [begin_s, end_s], atol=1e-9)
    assert all("loses counts" in d.warnings[0] for d in (found, damage(values)))


@pytest.mark.parametrize("speed", [4.0, 20.0])
@pytest.mark.parametrize("seconds", [0.3, 2.5, 15.0])
def test_counts_lost_to_the_end_are_unknown(speed, seconds):
    values = travel(speed)
    at = COUNT - int(seconds * RATE)
    values[at:] = values[at]
    found = damage(values)
    ((first, end),) = found.void
    assert (first, end) == (at + 1, pytest.approx(COUNT, abs=1))


@pytest.mark.parametrize("rate", [50.0, 100.0, 1000.0])
@pytest.mark.parametrize("seconds", [0.08, 0.1, 0.4])
def test_silence_is_made_up_for_at_low_rates_as_well(rate, seconds):
    values = 20.0 * np.arange(int(20 * rate)) / rate
    at, behind = int(10 * rate), int(10 * rate) + max(1, int(seconds * rate))
    values[at:behind] = values[at]
    found = encoder_damage(Channel.of("distance", values, UniformClock.of(rate)))
    np.testing.assert_array_equal(found.gone, [[at + 1, behind]])
    assert found.void.size == 0


def test_an_encoder_that_trembles_by_one_count_at_a_stand_is_no_fault():
    values = travel(10.0, count_m=0.01)
    values[8000:] -= values[8000] - values[7999]
    values[8000:16_000] = values[7999] + 0.01 * (np.arange(8000) % 2)
    values[16_000:] = values[15_999] + 0.01 * np.floor(np.arange(4000) ** 2 * 4e-4)
    assert "goes back" not in " ".join(damage(values).warnings)


@laws
@given(
    rate=st.sampled_from([10.0, 50.0, 100.0, 1000.0]),
    count_m=st.sampled_from([0.0003, 0.02, 0.1, 0.5]),
    braking=st.floats(0.5, 8.0),
    speed=st.floats(1.0, 30.0),
    held=st.booleans(),
)
def test_a_sound_drive_with_a_stop_is_none_at_any_rate(rate, count_m, braking, speed, held):
    times = np.arange(int(60 * rate)) / rate
    stop_s = 20.0 + speed / braking
    slowing = np.clip(times - 20.0, 0.0, speed / braking)
    rolls = 0.1 * np.sin(np.pi * np.clip(times - stop_s, 0.0, 2.0))
    later = np.clip(times - stop_s - 3.0, 0.0, None)
    onward = 1.5 * np.minimum(later, 5.0) ** 2 + 15.0 * np.maximum(later - 5.0, 0.0)
    x = speed * np.clip(times, 0.0, 20.0) + (speed - 0.5 * braking * slowing) * slowing
    values = count_m * np.floor((x + rolls + onward) / count_m)
    many = 20 if held else 1
    clock = UniformClock.of(many * rate)
    lines = encoder_damage(Channel.of("distance", np.repeat(values, many), clock)).warnings
    assert [line for line in lines if "goes back" not in line] == []
