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
    found = [np.diff(part) for _, part in chunks(encoder.values, overlap=1)]
    steps = np.concatenate([each[each > 0] for each in found])
    usual = _usual(steps)
    if not usual > LONGEST_M:
        return
    yield Doubt(
        (encoder.id,),
        f"channel {encoder.id}: goes on in steps of {usual:.3g} m; the places between are not "
        "known: record every count with its time, or use an encoder of more counts",
    )


def _usual(steps: FloatArray) -> float:
    """Return the step in which half of the distance, or more, is travelled; 0 without any."""
    if not steps.size:
        return 0.0
    steps = np.sort(steps)
    travelled = np.cumsum(steps)
    return float(steps[np.searchsorted(travelled, travelled[-1] / 2)])
