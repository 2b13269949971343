"""Sections of 0.1 mile as the Highway Performance Monitoring System reports them.

The rating is that of 23 CFR 490.313(b)(1): an IRI below 95 in/mi is good, one above 170 in/mi poor,
all others fair. The IRI of a section is the mean of both wheel paths (AASHTO R 43), or that of the
only one.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import nan

import numpy as np

from floatref.errors import InputError
from floatref.measures.gaps import check_elevation
from floatref.measures.roughness.areas import share, valid_points, valid_throughout
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.roughness.roughness_index import STANDARD, segment_edges
from floatref.measures.roughness.roughness_profile import TENTH_OF_A_MILE_M, in_per_mi
from floatref.measures.valid_segments import SegmentIri, segment_iris
from floatref.values.arrays import BoolArray, FloatArray, release
from floatref.values.profile import ProfileTrack

GOOD_BELOW_IN_PER_MI = 95.0
POOR_ABOVE_IN_PER_MI = 170.0
RATINGS = ("good", "fair", "poor")


@dataclass(frozen=True)
class HpmsSection:
    """A section: its start and length in m, IRI of each wheel path and their mean in m/km, rating.

    ``rating`` is None where nothing was measured. ``valid_share`` is the share, 0 to 1, of its
    intervals whose ends are valid in every wheel path. The figures ``of_valid`` are those of the
    stretches of valid points alone, NaN and None without one in every wheel path, and
    ``counted_share`` is the share of the section, 0 to 1, that these are in each wheel path at
    least.
    """

    start_m: float
    length_m: float
    iri_m_per_km: tuple[float, ...]
    mean_m_per_km: float
    rating: str | None
    valid_share: float
    iri_of_valid_m_per_km: tuple[float, ...] = ()
    mean_of_valid_m_per_km: float = nan
    rating_of_valid: str | None = None
    counted_share: float = 0.0


def rate_iri(iri_m_per_km: float) -> str | None:
    """Return "good", "fair" or "poor" for an IRI in m/km, None for NaN: 23 CFR 490.313(b)(1)."""
    value = in_per_mi(iri_m_per_km)
    if np.isnan(value):
        return None
    if value < GOOD_BELOW_IN_PER_MI:
        return "good"
    return "poor" if value > POOR_ABOVE_IN_PER_MI else "fair"


def hpms_sections(
    paths: Sequence[FloatArray],
    interval_m: float,
    valid: Sequence[BoolArray] | None = None,
    start_m: float = 0.0,
    section_m: float = TENTH_OF_A_MILE_M,
    settings: IriSettings = STANDARD,
) -> tuple[HpmsSection, ...]:
    """Return the sections of a lane of one or two wheel paths, elevations in m, in order.

    One pass of the car, cut afterwards: `iri_segments`; the last, shorter section is kept. Beside
    it the car runs over every stretch of valid points: `segment_iris`. Without ``valid``, finite
    points are valid. Raises InputError for no path or more than two, for paths of different
    lengths, and as `iri_segments`. Source: 23 CFR 490.309 to 490.313.
    """
    if len(paths) not in (1, 2):
        raise InputError(f"{len(paths)} wheel paths; a section has one or two")
    if len({np.size(path) for path in paths}) > 1:
        raise InputError("wheel paths differ in length; cut them to the same points")
    cut = replace(settings, segment_m=section_m)
    masks = [None] * len(paths) if valid is None else valid
    by_path = [
        segment_iris(_track(path, interval_m, mask), interval_m, cut, start_m)
        for path, mask in zip(paths, masks, strict=True)
    ]
    sound = _valid_intervals(paths, masks)
    edges = segment_edges(sound.size, interval_m, section_m).tolist()
    return tuple(
        _rate(parts, share(sound[first:end]))
        for parts, first, end in zip(zip(*by_path, strict=True), edges[:-1], edges[1:], strict=True)
    )


def _rate(parts: Sequence[SegmentIri], valid_share: float) -> HpmsSection:
    """Return the section whose wheel paths are ``parts``."""
    every, valid = (
        tuple(part.all_m_per_km for part in parts),
        tuple(part.valid_m_per_km for part in parts),
    )
    mean, mean_of_valid = sum(every) / len(parts), sum(valid) / len(parts)
    return HpmsSection(
        parts[0].start_m,
        parts[0].length_m,
        every,
        mean,
        rate_iri(mean),
        valid_share,
        valid,
        mean_of_valid,
        rate_iri(mean_of_valid),
        min(part.counted_share for part in parts),
    )


def rated_shares(sections: Sequence[HpmsSection], of_valid: bool = False) -> Mapping[str, float]:
    """Return which share, 0 to 1, of the rated length is good, fair and poor; NaN without any.

    With ``of_valid`` the rating of valid points counts, for the length that these are.
    """
    lengths = dict.fromkeys(RATINGS, 0.0)
    for section in sections:
        rating = section.rating_of_valid if of_valid else section.rating
        if rating is not None:
            lengths[rating] += section.length_m * (section.counted_share if of_valid else 1.0)
    whole = sum(lengths.values())
    return {rating: part / whole if whole else nan for rating, part in lengths.items()}


def _track(path: FloatArray, interval_m: float, valid: BoolArray | None) -> ProfileTrack:
    """Return the wheel path; InputError unless it can be used, with a flag for each point."""
    values = check_elevation(path, interval_m)
    return ProfileTrack.of("", values, valid_points(valid, values))


def _valid_intervals(paths: Sequence[FloatArray], masks: Sequence[BoolArray | None]) -> BoolArray:
    """Return of which intervals both ends are valid in every wheel path."""
    sound = np.ones(np.size(paths[0]), dtype=np.bool_)
    for path, mask in zip(paths, masks, strict=True):
        values = np.asarray(path, dtype=np.float64)
        sound &= valid_points(mask, values)
        # What was read of a file would stay in memory.
        release(values)
    return valid_throughout(sound, 0, 1)[:-1]
