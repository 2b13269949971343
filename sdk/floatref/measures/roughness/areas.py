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
from floatref.values.scanning import CHUNK


@dataclass(frozen=True)
class Area:
    """Indices of an area's first value, of the value behind its last, and of its highest one."""

    first: int
    end: int
    peak: int


def list_areas(values: FloatArray, limit: float = 0.0, sign: float = 1.0) -> tuple[Area, ...]:
    """Return every stretch of successive ``values``, times ``sign``, above ``limit``, in order.

    ``sign`` is 1 or -1. The peak is the first of the highest values. NaN is above no limit.
    """
    # The product of all values would be as large as they are.
    above = values > limit if sign > 0.0 else values < -limit
    edges: NDArray[np.int64] = np.flatnonzero(np.diff(above, prepend=False, append=False))
    return tuple(
        Area(first, end, first + int(np.argmax(sign * values[first:end])))
        for first, end in edges.reshape(-1, 2).tolist()
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
    sound = np.empty(valid.size, dtype=np.bool_)
    for at in range(0, valid.size, CHUNK):
        inside = slice(at, min(at + CHUNK, valid.size))
        low = max(at - before, 0)
        part = valid[low : inside.stop + after]
        invalid = np.concatenate(([0], np.cumsum(~part)))
        points = np.arange(inside.start - low, inside.stop - low)
        first = np.clip(points - before, 0, part.size)
        end = np.clip(points + after + 1, 0, part.size)
        sound[inside] = invalid[end] == invalid[first]
    return sound


def share(valid: BoolArray) -> float:
    """Return which share of ``valid`` is True, from 0 to 1; NaN of no values."""
    return float(np.count_nonzero(valid)) / valid.size if valid.size else float("nan")
