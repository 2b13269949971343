"""How a vehicle travelled during a recording: distance and speed at even times, and its track."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from floatref.screening.damage.encoder_path import EncoderPath, times_at
from floatref.stages.signals import DISTANCE
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.recording import Channel, Recording
from floatref.viewer.drawn_lines import Line
from floatref.viewer.page_writer import DOUBLE, PageWriter

STEP_S, MOST_TIMES = 0.05, 40_000
"""Time in s from one distance to the next, if that makes no more than so many."""
SMOOTH_S = 0.5
"""Time in s over which the speed that is drawn is a mean."""
MOST_FIXES = 20_000
"""Largest number of places of the vehicle that a page holds."""
LATITUDE, LONGITUDE, QUALITY = "gnss_latitude", "gnss_longitude", "gnss_quality"


@dataclass(frozen=True, eq=False)
class Journey:
    """The farthest distance of the encoder until every time.

    Attributes:
        origin_s: the time of the recording from which times count, in s.
        begin_s: the first time in s after it.
        step_s: time in s from one distance to the next.
        distance_m: shape (n,), in m, not decreasing.
    """

    origin_s: float
    begin_s: float
    step_s: float
    distance_m: FloatArray

    @classmethod
    def of(cls, recording: Recording, origin_s: float) -> "Journey | None":
        """Return the journey, None without an encoder or where it never moved."""
        channel = recording.find(DISTANCE, recording.tracks[0])
        if channel is None:
            return None
        path = EncoderPath.of(channel)
        times = times_at(channel, path.knots["at"])
        if times.size < 2 or path.distance[-1] <= path.distance[0]:
            return None
        step_s = max(STEP_S, float(times[-1] - times[0]) / MOST_TIMES)
        even = np.arange(times[0], times[-1] + step_s, step_s)
        distance_m = np.interp(even, times, path.distance)
        return cls(origin_s, float(times[0]) - origin_s, step_s, distance_m)

    @property
    def times_s(self) -> FloatArray:
        """Time of every distance in s after the origin, shape (n,)."""
        index = np.arange(self.distance_m.size, dtype=np.float64)
        return self.begin_s + self.step_s * index

    def speed_over(self, window_s: float) -> FloatArray:
        """Return the mean speed in m/s over the ``window_s`` around every time, shape (n,)."""
        half = max(1, round(window_s / self.step_s / 2.0))
        index = np.arange(self.distance_m.size)
        first, last = np.maximum(index - half, 0), np.minimum(index + half, index[-1])
        passed_m = self.distance_m[last] - self.distance_m[first]
        return np.asarray(passed_m / ((last - first) * self.step_s))

    def distance_at(self, time_s: float) -> float:
        """Return the distance in m at ``time_s``, the first or the last one outside."""
        return float(np.interp(time_s, self.times_s, self.distance_m))

    def speed_line(self) -> Line:
        """Return the speed in m/s over the time."""
        speed = self.speed_over(SMOOTH_S)
        return Line(speed, "speed", "time", self.begin_s, self.step_s)

    def write(self, page: PageWriter) -> dict[str, Any]:
        """Write the distances."""
        return {
            "start": self.begin_s,
            "step": self.step_s,
            "distance": page.add(self.distance_m, DOUBLE),
        }


def write_track(page: PageWriter, recording: Recording, origin_s: float) -> dict[str, Any] | None:
    """Write where the vehicle was, in degrees; None without fixes. Times count from ``origin_s``.

    A place is NaN where a fix is missing, or the receiver reports that it has no fix.
    """
    found = [recording.find(name, recording.tracks[0]) for name in (LATITUDE, LONGITUDE)]
    latitude, longitude = found
    if latitude is None or longitude is None:
        return None
    every = -(-latitude.values.size // MOST_FIXES)
    times = latitude.times_s[::every]
    known = _has_fix(recording, times)
    north, east = (
        np.where(known, np.degrees(_at(channel, times)), np.nan)
        for channel in (latitude, longitude)
    )
    if np.isfinite(north + east).sum() < 2:
        return None
    return {
        "time": page.add(times - origin_s, DOUBLE),
        "latitude": page.add(north, DOUBLE),
        "longitude": page.add(east, DOUBLE),
    }


def _has_fix(recording: Recording, times: FloatArray) -> BoolArray:
    quality = recording.find(QUALITY, recording.tracks[0])
    if quality is None:
        return np.ones(times.size, np.bool_)
    at = np.searchsorted(quality.times_s, times, side="right") - 1
    return np.asarray((at < 0) | (quality.values[np.maximum(at, 0)] != 0.0))


def _at(channel: Channel, times: FloatArray) -> FloatArray:
    """Return the samples of ``channel`` nearest before ``times``."""
    at = np.searchsorted(channel.times_s, times, side="right") - 1
    return np.where(at >= 0, channel.values[np.maximum(at, 0)], np.nan)
