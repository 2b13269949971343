"""Encoders of both sides, bus, optical wheel and speed over ground: what each loses, and when."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import UniformClock
from floatref.values.recording import Setup, TrackSetup
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.sensors.chain import (
    CALIBRATED_MPS,
    FASTEST_MPS,
    SLOWEST_MPS,
    Chain,
)
from floatref_conformance.proving_ground.sensors.odometry import (
    optical_distance,
    wheel_encoders,
    wheel_speed,
)
from floatref_conformance.proving_ground.sensors.satellite import FIRST_S, gnss_speed
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.vehicles.motion import BodyMotion

IDEAL = replace(SensorSuite.ideal(), encoder_step_m=0.0)
SIDES = {"left": 0.86, "right": -0.86}
SETUP = Setup(tracks={name: TrackSetup((-2.9, y, 0.3)) for name, y in SIDES.items()})
STOP = Scenario(
    road="flat",
    manoeuvre="stop",
    event_at_m=140.0,
    length_m=300.0,
    rate_hz=1000.0,
    tracks=("left", "right"),
)


@pytest.fixture(scope="module")
def stop():
    return simulate(STOP).motion


def encoders(motion, curvature=0.0, seed=0, **errors):
    """Return what the wheels' encoders count, by wheel path."""
    chain = Chain(replace(IDEAL, **errors), seed, motion)
    return {c.id.track: c.values for c in wheel_encoders(chain, SETUP, curvature)}


def cruise(speed, seconds=10.0, rate_hz=1000.0, rates=None):
    """Return the motion of a vehicle at a constant speed in m/s, without wheel paths."""
    times = np.arange(int(seconds * rate_hz)) / rate_hz
    travel = np.stack([speed * times, np.full(times.size, speed), np.zeros(times.size)])
    shared = np.zeros((5, times.size))
    if rates is not None:
        shared[:3] = np.reshape(rates, (3, 1))
    return BodyMotion.of(UniformClock.of(rate_hz), travel, shared, {})


def chain_of(motion, seed=0, **errors):
    return Chain(replace(IDEAL, **errors), seed, motion)


@pytest.mark.parametrize("errors", [{}, {"slip_per_g": 0.06}, {"radius_growth": 0.01}])
def test_on_a_straight_road_both_encoders_equal_the_shared_one(stop, errors):
    shared = chain_of(stop, wheel_spread=0.0, **errors).distance().values
    for counted in encoders(stop, wheel_spread=0.0, **errors).values():
        assert np.array_equal(counted, shared)


@settings(max_examples=20)
@given(curvature=st.floats(-0.05, 0.05))
def test_in_a_curve_they_differ_by_curvature_times_track_times_distance(stop, curvature):
    found = encoders(stop, curvature)
    apart = SIDES["left"] - SIDES["right"]
    lead = found["right"] - found["left"]
    np.testing.assert_allclose(lead, curvature * apart * stop.distance, atol=1e-9)
    middle = (found["right"] + found["left"]) / 2
    np.testing.assert_allclose(middle, stop.distance, atol=1e-9)


@settings(max_examples=20)
@given(slip=st.floats(0.003, 0.12), curvature=st.floats(-0.02, 0.02))
def test_each_wheel_loses_the_slip_of_its_own_brake(stop, slip, curvature):
    """∫ v·s·a/g dt over a brake from v₀ to v is s·(v² − v₀²)/(2g) of the wheel's own path."""
    found = encoders(stop, curvature, slip_per_g=slip, wheel_spread=0.0)
    standing = int(np.argmax(stop.speed == 0.0))
    for name, y in SIDES.items():
        path = 1.0 - curvature * y
        lost = path * stop.distance[standing] - found[name][standing]
        expected = slip * path * stop.speed[0] ** 2 / (2 * STANDARD_GRAVITY)
        assert lost == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("errors", [{"slip_per_g": 0.06}, {"radius_growth": 0.01}])
def test_slip_and_growth_of_both_wheels_differ_by_at_most_their_spread(stop, errors):
    motion = stop if "slip_per_g" in errors else cruise(30.0)
    at = int(np.argmax(stop.speed == 0.0)) if motion is stop else -1

    def lost(counted):
        return motion.distance[at] - counted[at]

    shared = lost(chain_of(motion, **errors).distance().values)
    shares = np.array(
        [
            lost(each) / shared
            for seed in range(40)
            for each in encoders(motion, seed=seed, wheel_spread=0.1, **errors).values()
        ]
    )
    assert 0.9 <= shares.min() < 0.93
    assert 1.07 < shares.max() <= 1.1
    assert np.unique(shares).size == shares.size


def test_the_outer_wheel_turns_faster_and_grows_more():
    motion, growth, curvature = cruise(20.0), 0.01, 0.02
    found = encoders(motion, curvature, radius_growth=growth, wheel_spread=0.0)
    for name, y in SIDES.items():
        path = 1.0 - curvature * y
        grown = growth * ((20.0 * path) ** 2 - CALIBRATED_MPS**2)
        grown /= FASTEST_MPS**2 - SLOWEST_MPS**2
        assert found[name][-1] == pytest.approx(path * (1 - grown) * motion.distance[-1], rel=1e-9)


def test_the_bus_speaks_in_steps_ten_times_a_second_and_is_silent_when_slow(stop):
    channel = wheel_speed(Chain(replace(SensorSuite(), slip_per_g=0.0), 3, stop))
    assert np.diff(channel.times_s) == pytest.approx(0.1)
    counts = channel.values * 3.6 * 256
    assert counts == pytest.approx(np.rint(counts), abs=1e-9)
    assert np.unique(counts).size > 50
    true = np.interp(channel.times_s - 0.05, stop.times_s, stop.speed)
    slow, fast = true < 0.98 * 2 / 3.6, true > 1.02 * 2 / 3.6
    assert slow.sum() > 40
    assert not channel.values[slow].any()
    assert channel.values[fast].min() > 0.5
    assert channel.values[fast] == pytest.approx(true[fast], rel=0.012)


@pytest.mark.parametrize(
    ("errors", "ratio"),
    [
        ({"slip_per_g": 0.06}, 1.0),
        ({"radius_growth": 0.01}, 1 - 0.01 * (35.0**2 - 20.0**2) / ((97**2 - 16**2) / 3.6**2)),
    ],
)
def test_the_bus_has_the_slip_and_the_radius_of_the_wheel(stop, errors, ratio):
    speed = wheel_speed(chain_of(cruise(35.0), **errors)).values
    assert speed == pytest.approx(35.0 * ratio, rel=1e-12)
    if "slip_per_g" in errors:
        braking = wheel_speed(chain_of(stop, **errors))
        true = np.interp(braking.times_s, stop.times_s, stop.speed)
        force = np.interp(braking.times_s, stop.times_s, stop.acceleration)
        expected = true * (1 + 0.06 * force / STANDARD_GRAVITY)
        assert braking.values == pytest.approx(expected, abs=0.01)


def test_the_bus_is_late_by_half_its_cycle(stop):
    late = wheel_speed(chain_of(stop, bus_delay_s=0.05))
    true = np.interp(np.maximum(late.times_s - 0.05, 0.0), stop.times_s, stop.speed)
    assert late.values == pytest.approx(true, abs=1e-9)


def test_the_optical_wheel_does_not_slip_and_counts_two_millimetres(stop):
    suite = replace(SensorSuite(), slip_per_g=0.12, radius_growth=0.01)
    values = optical_distance(Chain(suite, 1, stop)).values
    assert (np.diff(values) >= 0).all()
    counts = values / 2e-3
    assert counts == pytest.approx(np.rint(counts), abs=1e-6)
    assert np.abs(values - stop.distance).max() < 1e-3 * stop.distance[-1] + 0.1
    ideal = optical_distance(chain_of(stop, slip_per_g=0.12, radius_growth=0.01)).values
    assert np.array_equal(ideal, stop.distance)


def test_its_walk_spreads_with_the_root_of_distance():
    motion = cruise(20.0)
    walks = [
        optical_distance(chain_of(motion, seed, optical_walk=1e-3)).values - motion.distance
        for seed in range(200)
    ]
    for at in (4000, 9999):
        spread = np.std([walk[at] for walk in walks])
        assert spread == pytest.approx(1e-3 * motion.distance[at] ** 0.5, rel=0.2)


@pytest.mark.parametrize("seed", range(3))
def test_speed_over_ground_integrates_to_the_true_distance_within_its_noise(stop, seed):
    channel = gnss_speed(chain_of(stop, seed, gnss_velocity_noise=0.03), (0.0, 0.0, 0.0))
    inside = (channel.times_s > 0.025) & (channel.times_s < stop.times_s[-1] - 0.025)
    moving = inside & (channel.values > 1.0)
    travelled = np.sum(channel.values[moving]) / 20.0
    # Every reading stands for the 50 ms around it.
    times = channel.times_s[moving]
    ways = np.interp([times - 0.025, times + 0.025], stop.times_s, stop.distance)
    noise = 0.03 * 0.05 * np.sqrt(moving.sum())
    assert travelled == pytest.approx(np.sum(ways[1] - ways[0]), abs=4 * noise + 0.01)


def test_at_a_stop_it_is_noise_that_is_never_negative(stop):
    channel = gnss_speed(Chain(SensorSuite(), 5, stop), (0.0, 0.0, 0.0))
    still = np.interp(channel.times_s - 0.025, stop.times_s, stop.speed) == 0.0
    values = channel.values[still]
    assert values.min() >= 0.0
    assert np.mean(values**2) == pytest.approx(2 * 0.03**2, rel=0.35)


def test_it_is_late_by_half_an_interval_and_horizontal(stop):
    late = gnss_speed(chain_of(stop, gnss_speed_latency_s=0.025), (0.0, 0.0, 0.0), 0.1)
    assert late.times_s[0] == FIRST_S
    true = np.interp(np.maximum(late.times_s - 0.025, 0.0), stop.times_s, stop.speed)
    assert late.values == pytest.approx(np.cos(0.1) * true, abs=1e-12)


@given(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3), st.floats(-0.3, 0.3))
def test_the_antenna_swings_with_the_body(roll, pitch, yaw):
    """The velocity of a point of a turning body: v + ω × r."""
    motion = cruise(5.0, seconds=1.0, rates=(roll, pitch, yaw))
    found = gnss_speed(chain_of(motion), (-1.0, 0.5, 2.0)).values
    expected = np.hypot(5.0 + pitch * 2.0 - yaw * 0.5, yaw * -1.0 - roll * 2.0)
    assert found == pytest.approx(expected)
