"""The travel speed of a recording, at even times."""

from typing import NamedTuple

import numpy as np

from floatref.screening.damage.encoder_path import times_at
from floatref.stages.signals import DISTANCE
from floatref.stages.speed import WINDOW_S, progress_speed
from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import every


class Travel(NamedTuple):
    """How a vehicle travelled, every `WINDOW_S`; both are empty for a shorter run.

    Attributes:
        distance_m: of the encoder, shape (n,), in m.
        speed_mps: speed there, shape (n,), in m/s.
    """

    distance_m: FloatArray
    speed_mps: FloatArray

    @classmethod
    def of(cls, recording: Recording) -> "Travel":
        """Return the encoder's progress over `WINDOW_S` (5.6); missing samples are skipped."""
        channel = recording.channel(DISTANCE, recording.tracks[0])
        stride = _stride(channel)
        distance = every(stride, channel.values)
        known = np.flatnonzero(~np.isnan(distance))
        times, distance = times_at(channel, stride * known), distance[known]
        even = np.arange(times[0], times[-1], WINDOW_S) if times.size else times
        distance = np.interp(even, times, distance)
        return cls(distance[1:], progress_speed(distance, 1, WINDOW_S))

    @property
    def fastest_mps(self) -> float:
        """The fastest mean speed over a second, in m/s; over the run if that is shorter."""
        if not self.speed_mps.size:
            return 0.0
        window = min(round(1.0 / WINDOW_S), self.speed_mps.size)
        sums = np.convolve(self.speed_mps, np.ones(window), "valid")
        return max(0.0, float(sums.max()) / window)


def _stride(channel: Channel) -> int:
    if isinstance(channel.clock, StampedClock):
        return 1
    return max(1, round(WINDOW_S * float(channel.clock.rate)))
