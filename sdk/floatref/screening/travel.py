"""The travel speed of a recording, at even times."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from floatref.screening.damage.encoder_damage import HARDEST
from floatref.screening.damage.encoder_path import times_at
from floatref.stages.signals import DISTANCE
from floatref.stages.speed import WINDOW_S, progress_speed
from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import every

STANDS_S, STANDS_M = 0.7, 0.002
"""A vehicle stops that travels less than the second in m during the first in s."""
MEAN_S = 0.5
"""Time in s of the mean speed below which travel is slow, as in `MarkDrive`."""
ONE_STOP_M = 1.0
"""Stops that are nearer to one another, in m, are one: a vehicle rocks, or moves up a little."""


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

    def stops_m(self) -> tuple[float, ...]:
        """Return where the vehicle stops, in m of the encoder, in order."""
        places: list[float] = []
        for begin, _ in self._stretches(STANDS_M, STANDS_S):
            if not places or begin - places[-1] >= ONE_STOP_M:
                places.append(begin)
        return tuple(places)

    def slow_stretches_m(self, slow_mps: float) -> tuple[tuple[float, float], ...]:
        """Return begin and end of every stretch of travel below ``slow_mps``, in m, in order."""
        return tuple(self._stretches(slow_mps * MEAN_S, MEAN_S))

    def _stretches(self, least_m: float, during_s: float) -> Iterator[tuple[float, float]]:
        """Yield the stretches from whose places on less than ``least_m`` is travelled ``during_s``.

        One into which no vehicle can brake is no travel: the encoder has lost its counts there.
        """
        ahead = round(during_s / WINDOW_S)
        if self.distance_m.size <= ahead:
            return
        slower = self.distance_m[ahead:] - self.distance_m[:-ahead] < least_m
        edges = np.flatnonzero(np.diff(slower, prepend=False, append=False))
        fastest = least_m / during_s + HARDEST * during_s
        for begin, end in edges.reshape(-1, 2).tolist():
            if self.speed_mps[begin] <= fastest:
                yield float(self.distance_m[begin]), float(self.distance_m[end])


def _stride(channel: Channel) -> int:
    if isinstance(channel.clock, StampedClock):
        return 1
    return max(1, round(WINDOW_S * float(channel.clock.rate)))
