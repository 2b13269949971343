"""Drives of one wheel path with nominal sensors, and ways to run them."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId

UP, RANGE = ChannelId("vertical_acceleration", "left"), ChannelId("height", "left")
DISTANCE = ChannelId("distance")


@dataclass(frozen=True, eq=False)
class Drive:
    """What the sensors read, shapes (n,); the accelerometer without 1 g."""

    rate: int
    a: np.ndarray
    h: np.ndarray
    distance: np.ndarray

    @property
    def header(self):
        channels = frozenset({UP, RANGE, DISTANCE})
        return Header(Axis.TIME, 1 / self.rate, 0.0, Fraction(self.rate), channels, ("left",))

    def blocks(self, cuts=()):
        """Return the drive cut before each of the samples ``cuts``."""
        values = {UP: self.a, RANGE: self.h, DISTANCE: self.distance}
        cut = pairwise([0, *sorted(cuts), self.a.size])
        return [Block(i, {c: v[i:j].copy() for c, v in values.items()}) for i, j in cut]


def make(seed, seconds, rate, stop=(1e9, 1e9), speed=9.0, share=1.0):
    """Return a drive at ``speed`` in m/s with a stop; a ``share`` of the heights is there."""
    rng = np.random.default_rng(seed)
    times = np.arange(round(seconds * rate)) / rate
    gone = np.clip(np.maximum(stop[0] - times, times - stop[1]) / 1.5, 0.0, 1.0)
    velocity = speed * gone * gone * (3.0 - 2.0 * gone)
    distance = np.concatenate(([0.0], np.cumsum(velocity[:-1]))) / rate
    phases = rng.uniform(0, 2 * np.pi, 4)[:, None]
    hz = rng.uniform(0.3, 3.0, 4)[:, None]
    a = np.sin(2 * np.pi * hz * times + phases).sum(axis=0) * 0.3 + 0.01 * rng.normal(
        size=times.size
    )
    h = 0.3 + 0.01 * np.sin(2 * np.pi * hz[0] * times) + 1e-3 * rng.normal(size=times.size)
    h[rng.uniform(size=h.size) > share] = np.nan
    h[0] = 0.3
    return Drive(rate, a, h, distance)


def run(stage, drive, cuts=()):
    stage.start(drive.header)
    out = [stage.push(block) for block in drive.blocks(cuts)]
    return join_blocks([block for block in (*out, *stage.finish()) if len(block)])


@pytest.fixture(scope="session")
def drive():
    return make


@pytest.fixture(scope="session")
def through():
    return run
