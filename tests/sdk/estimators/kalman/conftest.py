"""Drives of a vehicle whose sensors tell its motion but for their errors, and ways to run them."""

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from floatref.estimators.kalman.inputs import GNSS, IMU, QUALITY
from floatref.values.block import Axis, Block, Event, Header
from floatref.values.channels import ChannelId
from floatref.values.recording import Setup, TrackSetup
from floatref_reference.chapter_6.section_6_3_6_system import h as measured
from floatref_reference.chapter_6.section_6_4_4_tuning import per_step
from floatref_reference.chapter_6.section_6_5_implementation import kalman_filter

G = 9.80665
ORIGIN_S = 17.25
POINT = (0.3, -0.2, 0.1)
FORWARD, SIDE, *RATES = (ChannelId(name) for name in IMU)
UP, HEIGHT = ChannelId("vertical_acceleration", "left"), ChannelId("height", "left")
DISTANCE, SPEED = ChannelId("distance"), ChannelId("travel_speed")


@dataclass(frozen=True, eq=False)
class Drive:
    """What the sensors of one wheel path read, and the state of (C.2) that is true.

    ``u``, shape (n, 6), has gravity; row k of ``y``, shape (m, 4), is read at sample ``at[k]``.
    """

    rate: int
    u: np.ndarray
    x: np.ndarray
    speed: np.ndarray
    height: np.ndarray
    at: np.ndarray
    y: np.ndarray
    quality: np.ndarray
    lever: np.ndarray

    @property
    def dt(self):
        return 1.0 / self.rate

    @property
    def distance(self):
        return np.concatenate(([0.0], np.cumsum(self.speed[:-1]))) / self.rate

    @property
    def header(self):
        channels = frozenset({FORWARD, SIDE, UP, *RATES, HEIGHT, DISTANCE, SPEED})
        antenna = tuple(np.add(POINT, self.lever).tolist())
        setup = Setup(gnss_antenna_offset_m=antenna, tracks={"left": TrackSetup(POINT)})
        rate = Fraction(self.rate)
        return Header(Axis.TIME, self.dt, ORIGIN_S, rate, channels, ("left",), setup)

    def blocks(self, cuts=()):
        """Return the drive cut before each of the samples ``cuts``, which may be at its ends."""
        forward, side, up, *rates = self.u.T
        values = {FORWARD: forward, SIDE: side, UP: up - G, **dict(zip(RATES, rates, strict=True))}
        values |= {HEIGHT: self.height, DISTANCE: self.distance, SPEED: self.speed}
        return [
            Block(a, {c: v[a:b].copy() for c, v in values.items()}, events=self.events(a, b))
            for a, b in pairwise([0, *sorted(cuts), len(self.u)])
        ]

    @property
    def times_s(self):
        """Times of the readings, some before and some behind the sample next to them."""
        return (self.at + 0.3 * np.where(self.at % 2, -1.0, 1.0)) * self.dt

    def events(self, begin, end):
        """Return the readings between two samples."""
        inside = (self.times_s >= begin * self.dt) & (self.times_s < end * self.dt)
        return tuple(
            Event(ORIGIN_S + self.times_s[k], self._reading(k)) for k in np.flatnonzero(inside)
        )

    def _reading(self, k):
        pairs = zip(GNSS, self.y[k].tolist(), strict=True)
        return {QUALITY: self.quality[k], **{c: value for c, value in pairs if value == value}}

    def literal(self, noise, observe):
        """Return the run of the literal filter of section 6.5, which has seven states alone."""
        mean = np.vstack([(self.u[:-1] + self.u[1:]) / 2, self.u[-1:]])
        densities = (
            *(noise.acceleration, noise.roll_rate, noise.pitch_rate, noise.yaw_rate),
            *(noise.acceleration_walk, noise.roll_rate_walk, noise.pitch_rate_walk),
        )
        x_0, sigma = np.array([self.height[0], 0, 0, 0, 0, 0, 0]), per_step(densities, self.dt)
        P_0 = np.diag(np.square([1.0, 1.0, 0.1, 0.1, 0.1, 0.01, 0.01]))
        return kalman_filter(mean, self.dt, x_0, P_0, sigma, observe, self.lever, u_at=self.u)

    def without(self, lost):
        """Return the drive without the GNSS readings ``lost``."""
        kept = np.delete(np.arange(self.at.size), lost)
        return replace(self, at=self.at[kept], y=self.y[kept], quality=self.quality[kept])


def filtered(stage, drive):
    stage.start(drive.header)
    return np.concatenate([stage.forward(block)["left"][0] for block in drive.blocks()])


def waves(rng, times, amplitude, low_hz, high_hz, count=4):
    omega = 2 * np.pi * np.exp(rng.uniform(np.log(low_hz), np.log(high_hz), count))[:, None]
    phase = omega * times + rng.uniform(0, 2 * np.pi, (count, 1))
    size = amplitude / count
    sine, cosine = np.sin(phase), np.cos(phase)
    derivatives = sine, omega * cosine, -(omega**2) * sine
    return [size * each.sum(axis=0) for each in derivatives]


def speeds(times, stop, cruise=15.0, brake=5.0):
    """Return speed and acceleration: at ``cruise`` but for stops, pairs of when they last."""
    gone = np.min([np.maximum(a - times, times - b) for a, b in np.reshape(stop, (-1, 2))], axis=0)
    ramp = np.clip(gone / (cruise / brake), 0.0, 1.0)
    speed = cruise * ramp * ramp * (3.0 - 2.0 * ramp)
    return speed, np.gradient(speed, times)


def inputs(rng, times, braking):
    """Return specific forces and rates (n, 6), and the true height, velocity, pitch and roll."""
    r, v, a = np.add(waves(rng, times, 0.3, 0.02, 0.1), waves(rng, times, 0.02, 0.5, 2.0))
    theta, theta_dot, _ = waves(rng, times, 0.03, 0.05, 0.8)
    phi, phi_dot, _ = waves(rng, times, 0.03, 0.05, 0.8)
    yaw = waves(rng, times, 0.1, 0.03, 0.3)[0]
    forward = braking - G * np.sin(theta)
    side = 0.5 * waves(rng, times, 1.0, 0.1, 2.0)[0]
    st, ct, sp, cp = np.sin(theta), np.cos(theta), np.sin(phi), np.cos(phi)
    up = (a + G + st * forward - ct * sp * side) / (ct * cp)
    pitching = (theta_dot + sp * yaw) / cp
    rolling = phi_dot - st / ct * (sp * pitching + cp * yaw)
    return np.array([forward, side, up, rolling, pitching, yaw]).T, np.array([r, v, theta, phi]).T


def make(seed, seconds, rate, stop=(1e9, 1e9), every_s=0.05, lever=(0.8, -0.5, 1.6), quiet=1.0):
    """Return a drive; its sensors' errors are those of a good unit times ``quiet``."""
    rng = np.random.default_rng(seed)
    times = np.arange(round(seconds * rate)) / rate
    speed, braking = speeds(np.append(times, seconds), stop)
    speed, braking = speed[:-1], braking[:-1]
    true, motion = inputs(rng, times, braking)
    bias = quiet * rng.normal(size=3) * [0.03, 0.002, 0.002]
    x = np.hstack([motion, np.tile(bias, (times.size, 1))])
    deviation = np.sqrt(rate) * np.array([4e-5] * 3 + [3e-6] * 3)
    u = true + quiet * deviation * rng.normal(size=true.shape)
    u[:, 2:5] -= bias
    road = waves(rng, np.cumsum(speed) / rate, 0.02, 0.01, 0.1)[0]
    height = 0.3 + motion[:, 0] - road + quiet * 4e-5 * rng.normal(size=times.size)
    at = np.arange(rng.uniform(1.0, 5.0), times.size - 1.5, every_s * rate).round().astype(int)
    lever = np.array(lever)
    y = np.array([measured(x[k], u[k], lever) for k in at]).reshape(-1, 4)
    y[:, 0] += 312.0
    y += quiet * rng.normal(size=y.shape) * [0.004, 0.02, 0.001, 0.002]
    return Drive(rate, u, x, speed, height, at, y, np.full(at.size, 4.0), lever)


@pytest.fixture(scope="session")
def drive():
    return make


@pytest.fixture(scope="session")
def height_of(through):
    height = ChannelId("floating_reference_height", "left")
    return lambda stage, drive, cuts=(): through(stage, drive, cuts)[height]


@pytest.fixture(scope="session")
def forward_of():
    return filtered
