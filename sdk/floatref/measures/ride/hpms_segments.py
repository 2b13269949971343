"""Sections of 0.1 mile as the Highway Performance Monitoring System reports them.

The rating is that of 23 CFR 490.313(b)(1): an IRI below 95 in/mi is good, one above 170 in/mi poor,
all others fair. The IRI of a section is the mean of both wheel paths (AASHTO R 43), or that of the
only one.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from floatref.errors import InputError
from floatref.measures.roughness.areas import share, valid_points, valid_throughout
from floatref.measures.roughness.gaps import check_elevation
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.roughness.roughness_index import STANDARD, iri_segments, segment_edges
from floatref.measures.roughness.roughness_profile import TENTH_OF_A_MILE_M, in_per_mi
from floatref.values.arrays import BoolArray, FloatArray

GOOD_BELOW_IN_PER_MI = 95.0
POOR_ABOVE_IN_PER_MI = 170.0
RATINGS = ("good", "fair", "poor")


@dataclass(frozen=True)
class HpmsSection:
    """A section: its start and length in m, IRI of each wheel path and their mean in m/km, rating.

    ``rating`` is None where nothing was measured. ``valid_share`` is the share, 0 to 1, of its
    intervals whose ends are valid in every wheel path.
    """

    start_m: float
    length_m: float
    iri_m_per_km: tuple[float, ...]
    mean_m_per_km: float
    rating: str | None
    valid_share: float


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

    One pass of the car, cut afterwards: `iri_segments`; the last, shorter section is kept. Without
    ``valid``, finite points are valid. Raises InputError for no path or more than two, for paths of
    different lengths, and as `iri_segments`. Source: 23 CFR 490.309 to 490.313.
    """
    if len(paths) not in (1, 2):
        raise InputError(f"{len(paths)} wheel paths; a section has one or two")
    if len({np.size(path) for path in paths}) > 1:
        raise InputError("wheel paths differ in length; cut them to the same points")
    cut = replace(settings, segment_m=section_m)
    by_path = [iri_segments(path, interval_m, cut, start_m) for path in paths]
    sound = _valid_intervals(paths, interval_m, valid)
    edges = segment_edges(sound.size, interval_m, section_m).tolist()
    found = []
    for parts, first, end in zip(zip(*by_path, strict=True), edges[:-1], edges[1:], strict=True):
        values = tuple(part.iri_m_per_km for part in parts)
        mean = sum(values) / len(values)
        reliable = share(sound[first:end])
        found.append(
            HpmsSection(parts[0].start_m, parts[0].length_m, values, mean, rate_iri(mean), reliable)
        )
    return tuple(found)


def rated_shares(sections: Sequence[HpmsSection]) -> Mapping[str, float]:
    """Return which share, 0 to 1, of the rated length is good, fair and poor; NaN without any."""
    lengths = {
        rating: sum(section.length_m for section in sections if section.rating == rating)
        for rating in RATINGS
    }
    whole = sum(lengths.values())
    return {rating: part / whole if whole else float("nan") for rating, part in lengths.items()}


def _valid_intervals(
    paths: Sequence[FloatArray], interval_m: float, valid: Sequence[BoolArray] | None
) -> BoolArray:
    """Return of which intervals both ends are valid in every wheel path."""
    masks = [None] * len(paths) if valid is None else valid
    sound = np.ones(np.size(paths[0]), dtype=np.bool_)
    for path, mask in zip(paths, masks, strict=True):
        sound &= valid_points(mask, check_elevation(path, interval_m))
    return valid_throughout(sound, 0, 1)[:-1]
