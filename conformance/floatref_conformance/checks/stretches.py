"""Cut the scored points from a profile."""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.errors import DeviceError

Stretches = tuple[tuple[float, float], ...]
"""Start and end of each of several stretches, in m of true distance."""
END_M = 106.0
"""Distance in m of scored points from both ends: the high-pass (105.91 m) may omit points."""


def verify_stretches(stretches: Stretches, length_m: float) -> Stretches:
    """Return the ``stretches`` of a run of ``length_m``.

    Raises InputError if one is empty, or lies within `END_M` of an end of the run.
    """
    for start, end in stretches:
        if not END_M <= start < end <= length_m - END_M:
            raise InputError(
                f"length_m is {length_m:g}: {start:g} m to {end:g} m is judged, which must lie "
                f"{END_M:g} m from both ends"
            )
    return stretches


def points(profile: Profile, start_m: float, end_m: float) -> slice:
    """Return the indices of the points from ``start_m`` to ``end_m``, both included."""
    first = int(np.ceil((start_m - profile.start_m) / profile.interval_m - 1e-6))
    last = int(np.floor((end_m - profile.start_m) / profile.interval_m + 1e-6))
    return slice(max(first, 0), max(last + 1, 0))


def stretch(profile: Profile, track: str, start_m: float, end_m: float) -> FloatArray:
    """Return the elevations in m of ``track`` from ``start_m`` to ``end_m``.

    Every point counts, valid or not: raises DeviceError if one has no elevation.
    """
    elevation = profile.track(track).elevation[points(profile, start_m, end_m)]
    missing = int(np.isnan(elevation).sum())
    if missing or elevation.size == 0:
        raise DeviceError(
            f"track {track}: {missing} of {elevation.size} points without elevation from "
            f"{start_m:.1f} m to {end_m:.1f} m, where every point counts"
        )
    return elevation
