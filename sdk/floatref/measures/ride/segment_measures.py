"""What contracts ask for, of every segment of a profile, beside its IRI.

Each measure is computed over the whole profile and cut afterwards, as the IRI by segment is, so a
segment's figures do not depend on where it ends. All measured points count; the shares say how much
of a figure rests on valid points only.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from math import nan

import numpy as np

from floatref.measures.ride.bumps_and_dips import DEVIATION_LIMIT_M, average_deviation
from floatref.measures.ride.profile_index import CALIFORNIA_RULES, index_of_stretch
from floatref.measures.ride.profilograph import profilograph_trace, valid_frames
from floatref.measures.ride.rolling_straightedge import (
    EIGHTH_INCH_M,
    TEN_FEET_M,
    roll_straightedge,
)
from floatref.measures.ride.two_paths import join_profile_indices, mean_path, ride_number
from floatref.measures.roughness.areas import share
from floatref.measures.roughness.quarter_car import RIDE_NUMBER_CAR
from floatref.measures.roughness.roughness_index import M_PER_KM, STANDARD, iri_trace
from floatref.measures.roughness.roughness_profile import (
    LOCALIZED_ABOVE_M_PER_KM,
    short_interval_roughness,
    valid_bases,
)
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.profile import Profile, ProfileTrack


@dataclass(frozen=True)
class RideLimits:
    """Continuous IRI in m/km, deviation from the average in m, and those of a straightedge in m."""

    threshold_m_per_km: float = LOCALIZED_ABOVE_M_PER_KM
    deviation_m: float = DEVIATION_LIMIT_M
    straightedge_m: float = TEN_FEET_M
    tolerance_m: float = EIGHTH_INCH_M


@dataclass(frozen=True)
class SegmentMeasures:
    """The measures of one segment of one wheel path; NaN where nothing was measured.

    Attributes:
        ride_number: of the wheel path, 0 to 5.
        localized_roughness_m: length whose continuous IRI is above the threshold.
        localized_roughness_peak_m_per_km: largest continuous IRI.
        localized_roughness_valid_share: of its values whose 7.62 m hold valid points only, 0 to 1.
        straightedge_largest_m: largest size of a deviation.
        straightedge_defective_share: of measured points beyond the tolerance, 0 to 1.
        straightedge_valid_share: of points between whose wheels all points are valid.
        profile_index_m_per_km: of a profilograph.
        profile_index_valid_share: of its values under whose frame all points are valid.
        half_car_roughness_index_m_per_km, lane_ride_number: of two wheel paths, else NaN.
        bumps_and_dips_m: length of the lane farther from its moving average than the limit.
        bumps_and_dips_largest_m: largest size of that deviation.
        bumps_and_dips_valid_share: of its values whose window holds valid points only.
        lane_valid_share: of points that are valid in every wheel path; that of the Ride Number and
            of the half-car roughness index.
    """

    ride_number: float = nan
    localized_roughness_m: float = nan
    localized_roughness_peak_m_per_km: float = nan
    localized_roughness_valid_share: float = nan
    straightedge_largest_m: float = nan
    straightedge_defective_share: float = nan
    straightedge_valid_share: float = nan
    profile_index_m_per_km: float = nan
    profile_index_valid_share: float = nan
    half_car_roughness_index_m_per_km: float = nan
    lane_ride_number: float = nan
    bumps_and_dips_m: float = nan
    bumps_and_dips_largest_m: float = nan
    bumps_and_dips_valid_share: float = nan
    lane_valid_share: float = nan


MEASURES = tuple(field.name for field in fields(SegmentMeasures))
"""Names of the measures of a segment."""


def segment_measures(
    profile: Profile, edges: IndexArray, limits: RideLimits | None = None
) -> tuple[tuple[SegmentMeasures, ...], ...]:
    """Return the measures of every segment, for every wheel path of ``profile``.

    ``edges``, shape (n + 1,), are the first interval of every segment and the end. The figures of
    the lane are those of one or two wheel paths, NaN for more. Raises InputError as the measures
    do, for a profile that is too short or too coarse for one of them.
    """
    used = limits or RideLimits()
    cuts = list(_cuts(edges))
    tracks = [_measure_track(track, profile.interval_m, cuts, used) for track in profile.tracks]
    indices = [[figures.index for figures in found] for found in tracks]
    lane = _measure_lane(profile, cuts, indices, used)
    return tuple(
        tuple(replace(one.measures, **more) for one, more in zip(found, lane, strict=True))
        for found in tracks
    )


@dataclass(frozen=True)
class _Cut:
    """A segment: its intervals, and its points, of which the last segment has one more."""

    intervals: slice
    points: slice

    def length(self, beyond: BoolArray, interval_m: float) -> float:
        """Return the length in m of the points or intervals ``beyond`` a limit."""
        most = self.intervals.stop - self.intervals.start
        return float(min(int(np.count_nonzero(beyond)), most) * interval_m)


@dataclass(frozen=True)
class _TrackFigures:
    """The measures of a segment of one wheel path, and its profile index for the Ride Number."""

    index: float
    measures: SegmentMeasures


def _cuts(edges: IndexArray) -> Iterator[_Cut]:
    last = edges.size - 2
    for k, (first, end) in enumerate(zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True)):
        yield _Cut(slice(first, end), slice(first, end + (k == last)))


def _measure_track(
    track: ProfileTrack, interval_m: float, cuts: Sequence[_Cut], limits: RideLimits
) -> list[_TrackFigures]:
    z, valid = track.elevation, track.valid
    ride = iri_trace(z, interval_m, STANDARD, RIDE_NUMBER_CAR) / M_PER_KM
    rough, bases = short_interval_roughness(z, interval_m), valid_bases(z, interval_m, valid=valid)
    edge = roll_straightedge(z, interval_m, limits.straightedge_m, valid=valid)
    trace, frames = profilograph_trace(z, interval_m), valid_frames(z, interval_m, valid=valid)
    found = []
    for cut in cuts:
        index = _root_mean_square(ride[cut.intervals])
        part, sizes = rough[cut.intervals], np.abs(edge.values[cut.points])
        read = index_of_stretch(trace[cut.points], frames[cut.points], interval_m, CALIFORNIA_RULES)
        measures = SegmentMeasures(
            ride_number=ride_number(index) if index == index else nan,
            localized_roughness_m=_length(part, limits.threshold_m_per_km, cut, interval_m),
            localized_roughness_peak_m_per_km=_largest(part),
            localized_roughness_valid_share=_valid(part, bases[cut.intervals]),
            straightedge_largest_m=_largest(sizes),
            straightedge_defective_share=share(sizes[np.isfinite(sizes)] > limits.tolerance_m),
            straightedge_valid_share=_valid(sizes, edge.sound[cut.points]),
            profile_index_m_per_km=read.profile_index_m_per_km,
            profile_index_valid_share=read.valid_share,
        )
        found.append(_TrackFigures(index, measures))
    return found


def _measure_lane(
    profile: Profile, cuts: Sequence[_Cut], indices: Sequence[Sequence[float]], limits: RideLimits
) -> list[dict[str, float]]:
    """Return the figures of the lane by name, for every segment."""
    if len(profile.tracks) > 2:
        return [{} for _ in cuts]
    first, last, interval = profile.tracks[0], profile.tracks[-1], profile.interval_m
    mean, valid = mean_path(first.elevation, last.elevation, interval), first.valid & last.valid
    off = average_deviation(mean, interval, valid=valid)
    paired = len(profile.tracks) == 2
    car = np.abs(iri_trace(mean, interval)) if paired else np.full(mean.size - 1, nan)
    found = []
    for cut, *same in zip(cuts, *indices, strict=True):
        sizes = np.abs(off.values[cut.points])
        joined = join_profile_indices(*same) if paired else nan
        found.append(
            {
                "half_car_roughness_index_m_per_km": _mean(car[cut.intervals]),
                "lane_ride_number": ride_number(joined) if joined == joined else nan,
                "bumps_and_dips_m": _length(sizes, limits.deviation_m, cut, interval),
                "bumps_and_dips_largest_m": _largest(sizes),
                "bumps_and_dips_valid_share": _valid(sizes, off.sound[cut.points]),
                "lane_valid_share": share(valid[cut.points]),
            }
        )
    return found


def _length(values: FloatArray, limit: float, cut: _Cut, interval_m: float) -> float:
    """Return the length in m of ``values`` above ``limit``; NaN if all are unknown."""
    return cut.length(values > limit, interval_m) if np.isfinite(values).any() else nan


def _largest(values: FloatArray) -> float:
    known = values[np.isfinite(values)]
    return float(known.max()) if known.size else nan


def _valid(values: FloatArray, sound: BoolArray) -> float:
    """Return the share of the known ``values`` that are ``sound``."""
    return share(sound[np.isfinite(values)])


def _mean(values: FloatArray) -> float:
    known = values[np.isfinite(values)]
    return float(np.mean(known)) if known.size else nan


def _root_mean_square(values: FloatArray) -> float:
    return float(np.sqrt(_mean(np.square(values))))
