"""The rows of the summary that a profile gives: one for each segment of each wheel path."""

from collections.abc import Sequence
from math import nan

import numpy as np

from floatref.batch.results.positions import places
from floatref.batch.results.record import Row
from floatref.errors import InputError
from floatref.measures import IriSettings, mean_roughness_index
from floatref.measures.roughness.roughness_index import segment_edges
from floatref.measures.valid_segments import SegmentIri, invalid_lengths, segment_iris
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording


def measure_segments(
    profile: Profile, segment_m: float | None, recording: Recording | None = None
) -> tuple[tuple[Row, ...], tuple[str, ...]]:
    """Return the rows of ``profile``, cut every ``segment_m``, and the measures that failed.

    None for the whole profile as one segment; positions are those of ``recording``, if it has any.
    The figures are those of `floatref iri --segment`. Raises InputError for a segment that is not
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
    rows = [
        row
        for track, segments in zip(profile.tracks, measured, strict=True)
        for row in _rows(track.name, segments, measured, recording)
    ]
    return tuple(rows), tuple(remarks)


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
) -> list[Row]:
    """Return the rows of ``track``; ``measured`` has the segments of every wheel path."""
    starts = np.array([segment.start_m for segment in segments], dtype=np.float64)
    places_of = zip(*(found.tolist() for found in _places(recording, track, starts)), strict=True)
    together = zip(*measured, strict=True)
    return [
        _row(track, number, segment, place, same)
        for number, (segment, place, same) in enumerate(
            zip(segments, places_of, together, strict=True)
        )
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
    figures = {
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
    known = {name: nan if value != value else value for name, value in figures.items()}
    return Row(track, number, **known)


def _mean(values: Sequence[float]) -> float:
    return mean_roughness_index(*values) if len(values) == 2 else nan


def _smaller(shares: Sequence[float]) -> float:
    return min(shares) if len(shares) == 2 else nan


def _places(
    recording: Recording | None, track: str, starts: FloatArray
) -> tuple[FloatArray, FloatArray]:
    if recording is None:
        return np.full(starts.size, nan), np.full(starts.size, nan)
    return places(recording, track, starts)
