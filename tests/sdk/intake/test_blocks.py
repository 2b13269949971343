"""From channels of any clock to blocks on the accelerometer's."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.intake.blocks import Source
from floatref.intake.steady_rate import steady_clock
from floatref.screening.findings import Screening
from floatref.values.arrays import Flag
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

HEIGHT, FORCE = ChannelId("height", "main"), ChannelId("vertical_specific_force", "main")
DISTANCE = ChannelId("distance")
laws = settings(
    deadline=None, max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def source_of(recording):
    return Source(Screening.of(recording))


def whole(source, size=300):
    blocks = list(source.blocks(size))
    return {
        name: np.concatenate([block[name] for block in blocks]) for name in blocks[0].values
    }, blocks


def still(stamps):
    force = np.full(stamps.size, 9.8)
    return Channel.of("vertical_specific_force", force, StampedClock.of(stamps))


def flags_of(blocks, channel):
    return np.concatenate([b.flags.get(channel, np.zeros(len(b), np.uint8)) for b in blocks])


def test_channels_on_one_clock_pass_through(steady):
    recording = steady()
    values, blocks = whole(source_of(recording))
    np.testing.assert_array_equal(values[HEIGHT], recording.channel("height").values)
    assert not any(block.flags or block.fresh for block in blocks)


@laws
@given(
    rate=st.sampled_from([250.0, 333.0, 3240.0]),
    start=st.integers(-100, 4000).map(lambda k: k / 10_000.0),
)
def test_another_clock_is_linear_in_between(steady, rate, start):
    count = int(5.0 * rate)
    times = start + np.arange(count) / rate
    slow = Channel.of("distance", 3.0 + 20.0 * times, UniformClock.of(rate, start))
    source = source_of(steady(distance=slow))
    values, blocks = whole(source)
    at = source.header.origin + np.arange(source.length) / 1000.0
    np.testing.assert_allclose(values[DISTANCE], 3.0 + 20.0 * at, atol=1e-9)
    fresh = np.concatenate([block.fresh[DISTANCE] for block in blocks])
    expected = min(source.length, source.length * rate / 1000.0)
    assert abs(fresh.sum() - expected) <= 1.0 + 0.01 * count
    assert source.origin_m == values[DISTANCE][0]


@pytest.mark.slow
@laws
@given(seed=st.integers(0, 2**32 - 1), cut=st.integers(50, 900))
def test_any_split_gives_the_same_samples(steady, seed, cut):
    rng = np.random.default_rng(seed)
    stamps = np.cumsum(rng.uniform(0.001, 0.01, 900))
    heights = rng.standard_normal(900)
    heights[rng.integers(1, 899, 60)] = np.nan
    own = Channel.of("height", heights, StampedClock.of(stamps))
    recording = steady(height=own)
    one, two = whole(source_of(recording), cut)[0], whole(source_of(recording), 4000)[0]
    np.testing.assert_array_equal(one[HEIGHT], two[HEIGHT])


def test_a_gap_is_bridged_by_a_line_and_flagged(steady):
    recording = steady()
    heights = recording.channel("height").values.copy()
    heights[1000:1400] = np.nan
    lost = steady(height=heights)
    values, blocks = whole(source_of(lost))
    line = np.interp(np.arange(1000, 1400), [999, 1400], heights[[999, 1400]])
    np.testing.assert_allclose(values[HEIGHT][1000:1400], line, atol=1e-15)
    flags = flags_of(blocks, HEIGHT)
    np.testing.assert_array_equal(flags != 0, np.isnan(heights))
    assert set(flags.tolist()) == {0, int(Flag.MISSING)}


@pytest.mark.slow
@pytest.mark.parametrize("size", [3, 7, 4000])
@pytest.mark.parametrize(("count", "kind"), [(10, Flag.MISSING), (11, Flag.MISSING | Flag.DRIFT)])
def test_a_long_gap_of_the_accelerometer_is_flagged_as_drift(steady, size, count, kind):
    forces = steady().channel("vertical_specific_force").values.copy()
    forces[5 : 5 + count] = np.nan
    blocks = source_of(steady(vertical_specific_force=forces)).blocks(size)
    flags = flags_of(blocks, FORCE)
    assert set(flags[5 : 5 + count].tolist()) == {int(kind)}
    assert not flags[:5].any()
    assert not flags[5 + count :].any()


@pytest.mark.parametrize("part", [slice(0, 3), slice(-3, None)])
def test_a_gap_at_the_end_of_a_run_is_long_since_nobody_knows_its_end(steady, part):
    forces = steady().channel("vertical_specific_force").values.copy()
    forces[part] = np.nan
    blocks = source_of(steady(vertical_specific_force=forces)).blocks(100)
    flags = flags_of(blocks, FORCE)
    assert (flags[part] == Flag.MISSING | Flag.DRIFT).all()


def test_a_hole_between_time_stamps_of_a_laser_is_a_gap(steady):
    stamps = np.concatenate((np.arange(0.0, 2.0, 0.002), np.arange(2.5, 4.1, 0.002)))
    own = Channel.of("height", 0.3 + 1e-3 * np.cos(stamps), StampedClock.of(stamps))
    (block,) = source_of(steady(height=own)).blocks(10_000)
    at = np.arange(len(block)) / 1000.0
    inside = (at > 1.9985) & (at < 2.4995)
    np.testing.assert_array_equal(block.flags[HEIGHT] != 0, inside)


def test_pulses_of_an_encoder_far_apart_are_no_gap(steady):
    stamps = np.array([0.0, 0.1, 0.2, 3.0, 3.1, 4.5])
    own = Channel.of("distance", np.arange(6) * 0.5, StampedClock.of(stamps))
    (block,) = source_of(steady(distance=own)).blocks(10_000)
    assert not block.flags


def test_time_stamps_of_a_constant_rate_are_that_rate(steady):
    stamps = 7.0 + np.arange(4000) / 1000.0
    own = still(stamps)
    shifted = {
        name: Channel.of(name, steady().channel(name).values, UniformClock.of(1000.0, 7.0))
        for name in ("height", "distance")
    }
    assert source_of(steady(vertical_specific_force=own, **shifted)).length == 4000


@pytest.mark.slow
@pytest.mark.parametrize("rate", [1000.0, 16_000.0])
@pytest.mark.parametrize("hole_s", [0.02, 0.7183])
def test_a_hole_between_time_stamps_of_an_accelerometer_is_a_gap(steady, rate, hole_s):
    stamps = np.arange(int(4.0 * rate)) / rate
    stamps[int(2.0 * rate) :] += hole_s
    count = stamps.size
    channels = {
        name: Channel.of(name, 9.8 + np.arange(count) * step, StampedClock.of(stamps))
        for name, step in (("vertical_specific_force", 0.0), ("height", 0.0), ("distance", 1e-3))
    }
    source = source_of(steady(**channels))
    assert float(source.header.rate) == rate
    (block,) = source.blocks(10**6)
    at = np.arange(len(block)) / rate
    inside = (at > 2.0 - 0.5 / rate) & (at < 2.0 + hole_s - 1.5 / rate)
    lost = block.flags[FORCE] == Flag.MISSING | Flag.DRIFT
    assert lost[inside].all()
    assert not block.flags[FORCE][(at < 2.0 - 2.5 / rate) | (at > 2.0 + hole_s)].any()


def test_an_accelerometer_of_changing_rate_is_refused(steady):
    stamps = np.concatenate((np.arange(3000) / 1000.0, 3.0 + np.arange(1000) / 1100.0))
    own = still(stamps)
    with pytest.raises(InputError, match=r"s off a constant rate of .* record it at a constant"):
        source_of(steady(vertical_specific_force=own))


def test_an_accelerometer_with_more_holes_than_samples_is_refused(steady):
    stamps = np.concatenate((np.arange(2000) / 1000.0, 2.0 + np.arange(2000) * 0.0025))
    own = still(stamps)
    message = r"0.0025 s without a sample after time stamp \d+; fill gaps with NaN at"
    with pytest.raises(InputError, match=message):
        source_of(steady(vertical_specific_force=own))


def test_an_accelerometer_that_jitters_is_refused(steady):
    stamps = np.arange(4000) / 1000.0
    stamps[1::2] += 0.0001
    own = still(stamps)
    with pytest.raises(InputError, match=r"999\.975 Hz; record it at a constant rate"):
        source_of(steady(vertical_specific_force=own))


@pytest.mark.parametrize("rate", [1000.0, 3240.0, 4000.0, 16_000.0, 44_100.0, 48_000.0])
def test_unix_stamps_in_microseconds_are_the_rate_they_were_made_at(rate):
    stamps = np.round(1.7e9 + np.arange(5000) / rate, 6)
    own = still(stamps)
    assert float(steady_clock(own).rate) == rate


def test_only_the_time_that_all_channels_cover_is_used(steady):
    late = Channel.of(
        "height", 0.3 + 1e-6 * np.cos(np.arange(3000.0)), UniformClock.of(1000.0, 0.5)
    )
    source = source_of(steady(height=late))
    assert (source.header.origin, source.length) == (0.5, 3000)


def test_channels_that_never_meet_are_refused(steady):
    late = Channel.of("height", np.full(100, 0.3), UniformClock.of(1000.0, 99.0))
    with pytest.raises(InputError, match="no stretch of time in common; check start_s"):
        source_of(steady(height=late))


def test_gnss_samples_are_events_at_their_own_times(steady):
    stamps = StampedClock.of([-1.0, 0.0, 0.05, 0.3004, 3.9, 9.0])
    height = Channel.of("gnss_height", [0, 1, np.nan, 3, 4, 5], stamps)
    quality = Channel.of("gnss_quality", [4, 4, 0, 5, 4, 4], stamps)
    blocks = list(source_of(steady(gnss_height=height, gnss_quality=quality)).blocks(300))
    events = [event for block in blocks for event in block.events]
    assert [event.time_s for event in events] == [0.0, 0.05, 0.3004, 3.9]
    assert events[1].values == {ChannelId("gnss_quality"): 0.0}
    assert events[2].values == {ChannelId("gnss_height"): 3.0, ChannelId("gnss_quality"): 5.0}
    assert len(blocks[1].events) == 1


@laws
@given(rate=st.sampled_from([1.0, 20.0, 333.0]), start=st.integers(-500, 3000))
def test_gnss_of_a_constant_rate_comes_once_each(steady, rate, start):
    clock = UniformClock.of(rate, start / 1000.0)
    height = Channel.of("gnss_height", np.arange(60.0), clock)
    blocks = list(source_of(steady(gnss_height=height)).blocks(170))
    times = [event.time_s for block in blocks for event in block.events]
    inside = [t for t in clock.times(60).tolist() if 0.0 <= t < 4.0 - 1e-12]
    assert times == pytest.approx(inside)


@pytest.mark.parametrize("sample", [8001, 8002, 8003, 8004])
@pytest.mark.parametrize("cut", [700, 2001, 4000])
def test_a_leap_between_two_samples_of_a_slower_accelerometer_is_flagged(steady, sample, cut):
    times = np.arange(20_000) / 4000.0
    travel = 20.0 * times
    travel[sample:] += 1.0
    source = source_of(steady(distance=Channel.of("distance", travel, UniformClock.of(4000))))
    blocks = list(source.blocks(cut))
    flags = flags_of(blocks, DISTANCE)
    values = np.concatenate([block[DISTANCE] for block in blocks])
    behind = int(np.argmax(np.diff(values))) + 1
    found = np.flatnonzero(flags & Flag.SLOW)
    assert behind in found
    assert len(found) <= 2


def test_the_ends_are_those_of_the_encoder_less_than_a_sample_away(steady):
    times = np.arange(16_000) / 4000.0 - 0.0005
    clock = UniformClock.of(4000, -0.0005)
    source = source_of(steady(distance=Channel.of("distance", 3.0 + 20.0 * times, clock)))
    assert source.ends_m[0] == 3.0 + 20.0 * times[0] < source.origin_m
    assert source.ends_m[1] == 3.0 + 20.0 * times[-1] > source.origin_m + source.distance_m


def test_an_encoder_that_goes_on_alone_does_not_move_the_ends(steady):
    times = np.arange(40_000) / 4000.0
    source = source_of(steady(distance=Channel.of("distance", 20.0 * times, UniformClock.of(4000))))
    assert source.ends_m == (source.origin_m, source.origin_m + source.distance_m)
