"""Travel speed from the encoder."""

import numpy as np

from floatref.stages.signals import DISTANCE
from floatref.values.arrays import FloatArray
from floatref.values.recording import Recording

PROGRESS_S = 0.05
"""Encoder progress over this time gives the speed (5.6)."""


def travel_speed(recording: Recording) -> tuple[FloatArray, FloatArray]:
    """Return distances in m and the speeds there in m/s, every 0.05 s of the run.

    Speed is the encoder's progress over the 0.05 s before; missing samples are passed over.
    """
    channel = recording.channel(DISTANCE, recording.tracks[0])
    known = ~np.isnan(channel.values)
    begin, end = channel.span_s
    times = np.arange(begin, end, PROGRESS_S)
    distance = np.interp(times, channel.times_s[known], channel.values[known])
    return distance[1:], np.diff(distance) / PROGRESS_S
