"""Drives of a wheel path with GNSS, and the Kalman objects of the C library."""

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from floatref.estimators.kalman import Noise, Plan
from floatref.estimators.kalman.inputs import GNSS, IMU, QUALITY
from floatref.values.arrays import Flag
from floatref.values.block import Axis, Block, Event, Header
from floatref.values.channels import ChannelId
from floatref.values.recording import Setup, TrackSetup

G, COUNT_M, ARM = 9.80665, 2.0**-10, (0.8, -0.5, 1.6)
NAMES = ("longitudinal", "lateral", "vertical", "roll_rate", "pitch_rate", "yaw_rate")
FORWARD, SIDE, *RATES = (ChannelId(name) for name in IMU)
UP, HEIGHT = ChannelId("vertical_acceleration", "left"), ChannelId("height", "left")
DISTANCE, SPEED = ChannelId("distance"), ChannelId("travel_speed")


@dataclass(frozen=True, eq=False)
class Drive:
    """What is measured: ``u``, shape (n, 6), with gravity, height in m, counts of the encoder.

    Row k of ``y``, shape (m, 4), is read by GNSS at sample ``at[k]``. ``lost`` are samples without
    vertical acceleration.
    """

    rate: int
    u: np.ndarray
    height: np.ndarray
    counts: np.ndarray
    at: np.ndarray
    y: np.ndarray
    lost: tuple = ()

    def __len__(self):
        return len(self.counts)

    @property
    def distance(self):
        return self.counts * COUNT_M

    @property
    def speed(self):
        window = max(1, round(0.05 * self.rate))
        before = np.concatenate((np.full(window, self.counts[0]), self.counts))[: len(self)]
        return (self.counts - before) * COUNT_M / (window / self.rate)

    @property
    def header(self):
        channels = frozenset({FORWARD, SIDE, UP, *RATES, HEIGHT, DISTANCE, SPEED})
        setup = Setup(gnss_antenna_offset_m=ARM, tracks={"left": TrackSetup((0.0, 0.0, 0.0))})
        return Header(
            Axis.TIME, 1 / self.rate, 0.0, Fraction(self.rate), channels, ("left",), setup
        )

    def blocks(self, seconds=8.0):
        """Return the drive in blocks for the SDK."""
        forward, side, up, *rates = self.u.T
        values = {FORWARD: forward, SIDE: side, UP: up - G, **dict(zip(RATES, rates, strict=True))}
        values |= {HEIGHT: self.height, DISTANCE: self.distance, SPEED: self.speed}
        flags = np.zeros(len(self), np.uint8)
        flags[list(self.lost)] = Flag.DRIFT
        edges = [*range(0, len(self), round(seconds * self.rate)), len(self)]
        return [
            Block(
                a,
                {c: v[a:b].copy() for c, v in values.items()},
                flags={UP: flags[a:b].copy()} if self.lost else {},
                events=tuple(
                    self._event(k) for k in np.flatnonzero((self.at >= a) & (self.at < b))
                ),
            )
            for a, b in pairwise(edges)
        ]

    def _event(self, k):
        pairs = zip(GNSS, self.y[k].tolist(), strict=True)
        return Event(self.at[k] / self.rate, {QUALITY: 4.0, **{c: v for c, v in pairs if v == v}})

    def without_gnss(self, begin, end):
        """Return the drive without readings from sample ``begin`` up to ``end``."""
        kept = (self.at < begin) | (self.at >= end)
        return replace(self, at=self.at[kept], y=self.y[kept])


def waves(rng, times, amplitude, low_hz, high_hz, count=4):
    """Return a sum of sines and its two derivatives."""
    omega = 2 * np.pi * np.exp(rng.uniform(np.log(low_hz), np.log(high_hz), count))[:, None]
    phase = omega * times + rng.uniform(0, 2 * np.pi, (count, 1))
    derivatives = np.sin(phase), omega * np.cos(phase), -(omega**2) * np.sin(phase)
    return [amplitude / count * each.sum(axis=0) for each in derivatives]


def speeds(times, stops, cruise=15.0, ramp_s=3.0):
    """Return the speed: ``cruise`` but for ``stops``, pairs of when each begins and ends."""
    speed = np.full(times.size, cruise)
    for begin, end in stops:
        gone = np.clip(np.maximum(begin - times, times - end) / ramp_s, 0.0, 1.0)
        speed = np.minimum(speed, cruise * gone * gone * (3.0 - 2.0 * gone))
    return speed


def make(seed, seconds, rate=256, stops=(), every_s=0.0625, quiet=1.0, pace=1.0):
    """Return a drive over a road; the sensors' errors are those of a good unit times ``quiet``.

    The body moves ``pace`` times as fast as a car's.
    """
    rng = np.random.default_rng(seed)
    times = np.arange(round(seconds * rate)) / rate
    speed = speeds(times, stops)
    r, v, a = np.add(
        waves(rng, times, 0.3, 0.02, 0.1), waves(rng, times, 0.02, 0.5 * pace, 2.0 * pace)
    )
    theta, theta_dot, _ = waves(rng, times, 0.03, 0.05 * pace, 0.8 * pace)
    phi, phi_dot, _ = waves(rng, times, 0.03, 0.05 * pace, 0.8 * pace)
    forward = np.gradient(speed, 1 / rate) - G * np.sin(theta)
    up = (a + G + np.sin(theta) * forward) / (np.cos(theta) * np.cos(phi))
    true = np.array([forward, 0 * up, up, phi_dot, theta_dot / np.cos(phi), 0 * up]).T
    deviation = np.sqrt(rate) * np.array([4e-5] * 3 + [3e-6] * 3)
    u = true + quiet * deviation * rng.normal(size=true.shape)
    u[:, 2:5] -= quiet * rng.normal(size=3) * [0.03, 0.002, 0.002]
    gone = np.concatenate(([0.0], np.cumsum(speed[:-1]))) / rate
    road = waves(rng, gone, 0.02, 0.01, 0.1)[0]
    height = 0.3 + r - road + quiet * 4e-5 * rng.normal(size=times.size)
    at = np.arange(0, times.size, max(1, round(every_s * rate))) + int(rng.integers(0, 5))
    at = at[at < times.size]
    y = np.stack([r + ARM[2] + 312.0, v, theta, phi], axis=1)[at]
    y += quiet * rng.normal(size=y.shape) * [0.004, 0.02, 0.001, 0.002]
    return Drive(rate, u, height, np.floor(gone / COUNT_M).astype(np.int64), at, y)


@pytest.fixture(scope="session")
def drive():
    return make


def settings_of(drive, plan, noise):
    """Return the settings of the C library that say the same."""
    inside = {f"noise__{name}": value for name, value in vars(noise).items()}
    return {
        "travel__rate_hz": float(drive.rate),
        "travel__metres_per_count": COUNT_M,
        "antenna_m": ARM,
        "gnss": plan.gnss,
        "attitude": plan.attitude,
        "reflects": plan.reflects,
        "readings": 1000,
        **inside,
    }


class Path:
    """An object of the C library that takes the samples of a wheel path."""

    def __init__(self, made):
        self.made, self.library, self.ffi = made, made.library, made.library.ffi

    def address(self, x):
        return self.ffi.cast("double *", x.ctypes.data)

    def imu(self, u):
        """Return pointers to the columns, and what has to live as long as these do."""
        columns = [np.ascontiguousarray(x, np.float64) for x in u.T]
        imu = self.ffi.new("fr_imu *", dict(zip(NAMES, map(self.address, columns), strict=True)))
        return imu, columns

    def read(self, sample, y, variances=None):
        values = self.ffi.new("double[4]", list(y))
        given = self.ffi.NULL if variances is None else self.ffi.new("double[4]", list(variances))
        return self.made.call("push_gnss", sample, values, given)

    def push(self, drive, begin, end, outputs, capacity):
        """Return the status, and what came out of samples ``begin`` to ``end - 1``."""
        imu, columns = self.imu(drive.u[begin:end])
        height = np.ascontiguousarray(drive.height[begin:end], np.float64)
        counts = np.ascontiguousarray(drive.counts[begin:end])
        written = self.ffi.new("size_t *", 12345)
        places = [self.ffi.cast(kind, y.ctypes.data) for kind, y in outputs]
        inputs = self.address(height), self.ffi.cast("int64_t *", counts.ctypes.data)
        status = self.made.call("push", imu, *inputs, end - begin, *places, capacity, written)
        del columns
        return status, written[0]


@pytest.fixture(scope="session")
def path_of(double):
    """Return what makes an object for a drive, a plan and noise, with further settings."""

    def make_path(kind, drive, plan=None, noise=None, library=double, **settings):
        found = settings_of(drive, plan or Plan(), noise or Noise())
        if kind == "kalman":
            found = {f"filter__{name}": value for name, value in found.items()}
        return Path(library.make(kind, **{**found, **settings}))

    return make_path


def filter_by_c(path, drive, edges=None, late=0, order=None, variances=None):
    """Return the heights; readings are pushed ``late`` samples behind their own at most."""
    found, out = [], np.empty(len(drive))
    order = np.arange(drive.at.size) if order is None else order
    edges = [0, len(drive)] if edges is None else edges
    pushed = np.zeros(drive.at.size, bool)
    for begin, end in pairwise(edges):
        for k in order[(drive.at[order] < end - late) & ~pushed[order]]:
            assert path.read(drive.at[k], drive.y[k], variances) == 0
            pushed[k] = True
        status, written = path.push(drive, begin, end, [("double *", out)], out.size)
        assert status == 0, path.library.text(status)
        found.append(out[:written].copy())
    for k in order[~pushed[order]]:
        assert path.read(drive.at[k], drive.y[k], variances) == 0
    written = path.ffi.new("size_t *")
    assert path.made.call("finish", path.address(out), out.size, written) == 0
    return np.concatenate([*found, out[: written[0]]])


@pytest.fixture(scope="session")
def filtered():
    return filter_by_c


def smooth_by_c(path, drive, edges=None, late=0):
    """Return elevation, 1-sigma and flags of all points."""
    room = 2_000_000
    real = path.library.dtype
    out = np.empty(room, real), np.empty(room, real), np.empty(room, np.uint8)
    kinds, found, k = ("fr_real *", "fr_real *", "uint8_t *"), [], 0
    edges = [*range(0, len(drive), 2000), len(drive)] if edges is None else edges
    for begin, end in pairwise(edges):
        while k < drive.at.size and drive.at[k] < end - late:
            assert path.read(drive.at[k], drive.y[k]) == 0
            k += 1
        status, written = path.push(drive, begin, end, zip(kinds, out, strict=True), room)
        assert status == 0, path.library.text(status)
        found.append([y[:written].copy() for y in out])
    for later in range(k, drive.at.size):
        assert path.read(drive.at[later], drive.y[later]) == 0
    written = path.ffi.new("size_t *")
    places = [path.ffi.cast(kind, y.ctypes.data) for kind, y in zip(kinds, out, strict=True)]
    status = path.made.call("finish", *places, room, written)
    assert status == 0, path.library.text(status)
    found.append([y[: written[0]] for y in out])
    return [np.concatenate(each) for each in zip(*found, strict=True)]


@pytest.fixture(scope="session")
def smoothed():
    return smooth_by_c
