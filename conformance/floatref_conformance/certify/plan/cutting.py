"""Cutting reference and runs to a test section."""

import math
from dataclasses import replace

import numpy as np

from floatref.errors import InputError
from floatref.measures.locating.placing import MAX_OFFSET_M
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.plan.plan_document import Stretch

SAME_POINT = 1e-6
"""Points nearer than this, in intervals, are the same point: start positions are rounded."""


def section_of(reference: Profile, stretch_m: Stretch | None) -> Profile:
    """Return the points of ``reference`` from and to ``stretch_m``, both included.

    Without a stretch it is what every wheel path measured, less what is missing at the ends.
    Raises InputError for a stretch that the reference does not hold, or in which it has points
    without elevation: a straight line over them would be no truth.
    """
    if stretch_m is not None:
        _check_stretch(reference, stretch_m)
        found = _points(reference, *_inner(reference, stretch_m))
    else:
        found = _trim_unmeasured(reference)
    for track in found.tracks:
        missing = np.flatnonzero(np.isnan(track.elevation))
        if missing.size:
            where = found.start_m + found.interval_m * float(missing[0])
            raise InputError(
                f"track {track.name} of the reference has {missing.size} points without elevation "
                f"in the section, from {where:.2f} m on; give a section that it measured"
            )
    return found


def within(profile: Profile, start_m: float, end_m: float) -> Profile:
    """Return ``profile`` from the last point before ``start_m`` to the first after ``end_m``.

    The same object where it is no longer than that and reaches beyond by no more than
    `MAX_OFFSET_M` at either end: an offset that the comparison finds. Raises InputError for one
    that does not reach the section.
    """
    ends = profile.start_m, profile.start_m + profile.length_m
    longer = profile.length_m > end_m - start_m + profile.interval_m
    beyond = max(start_m - ends[0], ends[1] - end_m)
    if not longer and beyond <= MAX_OFFSET_M + profile.interval_m:
        return profile
    first = math.floor((start_m - ends[0]) / profile.interval_m + SAME_POINT)
    last = math.ceil((end_m - ends[0]) / profile.interval_m - SAME_POINT)
    cut = max(first, 0), min(last, profile.tracks[0].elevation.size - 1)
    if cut[1] <= cut[0]:
        raise InputError(
            f"the run covers {ends[0]:g} to {ends[1]:g} m, nothing of the section from "
            f"{start_m:g} to {end_m:g} m; give runs over the section"
        )
    return _points(profile, *cut)


def _check_stretch(reference: Profile, stretch_m: Stretch) -> None:
    """Raise InputError unless ``reference`` holds ``stretch_m``."""
    start, end = stretch_m
    first, last = reference.start_m, reference.start_m + reference.length_m
    if not (math.isfinite(start) and math.isfinite(end) and start < end):
        raise InputError(
            f"section {start:g}:{end:g}: give FROM:TO in m, the first below the second"
        )
    margin = reference.interval_m
    if start < first - margin or end > last + margin:
        raise InputError(
            f"section {start:g}:{end:g} m reaches beyond the reference, which covers "
            f"{first:g} to {last:g} m; give a section that it holds"
        )


def _inner(profile: Profile, stretch_m: Stretch) -> tuple[int, int]:
    """Return the first and the last point within ``stretch_m``."""
    steps = [(edge - profile.start_m) / profile.interval_m for edge in stretch_m]
    first, last = math.ceil(steps[0] - SAME_POINT), math.floor(steps[1] + SAME_POINT)
    first, last = max(first, 0), min(last, profile.tracks[0].elevation.size - 1)
    if last <= first:
        raise InputError(
            f"section {stretch_m[0]:g}:{stretch_m[1]:g} m holds no two points of the reference; "
            "give a longer one"
        )
    return first, last


def _trim_unmeasured(reference: Profile) -> Profile:
    """Return ``reference`` from its first to its last point that every wheel path measured."""
    measured = np.all([np.isfinite(track.elevation) for track in reference.tracks], axis=0)
    points = np.flatnonzero(measured)
    if points.size < 2:
        raise InputError("the reference has no two points that all wheel paths measured")
    return _points(reference, int(points[0]), int(points[-1]))


def _points(profile: Profile, first: int, last: int) -> Profile:
    """Return points ``first`` to ``last``, both included; the same object if those are all."""
    if first == 0 and last == profile.tracks[0].elevation.size - 1:
        return profile
    part = slice(first, last + 1)
    tracks = tuple(
        ProfileTrack.of(
            track.name,
            track.elevation[part],
            track.valid[part],
            None if track.sigma is None else track.sigma[part],
        )
        for track in profile.tracks
    )
    start_m = profile.start_m + first * profile.interval_m
    return replace(profile, tracks=tracks, start_m=start_m)
