"""Changes made to a road: a level start, a known bump, a wanted IRI."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from floatref import measures
from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.alignment import Alignment
from floatref_conformance.proving_ground.roads.road import (
    FULL_FROM_M,
    LEVEL_UNTIL_M,
    RUN_OUT_M,
    Road,
)


def cosine_rise(fraction: FloatArray) -> FloatArray:
    """Return half a cosine from 0 (at and below 0) to 1 (at and above 1), any shape."""
    return np.asarray(0.5 - 0.5 * np.cos(np.pi * np.clip(fraction, 0.0, 1.0)))


def with_level_start(
    road: Road, level_until_m: float = LEVEL_UNTIL_M, full_from_m: float = FULL_FROM_M
) -> Road:
    """Return the road made level up to one distance and unchanged from another on.

    The straight line that fits the mean of the wheel paths best between the two distances is
    first taken off the whole road, so that the fade-in adds no step; a line has no roughness.
    InputError if the distances are out of order or hold fewer than two points.
    """
    x = road.distance_m
    fading = (x >= level_until_m) & (x <= full_from_m)
    if np.count_nonzero(fading) < 2:
        raise InputError(f"no fade-in fits between {level_until_m} m and {full_from_m} m")
    middle = np.mean(list(road.elevation.values()), axis=0)
    line = np.polyval(np.polyfit(x[fading], middle[fading], 1), x)
    weight = cosine_rise((x - level_until_m) / (full_from_m - level_until_m))
    return road.with_elevation({name: weight * (z - line) for name, z in road.elevation.items()})


def with_bump(
    road: Road,
    centre_m: float,
    length_m: float,
    height_m: float,
    flank_m: float | None = None,
    tracks: Sequence[str] | None = None,
) -> Road:
    """Return the road with a bump (or a dip, if the height is negative) added to it.

    Args:
        road: the road to add it to.
        centre_m: true distance of the bump's middle, in m.
        length_m: from its first to its last point, in m.
        height_m: of its top above the road, in m.
        flank_m: length of each half-cosine flank, in m; half of the bump if not given, which
            makes it a full raised cosine. What remains between the flanks is a flat top.
        tracks: the wheel paths that get it; all of them if not given.

    Raises:
        InputError: for a wheel path that the road lacks or flanks longer than the bump.
    """
    flank = length_m / 2 if flank_m is None else flank_m
    if not 0 < 2 * flank <= length_m:
        raise InputError(f"flank_m is {flank}; it must be above 0 and at most half of {length_m} m")
    chosen = road.tracks if tracks is None else tracks
    unknown = set(chosen) - set(road.tracks)
    if unknown:
        raise InputError(f"wheel path {unknown.pop()}: missing; the road has {road.tracks}")
    inside = length_m / 2 - np.abs(road.distance_m - centre_m)
    bump = height_m * cosine_rise(inside / flank)
    return road.with_elevation(
        {name: z + bump if name in chosen else z for name, z in road.elevation.items()}
    )


def with_alignment(road: Road, alignment: Alignment) -> Road:
    """Return the road with every wheel path raised by ``alignment``, which it then has."""
    features = (*road.alignment.features, *alignment.features)
    height = alignment.height(road.distance_m)
    raised = road.with_elevation({name: z + height for name, z in road.elevation.items()})
    return replace(raised, alignment=Alignment(features))


def scale_to(
    road: Road, iri_m_per_km: float, start_m: float = FULL_FROM_M, end_m: float | None = None
) -> Road:
    """Return the road scaled so that its wheel paths have a mean IRI of ``iri_m_per_km``.

    Arguments and errors are those of `scale_factor`.
    """
    return scale_by(road, scale_factor(road, iri_m_per_km, start_m, end_m))


def scale_by(road: Road, factor: float) -> Road:
    """Return the road with all elevations multiplied by ``factor``."""
    return road.with_elevation({name: factor * z for name, z in road.elevation.items()})


def scale_factor(
    road: Road, iri_m_per_km: float, start_m: float = FULL_FROM_M, end_m: float | None = None
) -> float:
    """Return the factor that gives the wheel paths a mean IRI of ``iri_m_per_km``.

    The IRI is linear in the elevation, so one factor for all wheel paths is exact. It is
    taken from ``start_m`` to ``end_m`` (default: where the run-out starts), in m. InputError
    for a road without roughness or a target that is not above zero.
    """
    if not (np.isfinite(iri_m_per_km) and iri_m_per_km > 0):
        raise InputError(f"the target IRI is {iri_m_per_km} m/km; it must be above zero")
    end = road.end_m - RUN_OUT_M if end_m is None else end_m
    x = road.distance_m
    chosen = (x >= start_m) & (x <= end)
    values = [measures.iri(z[chosen], road.spacing_m) for z in road.elevation.values()]
    present = float(np.mean(values))
    if not present > 0:
        raise InputError(f"a road without roughness cannot be scaled to {iri_m_per_km} m/km")
    return iri_m_per_km / present
