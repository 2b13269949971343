"""Two profiles on the same points: those of a reference, along which the other is linear."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.measures.gaps import check_heights
from floatref.values.arrays import BoolArray, FloatArray, IndexArray, release
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.scanning import CHUNK, flags_where

SAME_POINT = 1e-6
"""Points nearer than this, in intervals, are the same point: start positions are rounded."""


def on_common_grid(reference: Profile, profile: Profile) -> tuple[Profile, Profile]:
    """Return both profiles on the reference's points within the stretch that both cover.

    ``profile`` is interpolated linearly in distance between its points, without any filter
    against aliasing; a point is NaN next to a missing one, and valid between two valid ones.
    1-σ is dropped from it. Raises InputError where the two overlap by less than two points, and
    for an elevation beyond 1000 km.
    """
    places, cut = _overlap(reference, profile)
    start = reference.start_m + cut.start * reference.interval_m
    kept = tuple(_cut(track, cut) for track in reference.tracks)
    moved = tuple(_interpolate(track, places, cut) for track in profile.tracks)
    return (
        replace(reference, tracks=kept, start_m=start),
        replace(profile, tracks=moved, start_m=start, interval_m=reference.interval_m),
    )


@dataclass(frozen=True, eq=False)
class CommonPath:
    """A wheel path of two profiles, on the reference's points that both cover, read in parts.

    Every part is that of `on_common_grid`: an hour of road is never in memory as a whole.

    Attributes:
        reference, profile: the wheel path as it is in each of them, without its 1-σ.
        interval_m, start_m: of the common points.
        size: how many there are.
    """

    reference: ProfileTrack
    profile: ProfileTrack
    interval_m: float
    start_m: float
    size: int
    _places: "_Places"
    _first: int

    @classmethod
    def of(cls, reference: Profile, profile: Profile, name: str) -> "CommonPath":
        """Return the wheel path ``name`` of both; InputError as `on_common_grid`."""
        bare = [replace(each.track(name), sigma=None) for each in (reference, profile)]
        one, other = replace(reference, tracks=(bare[0],)), replace(profile, tracks=(bare[1],))
        places, cut = _overlap(one, other)
        start_m = reference.start_m + cut.start * reference.interval_m
        size = cut.stop - cut.start
        return cls(bare[0], bare[1], reference.interval_m, start_m, size, places, cut.start)

    def expected(self, first: int, end: int) -> ProfileTrack:
        """Return the common points from ``first`` to before ``end`` of the reference."""
        return _cut(self.reference, slice(self._first + first, self._first + end))

    def found(self, first: int, end: int) -> ProfileTrack:
        """Return the profile at the common points from ``first`` to before ``end``."""
        cut = slice(self._first + first, self._first + end)
        return _interpolate(self.profile, self._places, cut)

    def usable(self, of_valid: bool) -> BoolArray:
        """Return which common points are valid in both, or else measured in both, shape (n,)."""
        mine, its = (
            t.valid if of_valid else flags_where(np.isfinite, t.elevation)
            for t in (self.reference, self.profile)
        )
        both = np.empty(self.size, dtype=np.bool_)
        for first in range(0, self.size, CHUNK):
            here = slice(self._first + first, self._first + min(first + CHUNK, self.size))
            low, high, _ = _neighbours(self._places.at(here.start, here.stop))
            both[first : first + CHUNK] = mine[here] & its[low] & its[high]
        return both


def _overlap(reference: Profile, profile: Profile) -> tuple["_Places", slice]:
    """Return where the reference's points lie in ``profile``, and which of them lie inside."""
    for track in (*reference.tracks, *profile.tracks):
        _check_heights(track)
    places = _Places.of(reference, profile)
    cut = places.inside(_size(reference), _size(profile))
    if cut.stop - cut.start < 2:
        raise InputError(
            f"the profiles do not overlap: the reference covers {_span(reference)}, "
            f"the profile {_span(profile)}"
        )
    return places, cut


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


class _Places(NamedTuple):
    """Where the points of a reference lie in a profile, in points of that: first + step k."""

    first: float
    step: float

    @classmethod
    def of(cls, reference: Profile, profile: Profile) -> "_Places":
        """Return the places of the points of ``reference`` in ``profile``."""
        first = (reference.start_m - profile.start_m) / profile.interval_m
        return cls(first, reference.interval_m / profile.interval_m)

    def at(self, begin: int, end: int) -> FloatArray:
        """Return the places of points from ``begin`` to before ``end``; same points are whole."""
        index = self.first + self.step * np.arange(begin, end, dtype=np.float64)
        nearest = np.rint(index)
        return np.where(np.abs(index - nearest) < SAME_POINT, nearest, index)

    def inside(self, count: int, size: int) -> slice:
        """Return which of ``count`` points lie from the first to the last of ``size`` points."""
        begin = self._next(-self.first / self.step, lambda place: place >= 0, count)
        last = (size - 1 - self.first) / self.step
        return slice(begin, self._next(last, lambda place: place > size - 1, count))

    def _next(self, near: float, met: Callable[[float], bool], count: int) -> int:
        """Return the first of ``count`` points, next to ``near``, whose place has ``met``."""
        guess = int(min(max(math.floor(near) - 2, 0), count))
        while guess < count and not met(float(self.at(guess, guess + 1)[0])):
            guess += 1
        return guess


def _interpolate(track: ProfileTrack, places: _Places, cut: slice) -> ProfileTrack:
    """Return ``track`` at the places of the points ``cut``; where all are its own, these."""
    begin = float(places.at(cut.start, cut.start + 1)[0])
    if places.step == 1.0 and begin.is_integer():
        same = slice(int(begin), int(begin) + cut.stop - cut.start)
        return ProfileTrack.of(track.name, track.elevation[same], track.valid[same])
    elevation = np.empty(cut.stop - cut.start)
    valid = np.empty(elevation.size, dtype=np.bool_)
    for first in range(0, elevation.size, CHUNK):
        inside = slice(first, min(first + CHUNK, elevation.size))
        at = places.at(cut.start + inside.start, cut.start + inside.stop)
        elevation[inside], valid[inside] = _at(track, at)
        release(track.elevation)
    return ProfileTrack.of(track.name, elevation, valid)


def _at(track: ProfileTrack, index: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Return elevation and validity of ``track`` at the fractional points ``index``."""
    low, high, fraction = _neighbours(index)
    z = track.elevation
    elevation = np.where(fraction > 0, z[low] + fraction * (z[high] - z[low]), z[low])
    return elevation, track.valid[low] & track.valid[high]


def _neighbours(index: FloatArray) -> tuple[IndexArray, IndexArray, FloatArray]:
    """Return the points before and after the fractional ``index``, and its part of the way.

    Both are the same where it is a point.
    """
    low = np.floor(index).astype(np.int64)
    fraction = index - low
    return low, np.where(fraction > 0, low + 1, low), fraction
