"""Readings of a GNSS receiver beside the means of the IMU, and which are RTK fixed."""

from dataclasses import dataclass

import numpy as np

from floatref.screening.slow_series import Motion
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import median_step

TOGETHER_S = 0.2
"""Readings within this time are averaged: single ones are as noisy as a smooth road's swing."""
EARTH_RADIUS_M = 6371e3
COURSE_S, COURSE_M = 1.0, 3.0
"""The course is the direction of the distance travelled in this time in s, if it is this long in
m."""
DELAYS_S = (-0.3, -0.2, 0.2, 0.3)
"""Delays in s that look like an inverted sign where the body swings evenly."""
RTK_FIXED = 4.0


@dataclass(frozen=True, eq=False)
class Readings:
    """Readings of one channel during a run, averaged over `TOGETHER_S`.

    Attributes:
        motion: the run.
        stamps: time of every reading that is not missing, shape (m,), in s.
        group: index of the mean that each belongs to, shape (m,).
        times: the mean times, shape (n,), in s.
        values: the means, shape (n,).
    """

    motion: Motion
    stamps: FloatArray
    group: IndexArray
    times: FloatArray
    values: FloatArray

    @classmethod
    def of(cls, channel: Channel, motion: Motion) -> "Readings":
        """Return the readings of ``channel`` within the run."""
        stamps, values = channel.times_s, channel.values
        during = (stamps >= motion.times[0]) & (stamps <= motion.times[-1]) & ~np.isnan(values)
        stamps = stamps[during]
        begin = stamps[0] if stamps.size else 0.0
        _, group = np.unique(np.floor((stamps - begin) / TOGETHER_S + 1e-6), return_inverse=True)
        parts = _average(group, stamps), _average(group, values[during])
        return cls(motion, stamps, group, *parts)

    def beside(self, row: FloatArray, late_s: float = 0.0) -> FloatArray:
        """Return ``row``, shape (k,) on the run's grid, at the readings, shape (n,).

        The readings are assumed to be ``late_s`` late.
        """
        return _average(self.group, np.interp(self.stamps - late_s, self.motion.times, row))

    def delay(self, row: FloatArray) -> dict[str, FloatArray]:
        """Return the same for readings late or early by up to half a swing of the body."""
        return {f"late {late_s:g} s": self.beside(row, late_s) for late_s in DELAYS_S}

    def on_grid(self) -> FloatArray:
        """Return the readings on the run's grid, linear in between; there must be at least one."""
        return np.interp(self.motion.times, self.times, self.values)


def _average(group: IndexArray, values: FloatArray) -> FloatArray:
    if not group.size:
        return np.empty(0)
    return np.asarray(np.bincount(group, values) / np.bincount(group))


def course(recording: Recording, motion: Motion) -> Readings | None:
    """Return the direction of travel in rad, left turn positive; None without positions."""
    found = [recording.find(f"gnss_{name}") for name in ("latitude", "longitude")]
    latitude, longitude = (Readings.of(c, motion) if c is not None else None for c in found)
    if latitude is None or longitude is None or not latitude.times.size:
        return None
    if not np.array_equal(latitude.times, longitude.times):
        return None
    north = EARTH_RADIUS_M * (latitude.values - latitude.values[0])
    west = -EARTH_RADIUS_M * np.cos(latitude.values[0]) * (longitude.values - longitude.values[0])
    steps = [_step(latitude.times, way) for way in (north, west)]
    heading, far = np.arctan2(steps[1], steps[0]), np.hypot(*steps) >= COURSE_M
    heading[far] = np.unwrap(heading[far])
    heading[~far] = np.nan
    return Readings(motion, latitude.stamps, latitude.group, latitude.times, heading)


def _step(times: FloatArray, way: FloatArray) -> FloatArray:
    """Return the growth of ``way`` in `COURSE_S` around each of ``times``."""
    half = COURSE_S / 2
    return np.asarray(np.interp(times + half, times, way) - np.interp(times - half, times, way))


def fixed_readings(recording: Recording) -> BoolArray:
    """Return which readings of gnss_height are not missing and have a fixed ambiguity, shape (N,).

    Each has the quality of the reading of gnss_quality nearest in time; without that channel all
    count as fixed.
    """
    height, quality = recording.channel("gnss_height"), recording.find("gnss_quality")
    there: BoolArray = ~np.isnan(height.values)
    if quality is None:
        return there
    times, stamps = height.times_s, quality.times_s
    after = np.clip(np.searchsorted(stamps, times), 0, stamps.size - 1)
    before = np.maximum(after - 1, 0)
    nearest = np.where(times - stamps[before] < stamps[after] - times, before, after)
    near = np.abs(stamps[nearest] - times) <= 1.5 * usual_step(times)
    return np.asarray(there & near & (quality.values[nearest] == RTK_FIXED))


def usual_step(times: FloatArray) -> float:
    """Return the median step of ``times`` in s; infinite for a single time."""
    return median_step(times) if times.size > 1 else np.inf
