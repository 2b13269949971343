"""From windows to final points: cores one behind another, each fading into the next.

Both windows measure the same road behind a joint. What they differ by is smooth, since it is of
their ends; over the length L of the fade, one passes into the other with the weight w(u) = u³ (10 -
15u + 6u²), whose first and second derivatives are zero at both ends. The largest slope that a
difference d brings is 1.875 d/L beside its own.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from floatref.live.points import LivePoints, State, missing_points
from floatref.values.arrays import FloatArray
from floatref.values.profile import ProfileTrack


@dataclass(frozen=True, eq=False)
class WindowPoints:
    """All points that one window has measured, its run-in and run-out too.

    Attributes:
        first: number of the first of them.
        tracks: elevation, validity and 1-σ of every wheel path; empty for a window without any.
    """

    first: int
    tracks: tuple[ProfileTrack, ...]

    @property
    def end(self) -> int:
        """Number behind the last point."""
        return self.first + (self.tracks[0].elevation.size if self.tracks else 0)

    def part(self, low: int, high: int) -> "WindowPoints":
        """Return the points from number ``low`` to ``high`` - 1 that there are."""
        low, high = max(low, self.first), min(high, self.end)
        where = slice(low - self.first, max(high, low) - self.first)
        if low >= high:
            return WindowPoints(low, ())
        return WindowPoints(low, tuple(_part(track, where) for track in self.tracks))


@dataclass
class Joints:
    """Joins windows into final points.

    Attributes:
        names: the wheel paths.
        interval_m: distance between points in m.
        fade: number of points over which a window passes into the next.
        next: number of the next point to give out; None before the first.
        tail: points of the window before, behind its joint.
    """

    names: tuple[str, ...]
    interval_m: float
    fade: int
    next: int | None = None
    tail: WindowPoints = field(default_factory=lambda: WindowPoints(0, ()))

    def add(self, window: WindowPoints, joint: int | None, **about: Any) -> LivePoints | None:
        """Return the points that are final now; ``about`` are further fields of theirs.

        ``joint`` is the number of the first point that the next window measures as well, None if
        the next one does not overlap.
        """
        first = self._begin(window)
        if first is None:
            return None
        end = max(window.end, self.tail.end) if joint is None else joint
        end = max(end, first)
        stop = end if joint is None else max(end, min(window.end, end + self.fade))
        # A core shorter than the fade goes on fading in the tail.
        joined = WindowPoints(first, self._tracks(window, first, stop))
        self.next, self.tail = end, joined.part(end, stop)
        if end == first:
            return None
        return LivePoints(
            first, self.interval_m, joined.part(first, end).tracks, State.FINAL, **about
        )

    def no_points(self, events: tuple[str, ...]) -> LivePoints:
        """Return no points, with what happened to a window before the first one."""
        return LivePoints(self.next or 0, self.interval_m, (), State.FINAL, events=events)

    def _begin(self, window: WindowPoints) -> int | None:
        """Return the first point to give out: the one behind the last, if it is measured."""
        if self.tail.tracks or (self.next is not None and not window.tracks):
            return self.next
        if not window.tracks:
            return None
        return window.first if self.next is None else max(self.next, window.first)

    def _tracks(self, window: WindowPoints, first: int, stop: int) -> tuple[ProfileTrack, ...]:
        if stop == first:
            return ()
        own = _fill(window, self.names, first, stop)
        if not self.tail.tracks:
            return own
        before = _fill(self.tail, self.names, first, stop)
        weights = _weights(first, stop, self.tail)
        return tuple(_blend(b, o, weights) for b, o in zip(before, own, strict=True))


def smooth_step(part: FloatArray) -> FloatArray:
    """Return the weight of the second window at a ``part``, 0 to 1, of the fade."""
    u = np.clip(part, 0.0, 1.0)
    return np.asarray(u**3 * (10.0 - 15.0 * u + 6.0 * u**2))


def _weights(first: int, end: int, tail: WindowPoints) -> FloatArray:
    number = np.arange(first, end)
    return smooth_step((number - tail.first + 0.5) / (tail.end - tail.first))


def _fill(
    window: WindowPoints, names: tuple[str, ...], first: int, end: int
) -> tuple[ProfileTrack, ...]:
    """Return points ``first`` to ``end`` - 1; NaN where the window has not measured them."""
    part = window.part(first, end)
    if not part.tracks:
        return missing_points(names, end - first)
    before, behind = part.first - first, end - part.end
    return tuple(_pad(track, before, behind) for track in part.tracks)


def _pad(track: ProfileTrack, before: int, behind: int) -> ProfileTrack:
    if before == behind == 0:
        return track
    around = (before, behind)
    elevation = np.pad(track.elevation, around, constant_values=np.nan)
    sigma = track.sigma
    if sigma is not None:
        sigma = np.pad(sigma, around, constant_values=np.nan)
    return ProfileTrack.of(track.name, elevation, np.pad(track.valid, around), sigma)


def _blend(before: ProfileTrack, own: ProfileTrack, weights: FloatArray) -> ProfileTrack:
    """Return ``before`` with the weight 1 - w and ``own`` with w; where one is missing, the other.

    Points of both are valid if both are. The errors of both may be alike, so their 1-σ add up.
    """
    old, new = np.isfinite(before.elevation), np.isfinite(own.elevation)
    w = np.where(old & new, weights, np.where(new, 1.0, 0.0))
    elevation = _mean(before.elevation, own.elevation, w)
    valid = np.where(
        w == 0.0, before.valid, np.where(w == 1.0, own.valid, before.valid & own.valid)
    )
    sigma = None
    if before.sigma is not None or own.sigma is not None:
        sigma = _mean(_known(before), _known(own), w)
    return ProfileTrack.of(own.name, elevation, valid & np.isfinite(elevation), sigma)


def _mean(before: FloatArray, own: FloatArray, w: FloatArray) -> FloatArray:
    return np.where(w == 1.0, own, np.where(w == 0.0, before, before + w * (own - before)))


def _known(track: ProfileTrack) -> FloatArray:
    return np.full(track.elevation.size, np.nan) if track.sigma is None else track.sigma


def _part(track: ProfileTrack, where: slice) -> ProfileTrack:
    sigma = None if track.sigma is None else track.sigma[where]
    return replace(track, elevation=track.elevation[where], valid=track.valid[where], sigma=sigma)
