"""The rows of the summary that a profile gives: one for each segment of each wheel path."""

from collections.abc import Sequence
from math import nan

import numpy as np

from floatref.batch.results.positions import places
from floatref.batch.results.record import Row
from floatref.errors import InputError
from floatref.measures import IriSettings, iri_segments, mean_roughness_index
from floatref.measures.roughness.roughness_index import segment_edges
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording


def measure_segments(
    profile: Profile, segment_m: float | None, recording: Recording | None = None
) -> tuple[tuple[Row, ...], tuple[str, ...]]:
    """Return the rows of ``profile``, cut every ``segment_m``, and the measures that failed.

    None for the whole profile as one segment; positions are those of ``recording``, if it has any.
    The IRI is that of `floatref iri --segment`. Raises InputError for a segment that is not above
    zero.
    """
    settings = IriSettings(segment_m=segment_m)
    edges, remarks = _edges(profile, segment_m)
    indices = []
    for track in profile.tracks:
        try:
            indices.append(_indices(track, profile, settings))
        except InputError as error:
            # A profile too short or too coarse for the car is a profile all the same.
            remarks.append(f"track {track.name}: no IRI: {error}")
            indices.append([nan] * (edges.size - 1))
    means = [_mean(pair) for pair in zip(*indices, strict=True)]
    rows = [
        row
        for track, values in zip(profile.tracks, indices, strict=True)
        for row in _rows(track, profile, edges, values, means, recording)
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


def _indices(track: ProfileTrack, profile: Profile, settings: IriSettings) -> list[float]:
    found = iri_segments(track.elevation, profile.interval_m, settings, profile.start_m)
    return [segment.iri_m_per_km for segment in found]


def _mean(values: Sequence[float]) -> float:
    return mean_roughness_index(*values) if len(values) == 2 else nan


def _rows(
    track: ProfileTrack,
    profile: Profile,
    edges: IndexArray,
    indices: Sequence[float],
    means: Sequence[float],
    recording: Recording | None,
) -> list[Row]:
    starts = np.asarray(profile.start_m + edges[:-1] * profile.interval_m, np.float64)
    latitude, longitude = _places(recording, track.name, starts)
    columns = (
        starts,
        np.diff(edges) * profile.interval_m,
        latitude,
        longitude,
        np.asarray(indices),
        np.asarray(means),
        _find_flagged(track, edges) * profile.interval_m,
    )
    values = zip(*(column.tolist() for column in columns), strict=True)
    return [Row(track.name, segment, *row) for segment, row in enumerate(values)]


def _places(
    recording: Recording | None, track: str, starts: FloatArray
) -> tuple[FloatArray, FloatArray]:
    if recording is None:
        return np.full(starts.size, nan), np.full(starts.size, nan)
    return places(recording, track, starts)


def _find_flagged(track: ProfileTrack, edges: IndexArray) -> IndexArray:
    """Return the points of every segment that are not valid; the end belongs to the last one."""
    before = np.concatenate(([0], np.cumsum(~track.valid)))
    ends = edges.copy()
    ends[-1] += 1
    return np.asarray(np.diff(before[ends]), dtype=np.int64)
