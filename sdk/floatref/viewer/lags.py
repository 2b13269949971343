"""How far along runs of one road lie against the first of them."""

from dataclasses import replace

import numpy as np

from floatref.errors import InputError
from floatref.measures import agreement, on_common_grid
from floatref.values.arrays import BoolArray
from floatref.values.parts.windows import Window, cut_profile
from floatref.values.profile import Profile

LONGEST_M = 1000.0
"""Longest stretch in m from which a lag is found: more changes nothing but the time it takes."""
LARGEST_M = 1.0
"""Largest lag in m that is searched."""


def lag_of(reference: Profile, profile: Profile) -> float:
    """Return how far in m ``profile`` lies along ``reference``, above zero where it is farther.

    It is the offset of `agreement` of the IRI filter's output, within ±`LARGEST_M`, over the
    longest stretch, up to `LONGEST_M`, in which a wheel path is valid in both, the median of the
    wheel paths that both have. NaN where there is no such stretch.
    """
    found = [_lag(reference, profile, name) for name in reference if name in profile]
    known = [lag for lag in found if lag == lag]
    return float(np.median(known)) if known else np.nan


def _lag(reference: Profile, profile: Profile, name: str) -> float:
    try:
        sides = [replace(side, tracks=(side[name],)) for side in (reference, profile)]
        expected, found = on_common_grid(*_common_kilometre(*sides))
        both = expected[name].valid & found[name].valid
        part = _longest(both, LONGEST_M / expected.interval_m)
        return agreement(
            expected[name].elevation[part],
            found[name].elevation[part],
            expected.interval_m,
            max_offset_m=LARGEST_M,
        ).offset_m
    except InputError:
        return np.nan


def _common_kilometre(reference: Profile, profile: Profile) -> tuple[Profile, Profile]:
    """Return the part of both in which the longest valid stretch of the reference lies."""
    (track,) = reference.tracks
    part = _longest(track.valid, LONGEST_M / reference.interval_m)
    begin = reference.start_m + part.start * reference.interval_m
    window = Window(begin, reference.start_m + part.stop * reference.interval_m)
    wide = Window(begin - 2 * LARGEST_M, begin + LONGEST_M + 2 * LARGEST_M)
    return cut_profile(reference, window), cut_profile(profile, wide)


def _longest(valid: BoolArray, most: float) -> slice:
    """Return the longest stretch that is ``valid``, its middle ``most`` points if it has more."""
    edges = np.flatnonzero(np.diff(valid, prepend=False, append=False)).reshape(-1, 2)
    if not edges.size:
        raise InputError("no point is valid")
    first, end = edges[np.argmax(edges[:, 1] - edges[:, 0])].tolist()
    spare = max(0, end - first - int(most)) // 2
    return slice(first + spare, end - spare)
