"""The GNSS receiver: height, vertical velocity, attitude and position of its antenna."""

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Setup, Vector
from floatref_conformance.proving_ground.roads.wander import STRAIGHT, Line
from floatref_conformance.proving_ground.sensors.chain import Chain, sample_rows
from floatref_conformance.proving_ground.sensors.noise import gauss_markov, stream

FIRST_S = 0.0125
"""Time of the first fix: the receiver's clock is not the accelerometers'."""
RTK_FIXED = 4.0
START_RAD = (np.radians(45.26), np.radians(-93.71))
"""Latitude and longitude of distance 0; the course starts northward."""
EARTH_RADIUS_M = 6371e3


def gnss_channels(
    chain: Chain, setup: Setup, curvature: float, standing: bool = False, line: Line = STRAIGHT
) -> tuple[Channel, ...]:
    """Return all GNSS channels on the receiver's own time stamps.

    The antenna is as far to the side as the vehicle's line below it; that the body points along a
    wandering line, by milliradians, is left out.

    Args:
        chain: suite, seed and true motion.
        setup: where the antenna and the first track's reference point sit.
        curvature: of the course, left turn positive, in 1/m.
        standing: the vehicle is parked and its distance an artificial encoder's.
        line: that the vehicle drives beside its wheel paths.
    """
    times, at = chain.sample_times(FIRST_S, chain.suite.gnss_rate_hz)
    fixes = times.size
    attitude = _attitude(chain, at)
    antenna = setup.gnss_antenna_offset_m
    reference = next(iter(setup.tracks.values())).reference_point_m
    lever = np.subtract(antenna, reference)
    travel = np.zeros(fixes) if standing else sample_rows(chain.motion.distance, at)
    true = {
        **_vertical(chain, at, attitude, lever),
        "gnss_pitch": attitude[0],
        "gnss_roll": np.arcsin(np.cos(attitude[0]) * np.sin(attitude[1])),
        **_horizontal(travel, line.at(travel), antenna[0], curvature),
    }
    clock = StampedClock.of(times)
    errors = _errors(chain)
    channels = [Channel.of("gnss_quality", np.full(fixes, RTK_FIXED), clock)]
    for name, values in true.items():
        rng = stream(chain.seed, name)
        noise, drift = errors[name]
        values = values + gauss_markov(rng, drift, chain.suite.gnss_drift_s, times)
        channels.append(Channel.of(name, values + noise * rng.standard_normal(fixes), clock))
    return tuple(channels)


def gnss_speed(
    chain: Chain, lever_m: Vector, grade_rad: float = 0.0, standing: bool = False
) -> Channel:
    """Return the antenna's speed over ground on the receiver's time stamps.

    The antenna swings with the body. Speed is the length of a horizontal velocity, both
    components of which have noise: at a stop it is small, but never below 0.

    Args:
        chain: suite, seed and true motion.
        lever_m: antenna from the point about which the body turns, in m.
        grade_rad: of the lane, whose horizontal share is measured; crowns are not taken off.
        standing: the vehicle is parked and its distance an artificial encoder's.
    """
    suite, motion = chain.suite, chain.motion
    times, at = chain.sample_times(FIRST_S, suite.gnss_rate_hz, suite.gnss_speed_latency_s)
    swing = np.cross(sample_rows(motion.rates, at), np.array(lever_m)[:, None], axis=0)
    speed = np.zeros(times.size) if standing else sample_rows(motion.speed, at)
    rng = stream(chain.seed, "gnss_speed")
    ahead, across = suite.gnss_velocity_noise * rng.standard_normal((2, times.size))
    ahead += speed * np.cos(grade_rad) + swing[0]
    across += swing[1]
    return Channel.of("gnss_speed", np.hypot(ahead, across), StampedClock.of(times))


def _attitude(chain: Chain, at: FloatArray) -> FloatArray:
    """Return pitch and roll at fractional samples, shape (2, fixes), in rad."""
    return sample_rows(np.stack([chain.motion.pitch, chain.motion.roll]), at)


def _vertical(
    chain: Chain, at: FloatArray, attitude: FloatArray, lever: FloatArray
) -> dict[str, FloatArray]:
    """Carry height and velocity from the reference point to the antenna, (6.39)."""
    motion = chain.motion
    first = next(iter(motion.tracks.values()))
    height, velocity = sample_rows(np.stack([first.height_m, first.velocity]), at)
    pitch, roll = attitude
    up = np.stack([-np.sin(pitch), np.cos(pitch) * np.sin(roll), np.cos(pitch) * np.cos(roll)])
    whirl = np.cross(sample_rows(motion.rates, at), lever[:, None], axis=0)
    return {
        "gnss_height": height + lever @ up,
        "gnss_vertical_velocity": velocity + np.sum(up * whirl, axis=0),
    }


def _horizontal(
    travel: FloatArray, left: FloatArray, ahead: float, curvature: float
) -> dict[str, FloatArray]:
    """Return latitude and longitude in rad after ``travel`` in m at constant curvature.

    The antenna is ``ahead`` of the course's point in m, and ``left`` of it at every fix.
    """
    heading = curvature * travel
    chord = travel * np.sinc(heading / (2 * np.pi))
    north = chord * np.cos(heading / 2) + ahead * np.cos(heading) - left * np.sin(heading)
    west = chord * np.sin(heading / 2) + ahead * np.sin(heading) + left * np.cos(heading)
    latitude, longitude = START_RAD
    return {
        "gnss_latitude": latitude + north / EARTH_RADIUS_M,
        "gnss_longitude": longitude - west / (EARTH_RADIUS_M * np.cos(latitude)),
    }


def _errors(chain: Chain) -> dict[str, tuple[float, float]]:
    """Return the standard deviations of noise and correlated drift of every channel."""
    suite = chain.suite
    position = suite.gnss_position_drift_m / EARTH_RADIUS_M
    return {
        "gnss_height": (suite.gnss_height_noise_m, suite.gnss_height_drift_m),
        "gnss_vertical_velocity": (suite.gnss_velocity_noise, 0.0),
        "gnss_pitch": (suite.gnss_pitch_noise, suite.gnss_pitch_drift),
        "gnss_roll": (suite.gnss_roll_noise, suite.gnss_roll_drift),
        "gnss_latitude": (0.0, position),
        "gnss_longitude": (0.0, position),
    }
