"""Missing elevations: the stretch that was measured, and the bridges over gaps inside it."""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.scanning import chunks, first_where, flags_where

HIGHEST_M = 1e6
"""No road lies higher or lower than this, in m, whatever the datum."""


def check_heights(elevation: FloatArray) -> None:
    """Raise InputError naming the first point of ``elevation``, in m, that no road reaches."""
    point = first_where(lambda values: np.abs(values) > HIGHEST_M, elevation)
    if point is not None:
        raise InputError(
            f"elevation of point {point} is {elevation[point]:.4g} m, beyond {HIGHEST_M:.0f} m; "
            "give elevations in m, and mark missing points as NaN"
        )


def check_elevation(elevation: FloatArray, interval_m: float) -> FloatArray:
    """Return ``elevation`` in m as float64; InputError unless it and ``interval_m`` are usable.

    Needs one dimension, no infinities, at least one finite point, no point beyond 1000 km, and a
    positive interval.
    """
    if not (np.isfinite(interval_m) and interval_m > 0):
        raise InputError(f"interval is {interval_m} m; it must be above zero")
    values = np.ascontiguousarray(elevation, dtype=np.float64)
    if values.ndim != 1:
        raise InputError(f"elevation has shape {values.shape}; give one wheel path at a time")
    if first_where(lambda part: ~(np.abs(part) <= HIGHEST_M), values) is None and values.size:
        return values
    if first_where(np.isinf, values) is not None:
        raise InputError("elevation is infinite in places; mark missing points as NaN")
    if first_where(np.isfinite, values) is None:
        raise InputError(f"0 of {values.size} elevations are finite; give a measured profile")
    check_heights(values)
    return values


def measured_stretch(elevation: FloatArray) -> slice:
    """Return the points from the first to the last finite elevation."""
    if np.isfinite(elevation[[0, -1]]).all():
        return slice(0, elevation.size)
    finite = flags_where(np.isfinite, elevation)
    return slice(int(finite.argmax()), elevation.size - int(finite[::-1].argmax()))


def _is_missing(part: FloatArray) -> BoolArray:
    return np.asarray(~np.isfinite(part))


def bridge(elevation: FloatArray, missing: BoolArray | None = None) -> FloatArray:
    """Return ``elevation`` with every ``missing`` point on the straight line over its gap.

    Without ``missing`` these are the points that are not finite.
    """
    if missing is None:
        if first_where(_is_missing, elevation) is None:
            return elevation
        missing = flags_where(_is_missing, elevation)
    if not missing.any():
        return elevation
    # Only the ends of gaps matter: a line through all points takes five times their room.
    edges = np.flatnonzero(np.diff(missing))
    ends = np.unique(np.concatenate((edges, edges + 1)))
    ends = ends[~missing[ends]]
    bridged, gaps = np.empty(elevation.size), np.flatnonzero(missing)
    # In pieces, so that a file is not in memory as a whole beside the copy.
    for at, part in chunks(elevation):
        bridged[at : at + part.size] = part
    bridged[gaps] = np.interp(gaps, ends, bridged[ends])
    return bridged
