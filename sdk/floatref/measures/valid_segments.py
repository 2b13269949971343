"""The IRI of every segment of a wheel path: of its valid points, and beside it of all points.

The stretches of valid points are those of `floatref.measures.valid_iri`; they are cut where the
segments are. A stretch that is too short for the car counts nowhere.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from floatref.measures.roughness.iri_interval import (
    CORRELATION_M,
    UNKNOWN,
    Interval,
    iri_interval,
)
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.roughness.roughness_index import (
    STANDARD,
    iri_segments,
    iri_trace,
    segment_edges,
)
from floatref.measures.valid_iri import sums_of_valid, valid_stretches
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.profile import ProfileTrack


@dataclass(frozen=True)
class SegmentIri:
    """The IRI of ``length_m`` of a wheel path from ``start_m`` on, in m/km.

    Attributes:
        start_m, length_m: in m, on the profile's axis of distance.
        valid_m_per_km: the mean over stretches of valid points; NaN without any.
        counted_share: the share of all intervals that this mean is over, 0 to 1.
        all_m_per_km: the mean over every measured interval, invalid ones included.
        invalid_m: the length in m of the points that are not valid, at most ``length_m``.
        interval: where the IRI of the valid points lies with 95 %, from the profile's 1-σ.
    """

    start_m: float
    length_m: float
    valid_m_per_km: float
    counted_share: float
    all_m_per_km: float
    invalid_m: float
    interval: Interval = UNKNOWN

    @property
    def marked(self) -> bool:
        """Whether the IRI of all points rests on more than valid ones."""
        return self.counted_share < 1.0


def segment_iris(
    track: ProfileTrack,
    interval_m: float,
    settings: IriSettings = STANDARD,
    start_m: float = 0.0,
    correlation_m: float = CORRELATION_M,
) -> tuple[SegmentIri, ...]:
    """Return the IRI of every ``settings.segment_m`` of ``track``, whose point 0 is at start_m.

    ``correlation_m`` is the length in m over which errors of elevation are alike, for the interval
    of the IRI. Raises InputError as `iri_segments`.
    """
    whole = iri_segments(track.elevation, interval_m, settings, start_m)
    edges = segment_edges(track.valid.size - 1, interval_m, settings.segment_m)
    sums, counts = sums_of_valid(track, edges, interval_m, settings)
    means = np.divide(sums, counts, out=np.full(sums.size, np.nan), where=counts > 0)
    invalid = invalid_lengths(track, edges, interval_m).tolist()
    shares = (counts / np.diff(edges)).tolist()
    intervals = _intervals(track, edges, interval_m, settings, correlation_m)
    return tuple(
        SegmentIri(s.start_m, s.length_m, mean, share, s.iri_m_per_km, lost, interval)
        for s, mean, share, lost, interval in zip(
            whole, means.tolist(), shares, invalid, intervals, strict=True
        )
    )


def invalid_lengths(track: ProfileTrack, edges: IndexArray, interval_m: float) -> FloatArray:
    """Return the length in m of the points of every segment that are not valid, shape (n,).

    ``edges``, shape (n + 1,), are the first interval of every segment and the end. A point stands
    for one interval; the last segment has one more, and no segment is longer than it is.
    """
    ends = edges.copy()
    ends[-1] += 1
    cuts = zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True)
    # One by one: a count of every point so far would take eight times the room of the flags.
    points = np.array([b - a - np.count_nonzero(track.valid[a:b]) for a, b in cuts])
    return np.asarray(np.minimum(points, np.diff(edges)) * interval_m, dtype=np.float64)


def trace_of_valid(
    track: ProfileTrack, interval_m: float, settings: IriSettings = STANDARD
) -> FloatArray:
    """Return the signed output in m/km of every interval that counts, NaN for the others.

    One value fewer than the points of ``track``. Raises InputError as `iri_trace`.
    """
    trace = np.full(track.valid.size - 1, np.nan)
    for stretch in valid_stretches(track.valid, interval_m, settings):
        part = iri_trace(track.elevation[stretch], interval_m, settings)
        trace[stretch.start : stretch.stop - 1] = part
    return trace


def _intervals(
    track: ProfileTrack,
    edges: IndexArray,
    interval_m: float,
    settings: IriSettings,
    correlation_m: float,
) -> Sequence[Interval]:
    """Return the interval of every segment; unknown for a track without 1-σ."""
    if track.sigma is None:
        return [UNKNOWN] * (edges.size - 1)
    trace = trace_of_valid(track, interval_m, settings)
    cuts = zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True)
    return [
        iri_interval(trace[a:b], track.sigma[a:b], interval_m, settings, correlation_m)
        for a, b in cuts
    ]
