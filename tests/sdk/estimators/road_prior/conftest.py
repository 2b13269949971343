"""Drives of one wheel path with nominal sensors, and ways to run them."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from tests.sdk.estimators.road_prior.literal_constants import literal_constants

from floatref.estimators.road_prior.excitation import Excitation
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref_reference.road_prior.symbols import recorded

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

    def excitation(self, constants, every=1):
        """Return acceleration along and response at every so manyth sample."""
        found = Excitation.of(every / self.rate, constants.pitch_hz, constants.pitch_damping)
        found.add(self.distance[::every])
        found.end()
        return found.take()

    def literally(self, c, inputs, a_x, priors):
        """Return drive and constants as the reference takes them; heights count from the first.

        ``inputs`` are those that the coefficients with ``priors`` multiply.
        """
        times = np.arange(self.a.size) / self.rate
        signals = self.a, self.h - self.h[0], np.stack(inputs, axis=-1), a_x
        return recorded(times, self.distance, *signals), literal_constants(c, priors)

    def followed_by(self, other):
        place = 2 * self.distance[-1] - self.distance[-2] + other.distance
        a, h = np.append(self.a, other.a), np.append(self.h, other.h)
        return Drive(self.rate, a, h, np.append(self.distance, place))


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


@pytest.fixture(scope="session")
def drive():
    return make
