"""Two profiles on one grid: the stretch of distance that both cover."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.measures.gaps import check_heights
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile, ProfileTrack

SAME_POINT = 1e-6
"""Points nearer than this, in intervals, are the same point: start positions are rounded."""


def on_common_grid(reference: Profile, profile: Profile) -> tuple[Profile, Profile]:
    """Return both profiles on the reference's points within the stretch that both cover.

    ``profile`` is interpolated linearly in distance between its points, without any filter
    against aliasing; a point is NaN next to a missing one, and valid between two valid ones.
    1-σ is dropped from it. Raises InputError where the two overlap by less than two points, and
    for an elevation beyond 1000 km.
    """
    for track in (*reference.tracks, *profile.tracks):
        _check_heights(track)
    step = reference.interval_m / profile.interval_m
    first = (reference.start_m - profile.start_m) / profile.interval_m
    index = first + step * np.arange(_size(reference), dtype=np.float64)
    nearest = np.rint(index)
    same = np.abs(index - nearest) < SAME_POINT
    index[same] = nearest[same]
    inside = np.flatnonzero((index >= 0) & (index <= _size(profile) - 1))
    if inside.size < 2:
        raise InputError(
            f"the profiles do not overlap: the reference covers {_span(reference)}, "
            f"the profile {_span(profile)}"
        )
    cut = slice(int(inside[0]), int(inside[-1]) + 1)
    start = reference.start_m + cut.start * reference.interval_m
    kept = tuple(_cut(track, cut) for track in reference.tracks)
    moved = tuple(_interpolated(track, index[cut]) for track in profile.tracks)
    return (
        replace(reference, tracks=kept, start_m=start),
        replace(profile, tracks=moved, start_m=start, interval_m=reference.interval_m),
    )


def _check_heights(track: ProfileTrack) -> None:
    """Raise InputError naming ``track`` for an elevation that no road reaches."""
    try:
        check_heights(track.elevation)
    except InputError as error:
        raise InputError(f"track {track.name}: {error}") from error


def _size(profile: Profile) -> int:
    """Return the number of points."""
    return profile.tracks[0].elevation.size


def _span(profile: Profile) -> str:
    """Return the stretch of distance that ``profile`` covers, in words."""
    return f"{profile.start_m:g} to {profile.start_m + profile.length_m:g} m"


def _cut(track: ProfileTrack, stretch: slice) -> ProfileTrack:
    """Return the points of ``stretch`` of ``track``."""
    sigma = None if track.sigma is None else track.sigma[stretch]
    return ProfileTrack.of(track.name, track.elevation[stretch], track.valid[stretch], sigma)


def _interpolated(track: ProfileTrack, index: FloatArray) -> ProfileTrack:
    """Return ``track`` at the fractional points ``index``."""
    low = np.floor(index).astype(np.int64)
    fraction = index - low
    high = np.where(fraction > 0, low + 1, low)
    z = track.elevation
    elevation = np.where(fraction > 0, z[low] + fraction * (z[high] - z[low]), z[low])
    return ProfileTrack.of(track.name, elevation, _both(track.valid, low, high))


def _both(valid: BoolArray, low: NDArray[np.int64], high: NDArray[np.int64]) -> BoolArray:
    """Return where both neighbours are valid."""
    return np.asarray(valid[low] & valid[high])
