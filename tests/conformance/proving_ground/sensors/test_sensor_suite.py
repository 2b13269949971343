"""Laws of the sensor chain: each error is as large as the suite says, and alone."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY as G
from floatref.values.clock import UniformClock
from floatref.values.recording import Setup, TrackSetup
from floatref_conformance.proving_ground.sensors.chain import Chain, count_steps
from floatref_conformance.proving_ground.sensors.noise import (
    draw_value,
    gauss_markov,
    quantize,
    random_walk,
    stream,
    white,
)
from floatref_conformance.proving_ground.sensors.satellite import gnss_channels
from floatref_conformance.proving_ground.sensors.sensor_suite import UNSCALED, SensorSuite
from floatref_conformance.proving_ground.vehicles.motion import BodyMotion, TrackMotion

IDEAL = SensorSuite.ideal()
OPTIONAL = ("encoder_error", "range_latency_s", "radius_growth", "radius_warming")
"""Errors that the default suite does not have."""
SETUP = Setup(
    gnss_antenna_offset_m=(-1.0, 0.2, 2.4), tracks={"left": TrackSetup((-2.9, 0.86, 0.3))}
)


def moved(count: int, rate: float = 16000.0, **rows: FloatArray) -> BodyMotion:
    """Return a motion that is zero but for ``rows``, at 20 m/s and with g on the vertical."""
    still = np.zeros(count)
    point = {
        "longitudinal": still,
        "lateral": still,
        "vertical": np.full(count, G),
        "range_m": np.full(count, 0.3),
        "height_m": np.full(count, 0.3),
        "velocity": still,
        "acceleration": still,
        "road_m": still,
    }
    point.update({name: rows.pop(name) for name in list(rows) if name in point})
    clock = UniformClock.of(rate)
    whole = {
        "distance": 20.0 * clock.times(count),
        "speed": np.full(count, 20.0),
        "acceleration_x": still,
        "rates": np.zeros((3, count)),
        "pitch": still,
        "roll": still,
    } | rows
    return BodyMotion(clock, *whole.values(), tracks={"left": TrackMotion(**point)})


def test_ideal_sensors_tell_the_truth() -> None:
    t = np.arange(5000) / 16000
    motion = moved(5000, vertical=G + np.sin(t), lateral=np.cos(t), range_m=0.3 + 0.1 * t)
    chain, true = Chain(IDEAL, 1, motion), motion.tracks["left"]
    assert np.array_equal(chain.vertical("left", chain.shaking())[0].values, true.vertical)
    assert np.array_equal(chain.horizontal("lateral_specific_force", "left").values, true.lateral)
    assert np.array_equal(chain.height("left").values, true.range_m)
    assert np.array_equal(chain.distance().values, motion.distance)


def test_scaling_is_linear_and_leaves_rates_alone() -> None:
    suite = SensorSuite()
    larger = suite.scale(3.0)
    for name, value in vars(suite).items():
        assert getattr(larger, name) == pytest.approx(value if name in UNSCALED else 3 * value)
        assert value > 0 or name in OPTIONAL


@pytest.mark.parametrize("rate", [1000.0, 16000.0])
def test_noise_has_its_density_at_any_rate(rate: float) -> None:
    """Averaged over one second, white noise of density S leaves S, whatever the rate."""
    seconds, density = 200, 0.01
    noise = white(stream(1, "x"), density, rate, int(seconds * rate))
    means = noise.reshape(seconds, -1).mean(axis=1)
    assert means.std() == pytest.approx(density, rel=0.2)
    assert noise.std() == pytest.approx(density * rate**0.5, rel=0.02)


def test_table_6_1_is_met_at_its_rates() -> None:
    """6e-4 g of a 16-kHz sample and 0.0077 deg/s of a 100-Hz sample."""
    suite = SensorSuite()
    assert suite.force_noise * 16000**0.5 == pytest.approx(6e-4 * G)
    assert np.degrees(suite.gyro_noise) * 100**0.5 == pytest.approx(7.7e-3)


@pytest.mark.parametrize("rate", [100.0, 16000.0])
def test_random_walk_spreads_with_the_root_of_time(rate: float) -> None:
    ends = [random_walk(stream(k, "w"), 0.5, rate, int(4 * rate))[-1] for k in range(300)]
    assert np.std(ends) == pytest.approx(0.5 * 2.0, rel=0.15)
    assert random_walk(stream(0, "w"), 0.5, rate, 10)[0] == 0.0


def test_correlated_drift_is_stationary_and_forgets_with_its_time_constant() -> None:
    times = np.arange(200_000) / 20.0
    drift = gauss_markov(stream(5, "d"), 0.01, 10.0, times)
    assert drift.std() == pytest.approx(0.01, rel=0.15)
    later = np.corrcoef(drift[:-200], drift[200:])[0, 1]
    assert later == pytest.approx(np.exp(-1.0), abs=0.1)


@settings(deadline=None, max_examples=50)
@given(seed=st.integers(0, 2**62), nominal=st.floats(1e-6, 1.0))
def test_drawn_errors_never_vanish(seed: int, nominal: float) -> None:
    assert 0.5 <= abs(draw_value(stream(seed, "b"), nominal)) / nominal <= 1.5


@settings(deadline=None, max_examples=50)
@given(values=st.lists(st.floats(-10, 10), min_size=1, max_size=20), step=st.floats(1e-4, 0.5))
def test_quantized_values_are_the_nearest_multiples(values: list[float], step: float) -> None:
    exact = np.array(values)
    rounded = quantize(exact.copy(), step)
    assert np.abs(rounded - exact).max() <= step / 2 * (1 + 1e-9)
    assert rounded / step == pytest.approx(np.rint(rounded / step), abs=1e-9)


def test_streams_depend_on_seed_and_channel_alone() -> None:
    draws = {key: stream(*key).standard_normal() for key in ((1, "a"), (1, "b"), (2, "a"))}
    assert len(set(draws.values())) == 3
    assert stream(1, "a").standard_normal() == draws[1, "a"]


def test_laser_holds_its_latest_sample() -> None:
    """3240 samples a second, each delivered until the next, never from the future."""
    count = 16000
    t = np.arange(count) / 16000
    motion = moved(count, range_m=0.3 + t)
    suite = replace(IDEAL, range_rate_hz=3240.0)
    height = Chain(suite, 0, motion).height("left").values
    assert np.unique(height).size == 3240
    age = motion.tracks["left"].range_m - height
    assert age.min() >= -1e-12
    assert age.max() < 1 / 3240 + 1e-12


def test_laser_slower_than_the_recording_or_faster_reads_the_same_road() -> None:
    t = np.arange(1000) / 1000
    motion = moved(1000, 1000.0, range_m=0.3 + 0.01 * np.sin(2 * np.pi * t))
    height = Chain(replace(IDEAL, range_rate_hz=3240.0), 0, motion).height("left").values
    assert np.abs(height - motion.tracks["left"].range_m).max() < 0.01 * 2 * np.pi / 3240 * 1.01


def test_vertical_errors_are_reported_as_drawn() -> None:
    """Over a tilted axis the longitudinal force leaks in as its sine."""
    count = 16000
    motion = moved(count, longitudinal=np.full(count, -3.0), lateral=np.full(count, 0.5))
    suite = replace(IDEAL, force_bias=0.005, force_walk=1e-4, misalignment_rad=0.004)
    channel, error = Chain(suite, 9, motion).vertical("left", None)
    axis = (
        np.sin(error.pitch_rad) * np.cos(error.roll_rad),
        -np.sin(error.roll_rad),
        np.cos(error.pitch_rad) * np.cos(error.roll_rad),
    )
    expected = -3.0 * axis[0] + 0.5 * axis[1] + G * axis[2] + error.bias
    assert channel.values == pytest.approx(expected, abs=1e-12)
    assert 0.002 <= abs(error.pitch_rad) <= 0.006


def test_engine_shakes_at_idle_and_revs_with_speed() -> None:
    count, suite = 160_000, replace(IDEAL, vibration=0.02)
    for speed, hertz in ((0.0, 820 / 60), (20.0, 820 / 60 + 20.0)):
        motion = moved(count, distance=speed * np.arange(count) / 16000)
        shake = Chain(suite, 0, motion).shaking()
        assert shake is not None
        spectrum = np.abs(np.fft.rfft(shake))
        assert np.argmax(spectrum) / 10.0 == pytest.approx(hertz, abs=0.1)
        assert np.abs(shake).max() == pytest.approx(0.02, rel=1e-3)


def test_vibration_of_the_mount_has_any_phase_against_the_body() -> None:
    """Over the seeds it neither adds to the engine's true shake nor takes from it."""
    turns = 2 * np.pi * np.arange(16000) * (820 / 60) / 16000
    motion, phases = moved(16000, distance=np.zeros(16000)), []
    for seed in range(60):
        shake = Chain(replace(IDEAL, vibration=1.0), seed, motion).shaking()
        assert shake is not None
        phases.append(np.angle(np.sum(shake * np.exp(-1j * turns))))
    assert abs(np.mean(np.exp(1j * np.array(phases)))) < 0.35
    assert np.histogram(phases, bins=6, range=(-np.pi, np.pi))[0].min() > 0


@settings(deadline=None, max_examples=30)
@given(steps=st.lists(st.floats(-1e-9, 0.01), min_size=2, max_size=60))
def test_counts_never_fall_and_lag_by_less_than_one(steps: list[float]) -> None:
    travel = np.cumsum(np.abs(steps))
    counts = count_steps(travel.copy(), 0.3e-3)
    assert np.all(np.diff(counts) >= 0)
    assert np.all((travel - counts > -1e-9) & (travel - counts < 0.3e-3 + 1e-9))


@pytest.mark.slow
def test_encoder_slips_with_acceleration() -> None:
    """Against the integral of speed times (1 + slip per g · a / g), by quadrature."""
    t = np.arange(56000) / 16000
    speed, a_x = 20.0 - 1.5 * t**2, -3.0 * t
    travelled = 20.0 * t - 0.5 * t**3
    motion = moved(t.size, distance=travelled, speed=speed, acceleration_x=a_x)
    suite = replace(IDEAL, slip_per_g=0.03)
    flow = speed * (1 + 0.03 * a_x / G)
    expected = np.concatenate([[0.0], np.cumsum((flow[1:] + flow[:-1]) / 2)]) / 16000
    assert Chain(suite, 0, motion).distance().values == pytest.approx(expected, abs=1e-6)


def test_gyros_speak_on_their_own_clock() -> None:
    t = np.arange(16000) / 16000
    rates = np.stack([0.1 * t, 0.2 * t, -0.3 * t])
    roll, pitch, yaw = Chain(IDEAL, 0, moved(16000, rates=rates)).gyros()
    assert roll.clock == UniformClock.of(100.0)
    for channel, slope in ((roll, 0.1), (pitch, 0.2), (yaw, -0.3)):
        assert channel.values == pytest.approx(slope * channel.times_s, abs=1e-12)


def test_gnss_tells_height_velocity_and_attitude_of_its_antenna() -> None:
    """Height of the lever arm in exact sines, its velocity by differencing."""
    t = np.arange(32000) / 16000
    pitch, roll = 0.05 * np.sin(2 * t), 0.03 * np.cos(3 * t)
    pitch_rate, roll_rate = 0.1 * np.cos(2 * t), -0.09 * np.sin(3 * t)
    rates = np.stack([roll_rate, pitch_rate * np.cos(roll), -pitch_rate * np.sin(roll)])
    motion = moved(32000, pitch=pitch, roll=roll, rates=rates)
    channels = {c.id.name: c for c in gnss_channels(Chain(IDEAL, 0, motion), SETUP, 0.0)}
    at = channels["gnss_height"].times_s
    lever = np.array([-1.0 + 2.9, 0.2 - 0.86, 2.4 - 0.3])

    def height(times: FloatArray) -> FloatArray:
        theta, phi = 0.05 * np.sin(2 * times), 0.03 * np.cos(3 * times)
        up = [-np.sin(theta), np.cos(theta) * np.sin(phi), np.cos(theta) * np.cos(phi)]
        return np.asarray(0.3 + lever @ np.stack(up))

    assert np.diff(at) == pytest.approx(np.full(at.size - 1, 0.05))
    assert channels["gnss_height"].values == pytest.approx(height(at), abs=1e-8)
    slope = (height(at + 1e-5) - height(at - 1e-5)) / 2e-5
    assert channels["gnss_vertical_velocity"].values == pytest.approx(slope, abs=1e-7)
    phi = 0.03 * np.cos(3 * at)
    expected = np.arcsin(np.cos(0.05 * np.sin(2 * at)) * np.sin(phi))
    assert channels["gnss_roll"].values == pytest.approx(expected, abs=1e-8)
    assert np.all(channels["gnss_quality"].values == 4.0)
    assert np.all(np.diff(channels["gnss_latitude"].values) > 0)
