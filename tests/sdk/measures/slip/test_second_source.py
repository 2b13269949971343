"""A second source shows by how much the encoder's wheel slips, or shows nothing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.engine.road_distance import UNKNOWN_PER_G, correct_distance
from floatref.measures.slip.encoder_motion import Motion, derivatives
from floatref.measures.slip.knots import OFF, knots_of
from floatref.measures.slip.second_source import find_wheel
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

RATE = 200
laws = settings(deadline=None, max_examples=15)


def brake(slip: float, growth: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return times, true distance and the encoder's of a brake from 20 to 6 m/s, by plain loops."""
    times = np.arange(30 * RATE) / RATE
    true, counted, speed = [0.0], [0.0], 20.0
    for k in range(times.size - 1):
        a = -1.8 * np.sin(np.pi * (times[k] - 10.0) / 12.0) ** 2 if 10.0 < times[k] < 22.0 else 0.0
        step = speed / RATE
        own = 1.0 + slip * a / STANDARD_GRAVITY + growth * ((speed / 20.0) ** 2 - 1.0)
        true.append(true[-1] + step)
        counted.append(counted[-1] + step * own)
        speed += a / RATE
    return times, np.array(true), np.array(counted)


def short_brake(slip: float) -> Recording:
    """Return a brake of 0.56 g from 15.8 to 9.8 m/s, within 1.4 s, and an optical wheel."""
    times = np.arange(30 * RATE) / RATE
    a = -8.6 * np.sin(np.pi * np.clip((times - 10.0) / 1.4, 0.0, 1.0)) ** 2
    speed = 15.8 + np.cumsum(a) / RATE
    true = np.cumsum(speed) / RATE
    counted = np.cumsum(speed * (1.0 + slip * a / STANDARD_GRAVITY)) / RATE
    clock = UniformClock.of(RATE)
    sources = (("distance", counted), ("optical_distance", true))
    return Recording(tuple(Channel.of(name, values, clock) for name, values in sources))


def recorded(slip: float, growth: float, kind: str, late_s: float = 0.0) -> Recording:
    times, true, counted = brake(slip, growth)
    clock = UniformClock.of(RATE)
    channels = [Channel.of("distance", counted, clock)]
    if kind == "optical_distance":
        channels.append(Channel.of(kind, 1.0005 * true, clock))
    elif kind == "gnss_speed":
        own = times[::10]
        speed = np.interp(own - late_s, times, np.gradient(true, times))
        rng = np.random.default_rng(0)
        channels.append(Channel.of(kind, speed + 0.01 * rng.normal(size=own.size),
                                   StampedClock.of(own + 0.003)))  # fmt: skip
    return Recording(tuple(channels))


@pytest.mark.slow
@laws
@given(st.floats(0.01, 0.12), st.floats(-0.01, 0.01))
def test_an_optical_wheel_shows_slip_and_growth(slip: float, growth: float) -> None:
    recording = recorded(slip, growth, "optical_distance")
    distance = recording.channel("distance")
    wheel = find_wheel(recording, distance, Motion.of(distance))
    assert wheel is not None
    assert wheel.slip_per_g == pytest.approx(slip, abs=2e-3)
    assert wheel.growth == pytest.approx(growth, abs=1e-3)
    _, true, _ = brake(slip, growth)
    fixed = correct_distance(recording).recording.channel("distance").values
    assert np.ptp(fixed - true) < 0.02 + 0.1 * np.ptp(distance.values - true)


@laws
@given(st.floats(0.01, 0.12))
def test_one_short_brake_shows_it_though_speed_and_acceleration_are_alike(slip: float) -> None:
    recording = short_brake(slip)
    distance = recording.channel("distance")
    wheel = find_wheel(recording, distance, Motion.of(distance))
    assert wheel is not None
    assert wheel.slip_per_g == pytest.approx(slip, abs=0.005 + 0.05 * slip)


@laws
@given(st.floats(0.05, 0.12), st.floats(0.0, 0.1))
def test_a_late_noisy_speed_by_gnss_shows_it_too(slip: float, late_s: float) -> None:
    recording = recorded(slip, 0.0, "gnss_speed", late_s)
    distance = recording.channel("distance")
    wheel = find_wheel(recording, distance, Motion.of(distance))
    assert wheel is not None
    assert abs(wheel.slip_per_g - slip) < 4.0 * wheel.slip_sigma_per_g < 0.05


@pytest.mark.parametrize("kind", ["none", "optical_distance", "gnss_speed"])
def test_where_there_is_nothing_to_see_nothing_is_changed(kind: str) -> None:
    recording = recorded(0.0, 0.0, kind)
    found = correct_distance(recording)
    assert found.recording is recording
    assert found.record["source"] == "encoder"
    assert found.record["slip_sigma_per_g"] == UNKNOWN_PER_G
    off = (20.0**2 - 9.0**2) / (2.0 * STANDARD_GRAVITY) * UNKNOWN_PER_G
    assert found.record["sigma_m"][0] == 0.0
    assert 0.5 * off < max(found.record["sigma_m"]) < 1.5 * off


@pytest.mark.slow
@laws
@given(st.floats(-0.1, 0.12))
def test_a_given_slip_is_taken_off_whatever_a_second_source_says(slip: float) -> None:
    recording = recorded(slip, 0.0, "optical_distance")
    _, true, _ = brake(slip)
    found = correct_distance(recording, slip)
    fixed = found.recording.channel("distance").values
    assert found.record["source"] == "setting"
    assert np.abs(fixed - true).max() < 0.01 + 0.01 * abs(slip)
    assert (np.diff(fixed) >= 0.0).all()
    assert correct_distance(recording, 0.0).recording is recording


@laws
@given(st.integers(0, 2**32 - 1), st.integers(2, 400))
def test_lines_between_knots_leave_the_series_by_no_more_than_they_may(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    along = np.cumsum(rng.uniform(0.0, 2.0, n))
    values = np.cumsum(rng.normal(size=n))
    kept = knots_of(along, values)
    assert kept[0] == 0
    assert kept[-1] == n - 1
    line = np.interp(along, along[kept], values[kept])
    assert np.abs(line - values).max() <= OFF + 1e-9 or np.diff(along).min() == 0.0


@laws
@given(st.floats(-5.0, 5.0), st.floats(-3.0, 3.0))
def test_derivatives_of_a_parabola_are_exact(speed: float, bend: float) -> None:
    t = 0.05 * np.arange(200)
    first, second = derivatives(speed * t + 0.5 * bend * t**2)
    inner = slice(20, -20)
    np.testing.assert_allclose(first[inner], (speed + bend * t)[inner], atol=1e-9)
    np.testing.assert_allclose(second[inner], bend, atol=1e-7)


def test_a_short_run_or_one_without_readings_moves_nowhere() -> None:
    clock = UniformClock.of(RATE)
    for values in (np.arange(20.0), np.full(4000, np.nan)):
        assert not Motion.of(Channel.of("distance", values, clock)).speed.size
        recording = Recording((Channel.of("distance", values, clock),))
        assert correct_distance(recording, 0.05).recording is recording


@pytest.mark.parametrize("speed", [-100.0, 1e200, 1.7e308])
def test_speeds_that_no_profiler_reaches_are_as_if_missing(speed: float) -> None:
    found = []
    for value in (np.nan, speed):
        recording = recorded(0.03, 0.0, "gnss_speed")
        distance, source = recording.channels
        values = source.values.copy()
        values[[50, 51, 200]] = value
        damaged = Channel.of("gnss_speed", values, source.clock)
        found.append(find_wheel(Recording((distance, damaged)), distance, Motion.of(distance)))
    assert found[0] is not None
    assert found[0] == found[1]
