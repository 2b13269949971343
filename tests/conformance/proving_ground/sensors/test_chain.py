"""What encoder and laser lose: slip, rolling radius, latency and their integrals."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import UniformClock
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.sensors.chain import (
    CALIBRATED_MPS,
    FASTEST_MPS,
    SLOWEST_MPS,
    WARM_S,
    Chain,
)
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.vehicles.motion import BodyMotion

IDEAL = replace(SensorSuite.ideal(), encoder_step_m=0.0)
STOP = Scenario(
    road="flat",
    manoeuvre="stop",
    event_at_m=140.0,
    length_m=300.0,
    rate_hz=1000.0,
    tracks=("left",),
)


@pytest.fixture(scope="module")
def stop():
    return simulate(STOP).motion


def lost(motion, **errors):
    """Return by how much the encoder reads too little, shape (n,), in m."""
    chain = Chain(replace(IDEAL, **errors), 0, motion)
    return motion.distance - chain.distance().values


@settings(max_examples=20)
@given(slip=st.floats(0.003, 0.12))
def test_slip_loses_the_integral_of_speed_times_deceleration(stop, slip):
    rate = stop.speed * -stop.acceleration * slip / STANDARD_GRAVITY
    expected = np.concatenate([[0.0], np.cumsum(rate[1:] + rate[:-1]) / 2000.0])
    np.testing.assert_allclose(lost(stop, slip_per_g=slip), expected, atol=2e-3)


@pytest.mark.parametrize("percent", [3.0, 12.0])
def test_over_a_stop_what_the_brake_loses_the_launch_wins(percent):
    """3.3.9: the largest distortion is around the stop, and the two effects nearly cancel."""
    motion = simulate(replace(STOP, final_speed_kmh=72.0, length_m=500.0)).motion
    found = lost(motion, slip_per_g=percent / 100)
    expected = percent / 100 * 20.0**2 / (2 * STANDARD_GRAVITY)
    assert found.max() == pytest.approx(expected, rel=1e-3)
    assert abs(found[-1]) < 0.02 * expected


def test_braking_from_48_to_24_kmh_loses_0_8_m_at_12_percent_per_g():
    """3.3.9 prints 0.8 m for figure 3.15: 12 % per g."""
    drive = replace(STOP, manoeuvre="braking", speed_kmh=48.0, event_speed_kmh=24.0)
    motion = simulate(replace(drive, final_speed_kmh=24.0)).motion
    assert lost(motion, slip_per_g=0.12)[-1] == pytest.approx(0.8, abs=0.03)


def cruise(speed, seconds=2.0, rate_hz=1000.0):
    """Return the motion of a vehicle at a constant speed in m/s, without wheel paths."""
    times = np.arange(int(seconds * rate_hz)) / rate_hz
    travel = np.stack([speed * times, np.full(times.size, speed), np.zeros(times.size)])
    return BodyMotion.of(UniformClock.of(rate_hz), travel, np.zeros((5, times.size)), {})


def scale_at(speed, **errors):
    """Return the relative error of the encoder at a constant speed in m/s."""
    motion = cruise(speed)
    return -lost(motion, **errors)[-1] / motion.distance[-1]


@given(growth=st.floats(-0.02, 0.02), speed=st.floats(SLOWEST_MPS, FASTEST_MPS))
def test_the_radius_grows_from_16_to_97_kmh_and_is_calibrated_at_72(growth, speed):
    slow, fast = (scale_at(v, radius_growth=growth) for v in (SLOWEST_MPS, FASTEST_MPS))
    assert slow - fast == pytest.approx(growth, abs=1e-9)
    assert scale_at(CALIBRATED_MPS, radius_growth=growth) == pytest.approx(0.0, abs=1e-9)
    between = sorted([slow, fast])
    assert between[0] - 1e-9 <= scale_at(speed, radius_growth=growth) <= between[1] + 1e-9


def test_a_warm_tyre_counts_less_by_what_its_radius_has_grown():
    motion = cruise(20.0, seconds=4 * WARM_S, rate_hz=1.0)
    found = np.diff(lost(motion, radius_warming=0.01)) / np.diff(motion.distance)
    expected = 0.01 * -np.expm1(-(motion.times_s[1:] - 0.5) / WARM_S)
    np.testing.assert_allclose(found, expected, atol=1e-6)


@settings(max_examples=20)
@given(latency=st.floats(0.0, 0.01), rate=st.sampled_from([0.0, 300.0]))
def test_a_late_laser_reads_what_was_there_before(stop, latency, rate):
    """Held samples are late by up to one of their intervals more."""
    suite = replace(IDEAL, range_latency_s=latency, range_rate_hz=rate)
    found = Chain(suite, 0, stop).height("left").values
    true, times = stop.tracks["left"].range_m, stop.times_s
    taken = np.floor(times * rate + 1e-9) / rate if rate else times
    expected = np.interp(np.maximum(taken - latency, 0.0), times, true)
    np.testing.assert_allclose(found, expected, atol=1e-6)


@pytest.mark.parametrize("ahead", [-0.3, 0.105])
def test_a_laser_ahead_of_the_accelerometer_sees_the_road_there(ahead):
    """A bump comes under it earlier by that much; the setup says where the laser is."""
    drive = replace(STOP, manoeuvre="constant", bump_mm=20.0, bump_at_m=100.0, sensors=0.0)
    tops = []
    for offset in (0.0, ahead):
        made = simulate(replace(drive, laser_ahead_m=offset))
        tops.append(made.truth.distance_m[np.argmax(made.truth.track("left").elevation)])
        assert made.recording.setup.tracks["left"].laser_offset_m == (offset, 0.0, 0.0)
    assert tops[0] - tops[1] == pytest.approx(ahead, abs=0.02)
