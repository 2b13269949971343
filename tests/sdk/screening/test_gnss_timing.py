"""GNSS on another time base: found by its span, else by when it sees the body swing."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.screening.gnss_height import gnss_faults
from floatref.screening.imu_and_gnss import ImuUse, check_kinematics
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground import Scenario, simulate


@cache
def driven(seed: int = 0) -> Recording:
    numbers = {"seed": seed, "rate_hz": 1000.0, "length_m": 900.0, "iri_m_per_km": 4.0}
    return simulate(Scenario.from_dict({**numbers, "vehicle": "soft-van"})).recording


def gnss(recording: Recording, change: Callable[[Channel], Channel]) -> Recording:
    channels = (change(c) if c.id.name.startswith("gnss_") else c for c in recording.channels)
    return replace(recording, channels=tuple(channels))


def stamped(by_s: float) -> Callable[[Channel], Channel]:
    return lambda c: replace(c, clock=StampedClock.of(c.times_s + by_s))


def checked(recording: Recording) -> tuple[str, ...]:
    use = ImuUse(("left",), gnss=True, attitude=True)
    return check_kinematics(recording, use, gnss_faults(recording))


@pytest.mark.slow
@settings(deadline=None, max_examples=12)
@given(seed=st.integers(0, 2), by_s=st.sampled_from([-0.4, -0.2, -0.1, 0.1, 0.25, 0.45]))
def test_a_delay_is_told_with_its_size_and_nothing_else_is_blamed(seed: int, by_s: float) -> None:
    """Half a swing of the body late looks like an inverted sign, but for its beginning and end."""
    line, *others = checked(gnss(driven(seed), stamped(by_s)))
    side = "late" if by_s > 0 else "early"
    assert line.startswith("channel gnss_height: GNSS sees the body swing ")
    assert f"s too {side} for the IMU; add " in line
    delay_s = float(line.split("add ")[1].split(" s")[0])
    assert delay_s == pytest.approx(-by_s, abs=0.03)
    assert others == []


@pytest.mark.slow
@pytest.mark.parametrize("by_s", [-18.0, 3.0, 12.5])
def test_seconds_are_refused(by_s: float) -> None:
    with pytest.raises(InputError, match=rf"add {-by_s:.1f}\d* s to its time stamps \(UTC and"):
        checked(gnss(driven(), stamped(by_s)))


@settings(deadline=None, max_examples=20)
@given(by_s=st.one_of(st.floats(50.0, 1e10), st.floats(-1e10, -50.0)))
def test_another_epoch_is_refused_with_both_spans(by_s: float) -> None:
    recording = gnss(driven(), stamped(by_s))
    begin, end = recording.channel("gnss_height").span_s
    with pytest.raises(InputError, match="are of another epoch or in another unit") as caught:
        checked(recording)
    line = str(caught.value)
    assert f"from {begin:.9g} s to {end:.9g} s, but the run lasts from 0 s to 45 s" in line
    advised = float(line.split("a shift of ")[1].split(" s")[0])
    moved = gnss(recording, stamped(advised)).channel("gnss_height").span_s[0]
    assert moved == pytest.approx(0.0, abs=1e-8 * abs(by_s) + 0.02)


def test_half_a_run_without_gnss_is_told() -> None:
    def cut(channel: Channel) -> Channel:
        few = channel.values.size // 3
        return replace(
            channel, values=channel.values[:few], clock=StampedClock.of(channel.times_s[:few])
        )

    epoch, fixed = checked(gnss(driven(), cut))
    assert "only 14.9" in epoch
    assert "of it are covered" in epoch
    assert fixed.startswith("channel gnss_height: no RTK-fixed reading for 30.")


@settings(deadline=None, max_examples=5)
@given(origin=st.sampled_from([-1e6, 17.25, 1.7e9]))
def test_the_origin_of_time_is_arbitrary(origin: float) -> None:
    def moved(channel: Channel) -> Channel:
        clock = channel.clock
        if isinstance(clock, UniformClock):
            return replace(channel, clock=UniformClock(clock.rate, clock.start_s + origin))
        return replace(channel, clock=StampedClock.of(clock.times_s + origin))

    recording = driven()
    shifted = replace(recording, channels=tuple(moved(c) for c in recording.channels))
    assert checked(shifted) == checked(recording) == ()


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_velocity_that_is_positive_down_is_refused(seed: int) -> None:
    def down(channel: Channel) -> Channel:
        return (
            replace(channel, values=-channel.values) if "velocity" in channel.id.name else channel
        )

    with pytest.raises(InputError, match=r"^channel gnss_vertical_velocity: the sign is inverted"):
        checked(gnss(driven(seed), down))


def test_a_slow_receiver_is_checked_like_a_fast_one() -> None:
    """Two readings a second still show a nose-up pitch."""

    def slow(channel: Channel) -> Channel:
        values = -channel.values if channel.id.name == "gnss_pitch" else channel.values
        return replace(channel, values=values[::10], clock=StampedClock.of(channel.times_s[::10]))

    with pytest.raises(InputError, match=r"gnss_pitch: turn against each other"):
        checked(gnss(driven(), slow))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_a_receiver_too_slow_to_follow_the_body_tells_no_delay(seed: int) -> None:
    """One reading a second fits several swings."""

    def slow(channel: Channel) -> Channel:
        return replace(
            channel,
            values=channel.values[::20],
            clock=StampedClock.of(channel.times_s[::20] + 5.4),
        )

    (line,) = checked(gnss(driven(seed), slow))
    assert line.startswith("channel gnss_height: no RTK-fixed reading for 5.4")


def test_readings_that_are_missing_are_no_readings() -> None:
    def lost(channel: Channel) -> Channel:
        values = channel.values.copy()
        values[np.arange(values.size) % 3 > 0] = np.nan
        return replace(channel, values=values)

    assert checked(gnss(driven(), lost)) == ()
