"""The sensor chain: what the accelerometers, the laser, the encoder and the gyros deliver."""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import UniformClock
from floatref.values.recording import ONLY_TRACK, Channel
from floatref_conformance.proving_ground.sensors.noise import (
    draw_value,
    quantize,
    random_walk,
    stream,
    white,
)
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.vehicles.motion import BodyMotion

SLOWEST_MPS, CALIBRATED_MPS, FASTEST_MPS = 16 / 3.6, 72 / 3.6, 97 / 3.6
"""The speeds between which `radius_growth` is given, and that of the calibration."""
WARM_S = 600.0
"""Time constant in s in which a tyre warms up; no source: ours."""
RATES = ("roll_rate", "pitch_rate", "yaw_rate")


@dataclass(frozen=True, eq=False)
class VerticalError:
    """The slow errors of one vertical accelerometer, as drawn.

    Attributes:
        bias: constant, scale error of 1 g, and random walk, shape (n,), in m/s².
        pitch_rad, roll_rad: tilt of its axis against body Z, nose down and left up.
    """

    bias: FloatArray
    pitch_rad: float
    roll_rad: float


class Chain:
    """The sensors of one run: a suite, a seed, and the true motion they see."""

    def __init__(self, suite: SensorSuite, seed: int, motion: BodyMotion) -> None:
        """Keep what every channel is made from."""
        self.suite = suite
        self.seed = seed
        self.motion = motion
        self.rate_hz = float(motion.clock.rate)
        self.count = motion.distance.size

    def channel(self, name: str, values: FloatArray, track: str | None = None) -> Channel:
        """Return a channel on the accelerometers' clock; the only track has no name."""
        return Channel.of(name, values, self.motion.clock, None if track == ONLY_TRACK else track)

    def vertical(self, track: str, shake: FloatArray | None) -> tuple[Channel, VerticalError]:
        """Return the vertical accelerometer of ``track`` and its slow errors."""
        name = "vertical_specific_force"
        rng = stream(self.seed, f"{track}.{name}")
        pitch = draw_value(rng, self.suite.misalignment_rad)
        roll = draw_value(rng, self.suite.misalignment_rad)
        true = self.motion.tracks[track]
        seen = true.vertical * (np.cos(pitch) * np.cos(roll))
        seen += np.sin(pitch) * np.cos(roll) * true.longitudinal
        seen -= np.sin(roll) * true.lateral
        values, bias = self._accelerometer(rng, seen, shake)
        return self.channel(name, values, track), VerticalError(bias, pitch, roll)

    def horizontal(self, name: str, track: str) -> Channel:
        """Return the longitudinal or lateral accelerometer of ``track``."""
        rng = stream(self.seed, f"{track}.{name}")
        true = self.motion.tracks[track]
        force = true.longitudinal if name.startswith("longitudinal") else true.lateral
        values, _ = self._accelerometer(rng, force.copy(), None)
        return self.channel(name, values, track)

    def shaking(self) -> FloatArray | None:
        """Return the engine's vibration of the mounts, shape (n,), in m/s².

        Its phase is drawn at the start, apart from that of the body's own shake, and closed
        from there on: the speed's share of the engine's speed integrates to distance.
        """
        suite = self.suite
        if suite.vibration == 0.0:
            return None
        turns = suite.revving_hz_per_mps * self.motion.distance
        turns += suite.idle_hz * self.motion.times_s
        turns += stream(self.seed, "vibration").uniform()
        turns *= 2 * np.pi
        np.sin(turns, out=turns)
        turns *= suite.vibration
        return turns

    def _accelerometer(
        self, rng: np.random.Generator, force: FloatArray, shake: FloatArray | None
    ) -> tuple[FloatArray, FloatArray]:
        """Return reading and bias in m/s², a scale error's share of 1 g included.

        ``force`` is given up.
        """
        suite = self.suite
        bias = random_walk(rng, suite.force_walk, self.rate_hz, self.count)
        bias += draw_value(rng, suite.force_bias)
        scale = suite.force_scale * rng.uniform(-1.0, 1.0)
        force *= 1.0 + scale
        if shake is not None:
            force += shake
        force += bias
        if suite.force_noise > 0:
            force += white(rng, suite.force_noise, self.rate_hz, self.count)
        return quantize(force, suite.force_resolution), bias + scale * STANDARD_GRAVITY

    def height(self, track: str) -> Channel:
        """Return the laser of ``track``: its latest sample, held at the accelerometers' rate.

        A sample is as old as the latency when it is recorded; before the start nothing moves.
        """
        suite, true = self.suite, self.motion.tracks[track].range_m
        rng = stream(self.seed, f"{track}.height")
        scale = 1.0 + suite.range_scale * rng.uniform(-1.0, 1.0)
        late = suite.range_latency_s * self.rate_hz
        if suite.range_rate_hz == 0 and late == 0:
            return self.channel("height", true * scale, track)
        ratio = suite.range_rate_hz / self.rate_hz if suite.range_rate_hz else 1.0
        taken = np.arange(int((self.count - 1) * ratio) + 1) / ratio
        if late > 0:
            taken = np.maximum(taken - late, 0.0)
        before = np.minimum(taken.astype(np.intp), self.count - 1)
        after = np.minimum(before + 1, self.count - 1)
        fresh = true[before] + (taken - before) * (true[after] - true[before])
        fresh *= scale
        if suite.range_noise_m > 0:
            fresh += suite.range_noise_m * rng.standard_normal(fresh.size)
        quantize(fresh, suite.range_resolution_m)
        latest = (np.arange(self.count) * ratio).astype(np.intp)
        return self.channel("height", fresh[latest], track)

    def distance(self) -> Channel:
        """Return the encoder: whole counts of a wheel that slips with acceleration."""
        drawn_scale = self.suite.encoder_scale * stream(self.seed, "distance").uniform(-1.0, 1.0)
        return self.channel("distance", self.count_wheel(drawn_scale))

    def count_wheel(self, drawn_scale: float, path: float = 1.0, own: float = 1.0) -> FloatArray:
        """Return the distance that a wheel's encoder counts, shape (n,), in m.

        The slip integrates in closed form: ∫ v·(s·a/g) dt = s·(v² − v₀²)/(2g).

        Args:
            drawn_scale: scale error beside that of the suite.
            path: length of the wheel's path over that of the vehicle.
            own: slip and growth of the wheel over those of the suite.
        """
        suite, motion = self.suite, self.motion
        travel = motion.distance * (path * (1.0 + drawn_scale + suite.encoder_error))
        if suite.slip_per_g > 0:
            gain = motion.speed**2
            gain -= gain[0]
            gain *= own * path * suite.slip_per_g / (2 * STANDARD_GRAVITY)
            travel += gain
        if suite.radius_growth or suite.radius_warming:
            speed = path * motion.speed
            lost = own * self.radius_growth(speed, motion.times_s) * speed
            travel -= (np.cumsum(lost) - (lost + lost[0]) / 2) / self.rate_hz
        return count_steps(travel, suite.encoder_step_m)

    def radius_growth(self, speed: FloatArray, times_s: FloatArray) -> FloatArray:
        """Return the relative growth of a rolling radius at speeds in m/s, shape (n,).

        The radius of a free-rolling tyre grows with its speed of rotation (3.3.9), like the
        centrifugal force: by v². It is calibrated cold, at `CALIBRATED_MPS`.
        """
        grown = self.suite.radius_growth * (speed**2 - CALIBRATED_MPS**2)
        grown /= FASTEST_MPS**2 - SLOWEST_MPS**2
        grown += self.suite.radius_warming * -np.expm1(-times_s / WARM_S)
        return np.asarray(grown)

    def sample_times(
        self, first_s: float, rate_hz: float, late_s: float = 0.0
    ) -> tuple[FloatArray, FloatArray]:
        """Return a slower sensor's times in s, and the samples of the motion that it reads then.

        It starts at ``first_s``; its readings are ``late_s`` old. Before the start nothing moves.
        """
        last_s = (self.count - 1) / self.rate_hz
        times = first_s + np.arange(int(max(0.0, last_s - first_s) * rate_hz) + 1) / rate_hz
        return times, np.maximum(np.minimum(times, last_s) - late_s, 0.0) * self.rate_hz

    def gyros(self) -> tuple[Channel, ...]:
        """Return roll, pitch and yaw rate on the gyros' own clock."""
        suite = self.suite
        clock = UniformClock.of(suite.gyro_rate_hz)
        last_s = (self.count - 1) / self.rate_hz
        times = clock.times(int(last_s * suite.gyro_rate_hz) + 1)
        rates = sample_rows(self.motion.rates, times * self.rate_hz)
        channels = []
        for name, true in zip(RATES, rates, strict=True):
            rng = stream(self.seed, name)
            true += draw_value(rng, suite.gyro_bias)
            true += random_walk(rng, suite.gyro_walk, suite.gyro_rate_hz, times.size)
            true += white(rng, suite.gyro_noise, suite.gyro_rate_hz, times.size)
            channels.append(Channel.of(name, true, clock))
        return tuple(channels)


def count_steps(travel: FloatArray, step_m: float) -> FloatArray:
    """Return ``travel`` in whole encoder counts, made non-decreasing, in place."""
    if step_m > 0:
        travel /= step_m
        np.floor(travel, out=travel)
        travel *= step_m
    return np.asarray(np.maximum.accumulate(travel, out=travel))


def sample_rows(rows: FloatArray, positions: FloatArray) -> FloatArray:
    """Return ``rows``, shape (r, n), at fractional sample indices, linear in between."""
    before = np.minimum(positions.astype(np.intp), rows.shape[-1] - 2)
    weight = positions - before
    return np.asarray(rows[..., before] * (1 - weight) + rows[..., before + 1] * weight)
