"""IMU and encoder of a run as slow series on one grid of times.

Hours at kilohertz become means over 50 ms: gravity, turns, braking and the body's swing remain,
wheels and engine do not.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from floatref.stages.signals import DISTANCE
from floatref.values.arrays import FloatArray, IndexArray, release
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import CHUNK

STEP_S = 0.05
FORCES = ("longitudinal_specific_force", "lateral_specific_force", "vertical_specific_force")
RATES = ("roll_rate", "pitch_rate", "yaw_rate")
FEWEST = 60
"""Fewest means; a run of less than three seconds is not examined."""
NOTHING = np.empty(0, np.int64)
SWING_S = 10.0
"""Means over this time in s, taken twice, give the slope of the road and the drift of a gyro."""


@dataclass(frozen=True)
class Grid:
    """``count`` stretches of `STEP_S` from ``begin_s`` on."""

    begin_s: float
    count: int

    @property
    def edges(self) -> FloatArray:
        """Where the stretches meet, shape (count + 1,), in s."""
        return np.asarray(self.begin_s + STEP_S * np.arange(self.count + 1))

    @property
    def times(self) -> FloatArray:
        """The middle of every stretch, shape (count,), in s."""
        return np.asarray(self.begin_s + STEP_S * (0.5 + np.arange(self.count)))


@dataclass(frozen=True, eq=False)
class Motion:
    """A run on a grid of n times; NaN where a sensor is silent.

    Attributes:
        grid: the times.
        forces: along body X, Y, Z, shape (3, n), in m/s².
        rates: about body X, Y, Z, shape (3, n), in rad/s.
        distance: of the encoder, shape (n,), in m.
    """

    grid: Grid
    forces: FloatArray
    rates: FloatArray
    distance: FloatArray

    @classmethod
    def of(cls, recording: Recording, track: str) -> "Motion | None":
        """Return the run of ``track``, which has all of these channels; None if it is too short."""
        channels = [recording.channel(name, track) for name in (*FORCES, *RATES, DISTANCE)]
        begin = max(channel.span_s[0] for channel in channels)
        end = min(channel.span_s[1] for channel in channels)
        grid = Grid(begin, max(int((end - begin) / STEP_S), 0))
        if grid.count < FEWEST:
            return None
        rows = np.stack([means(channel, grid) for channel in channels])
        return cls(grid, rows[:3], rows[3:6], rows[6])

    @cached_property
    def times(self) -> FloatArray:
        """The middle of every mean, shape (n,), in s."""
        return self.grid.times

    @cached_property
    def speed(self) -> FloatArray:
        """Travel speed, shape (n,), in m/s."""
        return np.gradient(bridge(self.distance), STEP_S)

    @cached_property
    def acceleration(self) -> FloatArray:
        """Rate of the travel speed, shape (n,), in m/s²."""
        return np.gradient(self.speed, STEP_S)

    @cached_property
    def tilts(self) -> FloatArray:
        """Roll and pitch that the horizontal forces show, shape (2, n), in rad.

        The horizontal forces minus those of travel are gravity: roll (f_y - v r)/g and pitch (a -
        f_x)/g, (2.17) for small angles.
        """
        roll = self.forces[1] - self.speed * self.rates[2]
        pitch = self.acceleration - self.forces[0]
        return np.stack([roll, pitch]) / STANDARD_GRAVITY

    def turn(self, tilts: FloatArray) -> FloatArray:
        """Return the angles that the rates integrate to, shape (3, n), in rad: roll, pitch, yaw.

        ``tilts``, shape (2, n), give the part of a turn of the course that is roll and pitch,
        (6.27) and (6.28) for small angles.
        """
        roll, pitch = tilts
        p, q, r = self.rates
        return np.stack([integrate(rate) for rate in (p + pitch * r, q - roll * r, r)])

    @cached_property
    def swing(self) -> FloatArray:
        """Roll and pitch against their means over some seconds, shape (2, n), in rad."""
        angles = self.turn(np.zeros((2, self.grid.count)))[:2]
        return np.stack([angle - smooth(angle, SWING_S) for angle in angles])

    @cached_property
    def lift(self) -> FloatArray:
        """Vertical acceleration in m/s², with the vertical direction from the swing, (6.37)."""
        roll, pitch = self.swing
        along, across, normal = self.forces
        upright = normal * np.cos(pitch) * np.cos(roll)
        upright += across * np.sin(roll) - along * np.sin(pitch)
        return np.asarray(upright - STANDARD_GRAVITY)


def means(channel: Channel, grid: Grid) -> FloatArray:
    """Return the mean of ``channel`` over every stretch of ``grid``, NaN where it has no sample."""
    return mean_between(channel, grid.edges)


def mean_between(channel: Channel, edges: FloatArray, gone: IndexArray = NOTHING) -> FloatArray:
    """Return the mean of ``channel`` between neighbouring ``edges``, shape (n + 1,) in s.

    The result has shape (n,) and is NaN where there is no sample. Samples with the numbers
    ``gone``, in order, count as missing.
    """
    first = first_samples(channel, edges)
    found = np.full(edges.size - 1, np.nan)
    for low, high in _groups(first):
        chunk = samples(channel, int(first[low]), int(first[high]), gone)
        lengths = np.diff(first[low : high + 1])
        filled = lengths > 0
        starts = first[low:high][filled] - first[low]
        if starts.size:
            found[low:high][filled] = _mean(chunk, starts, lengths[filled])
        release(channel.values)
    return found


def samples(channel: Channel, first: int, behind: int, gone: IndexArray) -> FloatArray:
    """Return the samples from ``first`` to the one before ``behind``, those ``gone`` as NaN."""
    values = channel.values[first:behind]
    low, high = np.searchsorted(gone, (first, behind))
    if low == high:
        return values
    values = np.array(values)
    values[gone[low:high] - first] = np.nan
    return values


def _mean(chunk: FloatArray, starts: IndexArray, lengths: IndexArray) -> FloatArray:
    sums = np.add.reduceat(chunk, starts)
    if np.isnan(sums).any():
        missing = np.isnan(chunk)
        sums = np.add.reduceat(np.where(missing, 0.0, chunk), starts)
        lengths = lengths - np.add.reduceat(missing.astype(np.int64), starts)
    return np.where(lengths > 0, sums / np.maximum(lengths, 1), np.nan)


def first_samples(channel: Channel, edges: FloatArray) -> IndexArray:
    """Return the index of the first sample from each of ``edges`` on, in s."""
    clock = channel.clock
    if isinstance(clock, StampedClock):
        return np.searchsorted(clock.times_s, edges)
    index = np.ceil((edges - clock.start_s) * float(clock.rate) - 1e-6)
    return np.clip(index, 0, channel.values.size).astype(np.int64)


def _groups(first: IndexArray) -> Iterator[tuple[int, int]]:
    """Yield stretches of the grid that hold about `CHUNK` samples together."""
    size = max(1, int(CHUNK * first.size / max(int(first[-1] - first[0]), 1)))
    for low in range(0, first.size - 1, size):
        yield low, min(low + size, first.size - 1)


def bridge(values: FloatArray) -> FloatArray:
    """Return ``values``, shape (n,), with NaN replaced by the line between the neighbours."""
    known = np.flatnonzero(~np.isnan(values))
    if known.size in (0, values.size):
        return values
    return np.interp(np.arange(values.size), known, values[known])


def smooth(values: FloatArray, span_s: float) -> FloatArray:
    """Return the mean of ``values``, shape (n,), over ``span_s``, taken twice; NaN stays NaN.

    That is 3 dB down at 0.32 / ``span_s``.
    """
    length = min(max(1, round(span_s / STEP_S)), values.size)
    found = bridge(values)
    for _ in range(2):
        found = _moving_mean(found, length)
    return np.where(np.isnan(values), np.nan, found)


def _moving_mean(values: FloatArray, length: int) -> FloatArray:
    sums = np.concatenate([[0.0], np.cumsum(values - values.mean())])
    middle = np.arange(values.size)
    low = np.maximum(middle - length // 2, 0)
    high = np.minimum(middle + (length + 1) // 2, values.size)
    return np.asarray((sums[high] - sums[low]) / (high - low) + values.mean())


def integrate(rate: FloatArray) -> FloatArray:
    """Return the integral of ``rate``, shape (n,), at the same times; NaN stays NaN."""
    steps = bridge(rate) * STEP_S
    return np.where(np.isnan(rate), np.nan, np.cumsum(steps) - steps / 2)
