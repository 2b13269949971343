"""A stop on a hump and a brake on the level, as the sensors of two wheel paths read them."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from scipy.signal import StateSpace, lsim

from floatref import AxleSetup, Setup, TrackSetup
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId

DISTANCE = ChannelId("distance")
LEVEL = {"left": 0.0, "right": 0.0}
STEP, G = 0.01, STANDARD_GRAVITY
FRONT_M, BASE_M, LASER_M = 1.7, 3.4, -2.6
HZ, DAMPING, GAIN, GYRATION = 1.5, 0.3, 0.006, 0.9


@dataclass(frozen=True, eq=False)
class Stop:
    """What moves and what is read, each of shape (n,), 100 times a second; see `stop_on_hump`."""

    distance: np.ndarray
    pitch: np.ndarray
    level: np.ndarray
    force: np.ndarray
    height: np.ndarray

    @property
    def header(self):
        """The sensors of two wheel paths in time, and an encoder."""
        names = ("vertical_specific_force", "height")
        channels = {ChannelId(name, track) for name in names for track in LEVEL}
        place = TrackSetup((LASER_M, 0.0, 0.0))
        setup = Setup(tracks=dict.fromkeys(LEVEL, place), axles=AxleSetup(BASE_M, FRONT_M))
        rate, channels = Fraction(round(1 / STEP)), frozenset({*channels, DISTANCE})
        return Header(Axis.TIME, STEP, 0.0, rate, channels, tuple(LEVEL), setup)

    def block(self, lost="", where=slice(0)):
        """Return all of it; the channel ``lost`` has no reading at the samples ``where``."""
        series = {"vertical_specific_force": self.force, "height": self.height}
        values = {DISTANCE: self.distance}
        for name, read in series.items():
            kept = read.copy()
            kept[where if name == lost else slice(0)] = np.nan
            values |= {ChannelId(name, track): kept.copy() for track in LEVEL}
        return Block(0, values)


def stop_on_hump(height_m=0.1, seed=0):
    """Return a stop from 15 m/s with the front axle on top of a hump that is 30 m long."""
    speed = _speeds()
    distance, along = np.cumsum(speed) * STEP, np.gradient(speed, STEP)
    front_m = FRONT_M - LASER_M
    top = distance[np.flatnonzero(speed == 0)[0]] + front_m
    under = distance + front_m, distance + front_m - BASE_M, distance
    front, rear, laser = (height_m * np.exp(-np.square((x - top) / 8.0)) for x in under)
    slope = (front - rear) / BASE_M
    pitch = _follow(slope, HZ, DAMPING, GAIN * (along + G * slope))
    # Even springs carry the body as far apart as GYRATION of half the wheelbase would.
    bounce = _follow(0.5 * (front + rear), GYRATION * HZ, GYRATION * DAMPING)
    # The sensors are LASER_M from the middle between the axles.
    body = bounce + LASER_M * pitch + 0.3
    level = np.gradient(np.gradient(body, STEP), STEP) + G
    rng = np.random.default_rng(seed)
    noise, texture = rng.normal(size=(2, speed.size)) * [[2e-3], [1e-4]]
    force = level * np.cos(pitch) - along * np.sin(pitch) + noise
    return Stop(distance, pitch, level, force, body - laser + texture)


def short_brake():
    """Return 2 s of a brake by 3 m/s² on the level, with a body that does not move."""
    t, full = STEP * np.arange(200), np.ones(200)
    return Stop(20.0 * t - 1.5 * t**2, 0 * t, G * full, G * full, 0.3 * full)


def _speeds():
    """Return speeds in m/s: 8 s of travel, a stop of 6 s, and 8 s of travel."""
    fast = 15.0
    corners = np.cumsum([0.0, 8.0, fast / 3.0, 6.0, fast / 2.0, 8.0])
    return np.interp(np.arange(0.0, corners[-1], STEP), corners, [fast, fast, 0, 0, fast, fast])


def _follow(road, hz, damping, more=0.0):
    """Return how a mass on springs and dampers follows the ``road``; ``more`` is at rest."""
    w = 2 * np.pi * hz
    drive = road + 2 * damping / w * np.gradient(road, STEP) + more
    body = StateSpace([[0, 1], [-w * w, -2 * damping * w]], [[0], [w * w]], [[1, 0]], [[0]])
    start = [drive[0], 0.0]
    return lsim(body, drive, STEP * np.arange(road.size), start)[1]
