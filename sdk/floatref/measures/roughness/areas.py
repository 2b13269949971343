"""Areas of a road in which a value is beyond a limit, and how much of them is valid.

A value is computed from points of a profile. It counts as valid if all of these points are valid;
the share of an area's values that are valid goes with the area, so that what rests on
points that the profile marks invalid is never given without a mark.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray


@dataclass(frozen=True)
class Area:
    """Indices of an area's first value, of the value behind its last, and of its highest one."""

    first: int
    end: int
    peak: int


def list_areas(excess: FloatArray, limit: float = 0.0) -> tuple[Area, ...]:
    """Return every stretch of successive values of ``excess`` above ``limit``, in order.

    The peak is the first of the highest values. NaN is above no limit.
    """
    above = np.concatenate(([False], excess > limit, [False]))
    edges: NDArray[np.int64] = np.flatnonzero(np.diff(above)).reshape(-1, 2)
    return tuple(
        Area(first, end, first + int(np.argmax(excess[first:end]))) for first, end in edges.tolist()
    )


def valid_points(valid: ArrayLike | None, elevation: FloatArray) -> BoolArray:
    """Return which points of ``elevation`` are valid; without ``valid``, those that are finite.

    Raises InputError unless ``valid`` has one value for each point. A point without elevation is
    never valid.
    """
    finite = np.isfinite(elevation)
    if valid is None:
        return finite
    mask = np.asarray(valid, dtype=np.bool_)
    if mask.shape != finite.shape:
        raise InputError(f"valid has {mask.size} values for {finite.size} points; give one each")
    return mask & finite


def valid_throughout(valid: BoolArray, before: int, after: int) -> BoolArray:
    """Return of which points those from ``before`` before to ``after`` behind are all valid.

    Both are counts of points, 0 or more; points beyond the ends of the profile do not count.
    """
    invalid = np.concatenate(([0], np.cumsum(~valid)))
    points = np.arange(valid.size)
    first = np.clip(points - before, 0, valid.size)
    end = np.clip(points + after + 1, 0, valid.size)
    return np.asarray(invalid[end] == invalid[first])


def share(valid: BoolArray) -> float:
    """Return which share of ``valid`` is True, from 0 to 1; NaN of no values."""
    return float(np.count_nonzero(valid)) / valid.size if valid.size else float("nan")
