"""Where runs of one road lie against the first of them: their place, and their lag there."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from floatref.errors import InputError
from floatref.measures import agreement, on_common_grid
from floatref.measures.locating.shift import Shift, find_shift
from floatref.values.arrays import BoolArray
from floatref.values.parts.windows import Window, cut_profile
from floatref.values.profile import Profile

LONGEST_M = 1000.0
"""Longest stretch in m from which a lag is found: more changes nothing but the time it takes."""
LARGEST_M = 1.0
"""Largest lag in m that is searched."""
FARTHEST_M = 1000.0
"""Farthest place in m at which a run is looked for: it bounds time and memory of a long one."""


def find_place(reference: Profile, profile: Profile) -> Shift:
    """Return how far in m ``profile`` lies from its place on ``reference``, by `find_shift`.

    By the wheel paths that both have, over the longest stretch of ``reference``, up to
    `LONGEST_M`, in which all of them are valid. A place farther away than `FARTHEST_M` is not sure.
    """
    names = [name for name in reference if name in profile]
    if not names:
        return Shift(np.nan, "it has no wheel path of the reference")
    try:
        mine, its = (_of_paths(each, names) for each in (reference, profile))
        return find_shift(*_about_longest(mine, its, FARTHEST_M))
    except InputError:
        return Shift(np.nan, f"no part of it lies within {FARTHEST_M:g} m of the reference's")


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
        mine, its = (_of_paths(each, [name]) for each in (reference, profile))
        expected, found = on_common_grid(*_about_longest(mine, its, 2 * LARGEST_M))
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


def _of_paths(profile: Profile, names: Sequence[str]) -> Profile:
    return replace(profile, tracks=tuple(profile[name] for name in names))


def _about_longest(
    reference: Profile, profile: Profile, margin_m: float
) -> tuple[Profile, Profile]:
    """Return the longest valid stretch of ``reference``, and ``profile`` there and about it."""
    valid = np.logical_and.reduce([track.valid for track in reference.tracks])
    part = _longest(valid, LONGEST_M / reference.interval_m)
    begin = reference.start_m + part.start * reference.interval_m
    end = reference.start_m + (part.stop - 1) * reference.interval_m
    window, wide = Window(begin, end), Window(begin - margin_m, end + margin_m)
    return cut_profile(reference, window), cut_profile(profile, wide)


def _longest(valid: BoolArray, most: float) -> slice:
    """Return the longest stretch that is ``valid``, its middle ``most`` points if it has more."""
    edges = np.flatnonzero(np.diff(valid, prepend=False, append=False)).reshape(-1, 2)
    if not edges.size:
        raise InputError("no point is valid")
    first, end = edges[np.argmax(edges[:, 1] - edges[:, 0])].tolist()
    spare = max(0, end - first - int(most)) // 2
    return slice(first + spare, end - spare)
