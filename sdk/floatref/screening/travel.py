"""Travel speed from the encoder."""

import numpy as np

from floatref.screening.damage.encoder_path import times_at
from floatref.stages.signals import DISTANCE
from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import every

PROGRESS_S = 0.05
"""Encoder progress over this time gives the speed (5.6)."""


def travel_speed(recording: Recording) -> tuple[FloatArray, FloatArray]:
    """Return distances in m and the speeds there in m/s, every 0.05 s of the run.

    Speed is the encoder's progress over the 0.05 s before; missing samples are passed over. Both
    are empty for a run that short.
    """
    channel = recording.channel(DISTANCE, recording.tracks[0])
    stride = _stride(channel)
    distance = every(stride, channel.values)
    known = np.flatnonzero(~np.isnan(distance))
    times, distance = times_at(channel, stride * known), distance[known]
    even = np.arange(times[0], times[-1], PROGRESS_S) if times.size else times
    distance = np.interp(even, times, distance)
    return distance[1:], np.diff(distance) / PROGRESS_S


def fastest_speed(recording: Recording) -> float:
    """Return the fastest mean speed over a second, in m/s; over the run if that is shorter."""
    speeds = travel_speed(recording)[1]
    if not speeds.size:
        return 0.0
    window = min(round(1.0 / PROGRESS_S), speeds.size)
    sums = np.convolve(speeds, np.ones(window), "valid")
    return max(0.0, float(sums.max()) / window)


def _stride(channel: Channel) -> int:
    if isinstance(channel.clock, StampedClock):
        return 1
    return max(1, round(PROGRESS_S * float(channel.clock.rate)))
