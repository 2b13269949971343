"""The rows of the summary that a profile gives: one for each segment of each wheel path."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, nan
from typing import Any

import numpy as np

from floatref.batch.results.positions import places
from floatref.batch.results.record import Row
from floatref.errors import InputError
from floatref.files.gis.lines import known_lines
from floatref.measures import IriSettings, mean_roughness_index
from floatref.measures.ride.segment_measures import (
    RideLimits,
    SegmentMeasures,
    segment_measures,
)
from floatref.measures.roughness.roughness_index import segment_edges
from floatref.measures.valid_segments import SegmentIri, invalid_lengths, segment_iris
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording

SPACING_M = 25.0
"""Largest distance in m between two places of a segment's line."""


def measure_segments(
    profile: Profile,
    segment_m: float | None,
    recording: Recording | None = None,
    measures: bool = False,
    limits: RideLimits | None = None,
) -> tuple[tuple[Row, ...], tuple[str, ...]]:
    """Return the rows of ``profile``, cut every ``segment_m``, and the measures that failed.

    None for the whole profile as one segment; positions are those of ``recording``, if it has any.
    The figures are those of `floatref iri --segment`; with ``measures`` each row has those of
    `segment_measures` by ``limits`` too. Raises InputError for a segment that is not
    above zero.
    """
    settings = IriSettings(segment_m=segment_m)
    edges, remarks = _edges(profile, segment_m)
    measured = []
    for track in profile.tracks:
        try:
            measured.append(
                segment_iris(track, profile.interval_m, settings, start_m=profile.start_m)
            )
        except InputError as error:
            # A profile too short or too coarse for the car is a profile all the same.
            remarks.append(f"track {track.name}: no IRI: {error}")
            measured.append(_without_iri(track, profile, edges))
    ride = _measure_ride(profile, edges, limits, remarks) if measures else None
    rows = [
        row
        for index, (track, segments) in enumerate(zip(profile.tracks, measured, strict=True))
        for row in _rows(
            track.name, segments, measured, recording, None if ride is None else ride[index]
        )
    ]
    return tuple(rows), tuple(remarks)


def _measure_ride(
    profile: Profile, edges: IndexArray, limits: RideLimits | None, remarks: list[str]
) -> Sequence[Sequence[SegmentMeasures]]:
    """Return the measures of every segment of every wheel path; add a remark if they fail."""
    try:
        return segment_measures(profile, edges, limits)
    except InputError as error:
        remarks.append(f"no measures of ride: {error}")
        return [[SegmentMeasures()] * (edges.size - 1)] * len(profile.tracks)


def _edges(profile: Profile, segment_m: float | None) -> tuple[IndexArray, list[str]]:
    """Return the first interval of every segment and the end, and remarks on them."""
    count = profile.tracks[0].elevation.size - 1
    whole = np.array([0, count], dtype=np.int64)
    if count == 0:
        return whole, []
    try:
        return segment_edges(count, profile.interval_m, segment_m), []
    except InputError as error:
        return whole, [f"not cut into segments: {error}"]


def _without_iri(
    track: ProfileTrack, profile: Profile, edges: IndexArray
) -> tuple[SegmentIri, ...]:
    starts = profile.start_m + edges[:-1] * profile.interval_m
    lengths = np.diff(edges) * profile.interval_m
    invalid = invalid_lengths(track, edges, profile.interval_m)
    columns = zip(starts.tolist(), lengths.tolist(), invalid.tolist(), strict=True)
    return tuple(SegmentIri(start, length, nan, 0.0, nan, lost) for start, length, lost in columns)


def _rows(
    track: str,
    segments: Sequence[SegmentIri],
    measured: Sequence[Sequence[SegmentIri]],
    recording: Recording | None,
    ride: Sequence[SegmentMeasures] | None,
) -> list[Row]:
    """Return the rows of ``track``; ``measured`` has the segments of every wheel path."""
    ways = _ways(recording, track, segments)
    together = zip(*measured, strict=True)
    return [
        replace(
            _row(track, number, segment, way.start, same),
            lines_deg=known_lines(way.latitude, way.longitude),
            measures=None if ride is None else ride[number],
        )
        for number, (segment, way, same) in enumerate(zip(segments, ways, together, strict=True))
    ]


def _row(
    track: str,
    number: int,
    segment: SegmentIri,
    place: tuple[float, float],
    same: Sequence[SegmentIri],
) -> Row:
    """Return one row; ``same`` is this segment in every wheel path."""
    latitude, longitude = place
    figures: dict[str, Any] = {
        "start_m": segment.start_m,
        "length_m": segment.length_m,
        "latitude_deg": latitude,
        "longitude_deg": longitude,
        "iri_m_per_km": segment.all_m_per_km,
        "mean_roughness_index_m_per_km": _mean([each.all_m_per_km for each in same]),
        "flagged_m": segment.invalid_m,
        "iri_of_valid_m_per_km": segment.valid_m_per_km,
        "counted_share": segment.counted_share,
        "iri_of_valid_low_m_per_km": segment.interval.low_m_per_km,
        "iri_of_valid_high_m_per_km": segment.interval.high_m_per_km,
        "mean_roughness_index_of_valid_m_per_km": _mean([each.valid_m_per_km for each in same]),
        "mean_roughness_index_counted_share": _smaller([each.counted_share for each in same]),
    }
    # One NaN for all: equal rows compare equal.
    known: dict[str, Any] = {
        name: nan if value != value else value for name, value in figures.items()
    }
    return Row(track, number, **known)


def _mean(values: Sequence[float]) -> float:
    return mean_roughness_index(*values) if len(values) == 2 else nan


def _smaller(shares: Sequence[float]) -> float:
    return min(shares) if len(shares) == 2 else nan


@dataclass(frozen=True, eq=False)
class _Way:
    """Places along a segment in degrees, shape (n,), from its start to its end."""

    latitude: FloatArray
    longitude: FloatArray

    @property
    def start(self) -> tuple[float, float]:
        """Latitude and longitude of the start."""
        return float(self.latitude[0]), float(self.longitude[0])


def _ways(
    recording: Recording | None, track: str, segments: Sequence[SegmentIri]
) -> Sequence[_Way]:
    """Return the places along each of ``segments``, `SPACING_M` apart at most."""
    if recording is None:
        unknown = np.full(1, nan)
        return [_Way(unknown, unknown)] * len(segments)
    along = [
        np.linspace(s.start_m, s.start_m + s.length_m, 1 + max(ceil(s.length_m / SPACING_M), 1))
        for s in segments
    ]
    latitude, longitude = places(recording, track, np.concatenate(along))
    ends = np.cumsum([part.size for part in along])[:-1]
    parts = (np.split(angles, ends) for angles in (latitude, longitude))
    return [_Way(*both) for both in zip(*parts, strict=True)]
