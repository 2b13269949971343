"""The short-interval roughness of a wheel path, and which of it rests on valid points alone."""

import numpy as np

from floatref.errors import InputError
from floatref.measures.roughness.roughness_profile import short_interval_roughness
from floatref.measures.valid_iri import valid_stretches
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import ProfileTrack


def roughness_of(track: ProfileTrack, interval_m: float) -> tuple[FloatArray, BoolArray]:
    """Return the roughness in m/km of every interval, and which lie in a stretch that counts.

    Each of these stretches is measured as a profile of its own. NaN for a profile that is too short
    for the car, or whose interval is too long for it.
    """
    trace = np.empty(track.elevation.size - 1)
    counted = np.zeros(trace.size, dtype=np.bool_)
    _trace(track.elevation, interval_m, trace)
    for stretch in valid_stretches(track.valid, interval_m):
        inside = slice(stretch.start, stretch.stop - 1)
        _trace(track.elevation[stretch], interval_m, trace[inside])
        counted[inside] = True
    return trace, counted


def _trace(elevation: FloatArray, interval_m: float, out: FloatArray) -> None:
    try:
        short_interval_roughness(elevation, interval_m, out=out)
    except InputError:
        out.fill(np.nan)
