"""An encoder that is read at a steady rate and steps so far that its places are not known."""

from collections.abc import Iterator

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt
from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Recording
from floatref.values.scanning import chunks

LONGEST_M = 0.25
"""Longest usual step in m: the moving average of the IRI. Counts with their own time stamps may be
any distance apart, as the way between two is linear; those that wait to be read may not."""


def step_doubts(recording: Recording) -> Iterator[Doubt]:
    """Yield a doubt about an encoder that is delivered in steps of more than `LONGEST_M`."""
    encoder = recording.channel("distance", recording.tracks[0])
    if not isinstance(encoder.clock, UniformClock):
        return
    usual = _usual(encoder.values)
    if usual <= LONGEST_M:
        return
    yield Doubt(
        (encoder.id,),
        f"channel {encoder.id}: goes on in steps of {usual:.3g} m; the places between are not "
        "known: record every count with its time, or use an encoder of more counts",
    )


def _usual(values: FloatArray) -> float:
    """Return the step in m in which half of the distance ``values``, or more, is travelled.

    Only steps of more than `LONGEST_M` are held in memory; 0 if the step is not one of these.
    """
    travelled, long = 0.0, [np.empty(0)]
    for _, part in chunks(values, overlap=1):
        steps = np.diff(part)
        travelled += float(np.sum(steps, where=steps > 0))
        long.append(steps[steps > LONGEST_M])
    steps = np.sort(np.concatenate(long))
    in_short = travelled - float(steps.sum())
    if not steps.size or in_short >= travelled / 2:
        return 0.0
    return float(steps[np.searchsorted(in_short + np.cumsum(steps), travelled / 2)])
