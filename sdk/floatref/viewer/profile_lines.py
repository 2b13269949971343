"""What is drawn of a profile: elevation with its 1-σ, roughness, IRI of segments, and speed."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.measures import IriSettings
from floatref.measures.locating.shift import Shift
from floatref.measures.valid_roughness import roughness_of
from floatref.measures.valid_segments import SegmentIri, segment_iris
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.viewer.drawn_lines import BIN_BYTES, MORE_BYTES, Line

ALONG, SPEED = "along_m", "speed_mps"
"""Of a profile's record of distance: where the speed is known, and the speed."""


@dataclass(frozen=True, eq=False)
class Run:
    """A profile under its name on the page, and the points of it that are shown.

    ``profile`` is on the axis of the page's first run, and ``place`` says where it lay before.
    """

    number: int
    name: str
    profile: Profile
    part: slice
    place: Shift

    @property
    def moved_m(self) -> float:
        """By how much it was moved back, in m; 0 where its place is not sure."""
        return self.place.placement_m if self.place.is_sure else 0.0

    @property
    def span_m(self) -> tuple[float, float]:
        """Distances in m of the first and the last point that is shown."""
        place = self.profile.start_m, self.profile.interval_m
        return place[0] + place[1] * self.part.start, place[0] + place[1] * (self.part.stop - 1)

    def sizes(self) -> list[tuple[int, int]]:
        """Return samples and bytes of a bin of the two long lines of every wheel path."""
        count = self.part.stop - self.part.start
        usual = BIN_BYTES + MORE_BYTES
        bands = [MORE_BYTES * (track.sigma is not None) for track in self.profile.tracks]
        return [(count, size) for band in bands for size in (usual + band, usual)]


def elevation_line(run: Run, track: ProfileTrack) -> Line:
    """Return the elevation of ``track`` in m, and the band of ±1-σ where that is known."""
    return Line(
        track.elevation[run.part],
        track.name,
        "distance",
        run.span_m[0],
        run.profile.interval_m,
        path=track.name,
        run=run.number,
        valid=track.valid[run.part],
        sigma=None if track.sigma is None else track.sigma[run.part],
    )


def roughness_line(run: Run, track: ProfileTrack) -> Line:
    """Return the short-interval roughness in m/km; a value belongs to the middle of an interval."""
    trace, counted = roughness_of(track, run.profile.interval_m)
    inside = slice(run.part.start, run.part.stop - 1)
    return Line(
        trace[inside],
        track.name,
        "distance",
        run.span_m[0] + run.profile.interval_m / 2.0,
        run.profile.interval_m,
        path=track.name,
        run=run.number,
        valid=counted[inside] & np.isfinite(trace[inside]),
    )


def run_segments(run: Run, track: ProfileTrack, segment_m: float) -> list[SegmentIri]:
    """Return the IRI of all of ``track``, then of every segment that is, in part, shown.

    Nothing for a profile that is too short for the car, or whose interval is too long for it.
    Raises InputError for a segment shorter than the interval.
    """
    settings = IriSettings(segment_m=segment_m)
    place = run.profile.interval_m, run.profile.start_m
    try:
        (whole,) = segment_iris(track, place[0], IriSettings(), place[1])
    except InputError:
        return []
    segments = segment_iris(track, place[0], settings, place[1])
    begin, end = run.span_m
    return [whole, *(s for s in segments if s.start_m < end and s.start_m + s.length_m > begin)]


def mean_line(run: Run, track: ProfileTrack, segments: Sequence[SegmentIri]) -> Line:
    """Return the IRI of the valid points of every segment in m/km, level from end to end.

    A segment that has other points too counts as not valid here: the page marks it.
    """
    # Two segments share no place, or one would hide the other there.
    ends = [(s.start_m, s.start_m + s.length_m * (1.0 - 1e-6)) for s in segments]
    means = np.repeat([s.valid_m_per_km for s in segments], 2)
    sound = np.repeat([not s.marked for s in segments], 2)
    at = np.ravel(ends)
    return Line(
        means,
        track.name,
        "distance",
        at=at,
        path=track.name,
        run=run.number,
        valid=sound & np.isfinite(means),
    )


def recorded_speed(profile: Profile) -> tuple[FloatArray, FloatArray] | None:
    """Return distances in m and speeds in m/s from the record of ``profile``; None without it."""
    record = profile.provenance.get("distance")
    if not isinstance(record, dict) or not {ALONG, SPEED} <= record.keys():
        return None
    along, speed = (np.asarray(record[key], dtype=np.float64) for key in (ALONG, SPEED))
    return (along, speed) if along.ndim == 1 and along.shape == speed.shape and along.size else None


def speed_line(run: Run) -> Line | None:
    """Return the speed in m/s over the distance from the record of a profile, if it has one."""
    found = recorded_speed(run.profile)
    if found is None:
        return None
    along, speed = found
    return Line(speed, run.name, "distance", at=along - run.moved_m, run=run.number)
