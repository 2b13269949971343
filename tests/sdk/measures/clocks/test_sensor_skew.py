"""The skew of a height sensor: put into drives and bounces, found again or left open."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.measures.clocks.drives import driven, parts

from floatref.measures.clocks.sensor_skew import (
    Skew,
    Stretch,
    combine_stretches,
    sensor_skew,
    skew_warning,
)
from floatref.measures.clocks.skew_series import RATE_HZ, on_grid
from floatref.measures.clocks.skew_windows import SkewWindow
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

HOLD_S = 0.5 / 3240.0
"""A laser of 3.24 kHz that is held shows what it saw half a hold ago."""
SHIFTS_MS = (-3.0, -1.0, 0.0, 0.3, 1.0, 3.0)


def later(channel: Channel, by_s: float) -> Channel:
    """Return the channel as a clock stamps it that is late by ``by_s``."""
    clock = channel.clock
    assert isinstance(clock, UniformClock)
    return replace(channel, clock=UniformClock(clock.rate, clock.start_s + by_s))


@pytest.mark.slow
@pytest.mark.parametrize("shift_ms", SHIFTS_MS)
@pytest.mark.parametrize(
    ("vehicle", "seed"), [("pickup", 38), ("loaded-van", 30), ("soft-van", 42)]
)
def test_a_shift_is_found_at_a_stop(vehicle: str, seed: int, shift_ms: float) -> None:
    force, height, distance = parts(driven("stop", vehicle, seed))
    height = later(height, shift_ms / 1e3)
    found = sensor_skew(force, height, distance)
    assert found.known
    assert found.skew_s - HOLD_S == pytest.approx(shift_ms / 1e3, abs=2e-4)
    assert found.coherence > 0.999
    warning = skew_warning(found, force, height)
    if shift_ms == 0.0:
        assert warning is None
    if abs(shift_ms) == 3.0:
        assert warning is not None
        assert warning.startswith(f"channel {(height if shift_ms > 0 else force).id}: ")


@pytest.mark.slow
@pytest.mark.parametrize("vehicle", ["loaded-van", "minivan", "pickup", "trailer", "soft-van"])
@pytest.mark.parametrize("seed", [3, 4])
def test_a_stop_says_how_well_it_knows(vehicle: str, seed: int) -> None:
    """Over any road, with the profiler at any place, what is told is as good as it says."""
    force, height, distance = parts(driven("stop", vehicle, seed))
    for shift_ms in (0.0, 3.0):
        found = sensor_skew(force, later(height, shift_ms / 1e3), distance)
        if found.known:
            assert abs(found.skew_s - HOLD_S - shift_ms / 1e3) <= 2.5 * found.sigma_s
        else:
            assert "ms only" in found.reason


@pytest.mark.slow
@pytest.mark.parametrize("laser_ahead_m", [0.105, 0.3, -0.3])
def test_a_laser_away_from_its_accelerometer_leaves_the_skew_open(laser_ahead_m: float) -> None:
    """At a stop it sees the pitching too: the two sensors no longer move as one."""
    found = sensor_skew(*parts(driven("stop", "pickup", 38, laser_ahead_m=laser_ahead_m)))
    assert not found.known
    assert np.isnan(found.skew_s)


@pytest.mark.slow
def test_several_stops_know_more_than_one() -> None:
    one = sensor_skew(*parts(driven("stop", "pickup", 38)))
    more = sensor_skew(*parts(driven("stop", "pickup", 38, stops=3)))
    assert more.seconds > one.seconds
    assert more.skew_s == pytest.approx(HOLD_S, abs=2e-4)


@pytest.mark.parametrize("shift_ms", SHIFTS_MS)
@pytest.mark.parametrize("with_distance", [True, False])
def test_a_bounce_test_shows_half_a_hold_of_the_laser(shift_ms: float, with_distance: bool) -> None:
    """Its distance says 72 km/h, or is not there."""
    force, height, distance = parts(driven("bounce", "loaded-van", 1))
    found = sensor_skew(force, later(height, shift_ms / 1e3), distance if with_distance else None)
    assert found.skew_s == pytest.approx(shift_ms / 1e3 + HOLD_S, abs=2e-5)
    assert found.sigma_s < 5e-5
    assert found.seconds >= 3.0


def test_what_a_sensor_has_of_its_own_moves_nothing() -> None:
    """Another rate, gaps, a scale 1 % off, g and a bias: a bounce still tells it."""
    force, height, distance = parts(driven("bounce", "loaded-van", 2))
    rng = np.random.default_rng(0)
    values = 0.99 * height.values[::5] + 0.05
    values[rng.random(values.size) < 0.02] = np.nan
    values[9000:9200] = np.nan
    times = height.times_s[::5] + 2e-3
    slower = Channel.of("height", values, StampedClock.of(times))
    stronger = replace(force, values=force.values + 0.3)
    found = sensor_skew(stronger, slower, distance)
    assert found.skew_s == pytest.approx(2e-3 + HOLD_S, abs=5e-5)


@pytest.mark.slow
@pytest.mark.parametrize("manoeuvre", ["quiescent", "braking", "constant", "creeping", "near-stop"])
def test_where_the_road_moves_both_nothing_is_told(manoeuvre: str) -> None:
    force, height, distance = parts(driven(manoeuvre, "soft-van", 5))
    for shift_ms in (0.0, 3.0):
        for known in (distance, None):
            found = sensor_skew(force, later(height, shift_ms / 1e3), known)
            assert not found.known
            assert np.isnan(found.skew_s)
            assert "neither a stop" in found.reason
            assert skew_warning(found, force, height) is None


@pytest.mark.parametrize("hz", [0.8, 1.36, 1.38, 1.4, 2.0])
def test_a_road_of_one_wave_is_no_bounce_test(hz: float) -> None:
    # A quarter car near its resonance: height and force agree there but for a quarter of a period.
    s, c, k1, k2, mu = 2j * np.pi * hz, 6.0, 653.0, 63.3, 0.15
    body_and_axle = [[s * s + c * s + k2, -c * s - k2], [-c * s - k2, mu * s * s + c * s + k1 + k2]]
    gain = np.linalg.solve(np.array(body_and_axle), np.array([0, k1]))[0]
    times, clock = np.arange(20_000) / 1000.0, UniformClock.of(1000.0)
    road = 0.01 * np.exp(s * times)
    force = Channel.of("vertical_specific_force", 9.8 + (s * s * gain * road).real, clock)
    height = Channel.of("height", 0.3 + ((gain - 1) * road).real, clock)
    skew = sensor_skew(force, height, Channel.of("distance", 20 * times, clock))
    assert not skew.known


def test_an_encoder_that_fails_makes_no_stop() -> None:
    force, height, distance = parts(driven("constant", "loaded-van", 6))
    failed = replace(distance, values=np.minimum(distance.values, distance.values[8000]))
    assert not sensor_skew(force, height, failed).known


@settings(deadline=None, max_examples=20)
@given(
    rates=st.tuples(st.sampled_from([250.0, 1000.0, 3240.0]), st.sampled_from([400.0, 2000.0])),
    shift_ms=st.floats(-20.0, 20.0),
    hz=st.floats(1.2, 8.0),
    start=st.floats(0.0, 1e4),
    seed=st.integers(0, 2**32 - 1),
)
def test_any_clocks_of_a_swinging_body(rates, shift_ms, hz, start, seed) -> None:
    """A decaying swing in closed form, noise and quanta of usual sensors, rates and jitter."""
    rng = np.random.default_rng(seed)
    slow, fast = rates
    decay, omega, size = 0.5, 2 * np.pi * hz, 0.3 / (2 * np.pi * hz) ** 2 * 10
    taken = np.sort(np.arange(0.0, 6.0, 1 / slow) + rng.uniform(0.0, 0.2 / slow, int(6 * slow)))
    wave = size * np.exp((-decay + 1j * omega) * np.arange(0.0, 6.0, 1 / fast))
    force = 9.9 + ((-decay + 1j * omega) ** 2 * wave).real
    height = 0.3 + (size * np.exp((-decay + 1j * omega) * taken)).real
    force += 5e-5 * fast**0.5 * rng.normal(size=force.size)
    height = 4e-6 * np.round((height + 5e-7 * slow**0.5 * rng.normal(size=height.size)) / 4e-6)
    found = sensor_skew(
        Channel.of("vertical_specific_force", force, UniformClock.of(fast, start)),
        Channel.of("height", height, StampedClock.of(start + taken + shift_ms / 1e3)),
        Channel.of("distance", np.zeros(60), UniformClock.of(10.0, start)),
    )
    assert found.known
    assert abs(found.skew_s - shift_ms / 1e3) <= max(2.5 * found.sigma_s, 1e-4)


@settings(deadline=None, max_examples=20)
@given(
    rate=st.floats(250.0, 5000.0),
    start=st.floats(-10.0, 10.0),
    slope=st.floats(-5.0, 5.0),
    seed=st.integers(0, 2**32 - 1),
)
def test_the_grid_delays_nothing(rate, start, slope, seed) -> None:
    """A straight line is a straight line whatever the clock, with samples missing."""
    rng = np.random.default_rng(seed)
    clock = UniformClock.of(round(rate, 3), start)
    times = clock.times(int(3 * rate))
    values = np.where(rng.random(times.size) < 0.1, np.nan, slope * (times - start))
    grid = start + 0.1 + np.arange(500) / RATE_HZ
    found = on_grid(Channel.of("height", values, clock), grid)
    known = ~np.isnan(found)
    assert known.mean() > 0.8
    assert np.abs(found - slope * (grid - start))[known].max() < 1e-9


@pytest.mark.parametrize(
    ("rate", "seconds", "said"), [(50.0, 60.0, "has 50 Hz"), (1000.0, 1.5, "share less than 2 s")]
)
def test_too_little_is_said(rate: float, seconds: float, said: str) -> None:
    clock = UniformClock.of(rate)
    values = np.sin(clock.times(int(rate * seconds)))
    force = Channel.of("vertical_specific_force", values, clock)
    assert said in sensor_skew(force, Channel.of("height", values, clock)).reason


def test_a_warning_needs_half_a_millisecond_and_three_sigma() -> None:
    clock = UniformClock.of(1000.0)
    force = Channel.of("vertical_specific_force", [0.0], clock, "left")
    height = Channel.of("height", [0.0], clock, "left")
    assert skew_warning(Skew(4.9e-4, 1e-6, 5.0, 1.0), force, height) is None
    assert skew_warning(Skew(1.2e-3, 4.1e-4, 5.0, 1.0), force, height) is None
    line = skew_warning(Skew(-1.2e-3, 1e-4, 5.0, 1.0), force, height)
    assert line == (
        "channel left.vertical_specific_force: 1.20 ± 0.10 ms later than left.height, by 5 s in "
        "which the body alone moved; add 0.00120 to its delay_s"
    )


@pytest.mark.slow
def test_stops_that_disagree_know_less_than_each_alone() -> None:
    """A height that is 3 ms later from the second of three stops on: no skew is that of all."""
    force, height, distance = parts(driven("stop", "pickup", 38, stops=3))
    times = height.times_s
    moved = times + 3e-3 * (times > times[times.size // 2])
    broken = Channel.of("height", height.values, StampedClock.of(moved))
    assert not sensor_skew(force, broken, distance).known


@given(sigma_ms=st.floats(0.01, 2.0), skew_ms=st.floats(-5.0, 5.0))
def test_a_skew_is_open_where_it_is_known_to_half_a_millisecond_only(sigma_ms, skew_ms) -> None:
    """The page says so: a profile at 20 m/s errs by 10 mm of its place then."""
    omega = 10.0
    window = SkewWindow(0, skew_ms / 1e3, 1.0, sigma_ms / 1e3 * omega, 1e-3, omega)
    found = combine_stretches([Stretch([window], 1.0)])
    assert found.known == (sigma_ms <= 0.5)
    assert found.sigma_s == pytest.approx(sigma_ms / 1e3)
