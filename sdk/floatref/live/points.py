"""Points that a stream gives out, and the profile that they make."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.live.window_records import describe_windows
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack

LONGEST_GAP_M = 10_000.0
"""Longest stretch without points in m that a profile holds as missing points."""


class State(StrEnum):
    """Whether points may still change."""

    PROVISIONAL = "provisional"
    """They are replaced by final ones."""
    FINAL = "final"
    """They never change."""


@dataclass(frozen=True, eq=False)
class LivePoints:
    """Successive points of a profile: number ``first`` + k lies at its number times the interval.

    Attributes:
        first: number of the first point, from the origin of the axis of distance.
        interval_m: distance between points in m.
        tracks: elevation, validity and, where known, 1-σ of every wheel path; empty within a stream
            where there are events and no points.
        state: whether they are final.
        pipeline: the name of what made them.
        events: what happened there, one line each.
        record: of final points, what made them: window, settings, and the engine's record.
    """

    first: int
    interval_m: float
    tracks: tuple[ProfileTrack, ...]
    state: State
    pipeline: str = ""
    events: tuple[str, ...] = ()
    record: Mapping[str, Any] = field(default_factory=dict)

    def __len__(self) -> int:
        """Return the number of points."""
        return self.tracks[0].elevation.size if self.tracks else 0

    def __repr__(self) -> str:
        """Return state and place on one line."""
        at_m = self.distance_m
        if not at_m.size:
            return f"LivePoints(0 {self.state}, {len(self.events)} events)"
        return f"LivePoints({len(self)} {self.state}, from {at_m[0]:.2f} to {at_m[-1]:.2f} m)"

    @property
    def distance_m(self) -> FloatArray:
        """Distance of every point in m, shape (N,)."""
        return (self.first + np.arange(len(self), dtype=np.float64)) * self.interval_m

    def __getitem__(self, name: str) -> ProfileTrack:
        """Return the wheel path called ``name``; InputError if it is missing."""
        return Profile(self.interval_m, self.tracks).track(name)


def carry_events(points: Sequence[LivePoints]) -> tuple[list[LivePoints], list[LivePoints]]:
    """Return ``points`` up to the last one that has any, and those with the events of the others.

    A reader gets no element without points: its events come with the next one.
    """
    end = max((n + 1 for n, each in enumerate(points) if each.tracks), default=0)
    made: list[LivePoints] = []
    before: tuple[str, ...] = ()
    for each in points[:end]:
        if not each.tracks:
            before = (*before, *each.events)
            continue
        made.append(replace(each, events=(*before, *each.events)) if before else each)
        before = ()
    return list(points[:end]), made


def join_points(points: Iterable[LivePoints]) -> Profile:
    """Return the profile of the final ones of ``points``, in order; others are left out.

    Points between two of them that were never measured are missing. Its record has that of every
    window, see `describe_windows`. Raises InputError without a final point.
    """
    final = [each for each in points if each.state is State.FINAL and len(each)]
    if not final:
        raise InputError("the stream has no final point; push samples of a vehicle that moves")
    made = next((each for each in final if each.pipeline), final[0])
    names = [track.name for track in made.tracks]
    parts = [_without_missing(names, each, before) for before, each in _pairs(final)]
    tracks = (_join([part[n] for part in parts], name) for n, name in enumerate(names))
    made_by = describe_points(made)
    live = describe_windows([each.record for each in final])
    return Profile(
        interval_m=made.interval_m,
        tracks=tuple(tracks),
        start_m=final[0].first * made.interval_m,
        pipeline=made_by["pipeline"],
        settings=made_by["settings"],
        provenance={**made_by["provenance"], "live": live},
    )


def describe_points(made: LivePoints) -> dict[str, Any]:
    """Return pipeline, settings and provenance of a profile with the points ``made``."""
    provenance = dict(made.record.get("provenance", {}))
    settings = made.record.get("settings", {})
    return {"pipeline": made.pipeline, "settings": settings, "provenance": provenance}


def record_of_window(points: LivePoints) -> dict[str, Any]:
    """Return what the provenance of a profile holds about the window of final ``points``."""
    return {k: v for k, v in points.record.items() if k != "settings"}


def missing_points(names: Sequence[str], count: int) -> tuple[ProfileTrack, ...]:
    """Return ``count`` points without elevation for the wheel paths called ``names``."""
    return tuple(ProfileTrack.of(name, np.full(count, np.nan)) for name in names)


def _pairs(final: list[LivePoints]) -> Iterable[tuple[LivePoints | None, LivePoints]]:
    return zip([None, *final[:-1]], final, strict=True)


def _without_missing(
    names: Sequence[str], points: LivePoints, before: LivePoints | None
) -> list[list[ProfileTrack]]:
    """Return the tracks of ``points``, each behind what is missing since ``before``."""
    gap = 0 if before is None else points.first - before.first - len(before)
    if gap < 0:
        raise InputError(f"points from {points.first} on come twice; join each piece once")
    if gap * points.interval_m > LONGEST_GAP_M:
        raise InputError(
            f"no points for {gap * points.interval_m:.0f} m before {points.distance_m[0]:.2f} m; "
            "join the stretches on either side for themselves"
        )
    own = [[track] for track in points.tracks]
    return (
        own if gap == 0 else [[m, *o] for m, o in zip(missing_points(names, gap), own, strict=True)]
    )


def _join(parts: Sequence[list[ProfileTrack]], name: str) -> ProfileTrack:
    tracks = [track for part in parts for track in part]
    sigma = None
    if any(track.sigma is not None for track in tracks):
        sigma = np.concatenate([_sigma(track) for track in tracks])
    elevation = np.concatenate([track.elevation for track in tracks])
    return ProfileTrack.of(name, elevation, np.concatenate([t.valid for t in tracks]), sigma)


def _sigma(track: ProfileTrack) -> FloatArray:
    return np.full(track.elevation.size, np.nan) if track.sigma is None else track.sigma
