"""The road-prior smoother of the C library, and drives for it."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.stages.signals import LEVELLED, MISSING_SHARE
from floatref.values.arrays import Flag
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId

COUNT_M = 2.0**-16
"""Metres per count: a distance of so many is exact in double."""
UNTIL_IT_ENDS = 1000.0
"""A lag in s that is longer than any run here."""


@dataclass(frozen=True, eq=False)
class Drive:
    """What sensors read at ``rate``, shapes (n,); acceleration without 1 g, counts of `COUNT_M`."""

    rate: float
    a: np.ndarray
    h: np.ndarray
    counts: np.ndarray

    def standing_on(self, sample, seconds):
        """Return a drive that goes on for ``seconds`` as in the second before ``sample``."""
        second = slice(sample - round(self.rate), sample)
        pieces = [
            np.concatenate((x[:sample], np.tile(x[second], seconds), x[sample:]))
            for x in (self.a, self.h, self.counts)
        ]
        return Drive(self.rate, *pieces)

    @property
    def distance(self):
        return (self.counts - self.counts[0]) * COUNT_M

    def at_points(self, interval_m, lost=slice(0)):
        """Return the samples at which points lie, the first that has a count and reached each."""
        last = int((self.distance[-1] + 1e-6 * interval_m) / interval_m)
        places = np.arange(last + 1) * interval_m - 1e-6 * interval_m
        reached = self.distance
        reached[lost] = -np.inf
        return np.searchsorted(np.maximum.accumulate(reached), places)


def travelled(speed, rate):
    """Return counts of a vehicle at ``speed`` in m/s."""
    metres = np.concatenate(([0.0], np.cumsum(speed[1:]))) / rate
    return np.rint(metres / COUNT_M).astype(np.int64)


def speeds(seconds, rate, speed, begins, lasts, braking_s=1.5):
    """Return speeds in m/s of a drive with a stop, braked and accelerated smoothly."""
    t = np.arange(round(seconds * rate)) / rate
    gone = np.clip(np.maximum(begins - t, t - begins - lasts) / braking_s, 0.0, 1.0)
    return speed * gone * gone * (3.0 - 2.0 * gone)


def heaving(rate, counts, seed=0, noise=1e-3):
    """Return a drive over a random road, the body heaving once a second; sensors fit each other."""
    rng = np.random.default_rng(seed)
    t, x = np.arange(counts.size) / rate, counts * COUNT_M
    omega, phase = 2 * np.pi, rng.uniform(0, 2 * np.pi)
    r = 0.004 * np.sin(omega * t + phase)
    a = -(omega**2) * r + 0.02 + noise * rng.normal(size=t.size)
    waves = 2.0 ** np.arange(-1, 6)[:, None] * rng.uniform(0.8, 1.25, (7, 1))
    road = (3e-4 * waves * np.sin(2 * np.pi * x / waves + rng.uniform(0, 6.3, (7, 1)))).sum(axis=0)
    return Drive(rate, a, 0.3 + r - road + 3e-5 * rng.normal(size=t.size), counts)


@dataclass(frozen=True, eq=False)
class Points:
    """What comes out: elevation and 1-sigma in m, and flags."""

    elevation: np.ndarray
    sigma: np.ndarray
    flags: np.ndarray

    @classmethod
    def join(cls, parts):
        return cls(*(np.concatenate([getattr(p, n) for p in parts]) for n in vars(parts[0])))


class Road:
    """An object of the library that is fed, and refuses what the caller expects it to."""

    def __init__(self, library, drive, interval_m=0.25, **settings):
        encoder = {"rate_hz": drive.rate, "metres_per_count": COUNT_M, "interval_m": interval_m}
        self.library = library
        self.made = library.make("road_prior", **{"fastest_mps": 30.0, **encoder, **settings})

    def call(self, name, *inputs, room=100_000):
        """Return the status and the points; ``inputs`` may be None for what is left out."""
        arrays = [None if x is None else self.library.array(x) for x in inputs]
        points = Points(
            *np.full((2, room), np.nan, self.library.dtype), np.full(room, 99, np.uint8)
        )
        written, ffi = self.library.ffi.new("size_t *", 12345), self.library.ffi
        count = [arrays[0].size] if arrays else []
        given = [ffi.NULL if x is None else self.library.at(x) for x in arrays]
        flags = ffi.cast("uint8_t *", points.flags.ctypes.data)
        results = self.library.at(points.elevation), self.library.at(points.sigma), flags
        status = self.made.call(name, *given, *count, *results, room, written)
        self.written = written[0]
        if status != 0:
            return self.library.status[status], points
        return "FR_OK", Points(*(x[: self.written] for x in vars(points).values()))

    def take(self, name, *inputs):
        status, points = self.call(name, *inputs)
        assert status == "FR_OK"
        return points

    def push(self, drive, begin=0, end=None):
        part = slice(begin, end)
        return self.take("push", drive.a[part], drive.h[part], drive.counts[part])


@pytest.fixture(scope="session")
def road(double):
    """Return what makes a smoother in double for a drive."""

    def make(drive, interval_m=0.25, library=double, **settings):
        return Road(library, drive, interval_m, **settings)

    return make


@pytest.fixture(scope="session")
def smoothed(road):
    """Return what runs a drive through a smoother, cut before some samples: all its points."""

    def run(drive, interval_m=0.25, cuts=(), **settings):
        made, edges = road(drive, interval_m, **settings), [0, *sorted(cuts), drive.a.size]
        parts = [made.push(drive, *pair) for pair in pairwise(edges)]
        return Points.join([*parts, made.take("finish")])

    return run


UP, RANGE = ChannelId("vertical_acceleration", "left"), ChannelId("height", "left")
HEIGHT, SIGMA = ChannelId("floating_reference_height", "left"), ChannelId("elevation_sigma", "left")
ENCODER = ChannelId("distance")
SHARES = {"levelled": ChannelId(LEVELLED), "missing": ChannelId(MISSING_SHARE)}


@pytest.fixture(scope="session")
def of_sdk():
    """Return what runs a drive through the SDK's smoother: points with elevation, 1-sigma, flags.

    By default nothing comes out before the end of the run. The encoder gives no travel in ``lost``.
    """

    def run(drive, interval_m=0.25, constants=None, wait=True, lost=slice(0), **shares):
        distance, marks = np.array(drive.distance), np.zeros(drive.a.size, np.uint8)
        distance[lost], marks[lost] = np.nan, np.uint8(Flag.SLOW)
        values = {UP: drive.a, RANGE: drive.h, ENCODER: distance}
        values |= {SHARES[name]: x for name, x in shares.items()}
        waiting = {"tolerance_m": 0.0, "waiting_s": 1e9, "longest_s": 1e9} if wait else {}
        stage = RoadPriorSmoother(constants or RoadPrior(), **waiting)
        rate = Fraction(drive.rate).limit_denominator(1000)
        stage.start(Header(Axis.TIME, 1 / drive.rate, 0.0, rate, frozenset(values), ("left",)))
        marked = {ENCODER: marks} if marks.any() else {}
        parts = [stage.push(Block(0, values, flags=marked)), *stage.finish()]
        made = join_blocks([part for part in parts if len(part)])
        at = drive.at_points(interval_m, lost)
        flags = made.flags.get(HEIGHT, np.zeros(drive.a.size, np.uint8))
        return Points((made[HEIGHT] - drive.h)[at], made[SIGMA][at], flags[at])

    return run


@pytest.fixture(scope="session")
def drives():
    """Return what makes counts, speeds and drives."""

    class Makers:
        """Functions of this file."""

    Makers.travelled, Makers.speeds, Makers.heaving = travelled, speeds, heaving
    Makers.Drive, Makers.count_m, Makers.whole = Drive, COUNT_M, UNTIL_IT_ENDS
    return Makers
