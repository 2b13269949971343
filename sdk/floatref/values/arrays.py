"""Array types shared by every value; making arrays read-only and releasing mapped files."""

import mmap
from enum import IntFlag
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]
FlagArray = NDArray[np.uint8]
Records = NDArray[np.record]
"""Elements that have fields: `records[k].name` in compiled code, `records["name"]` elsewhere."""


class Flag(IntFlag):
    """Why a sample is not to be trusted; bits combine, 0 is a trusted sample."""

    MISSING = 1
    """The sample itself was not measured and has been bridged."""
    DRIFT = 2
    """The floating reference height is disturbed here; a high-pass filter spreads it."""
    SLOW = 4
    """Travel so slow that stages remove content there, or drift is squeezed into one spot."""
    BRAKING = 8
    """Braking so hard for the speed that the tilt of the accelerometer matters."""
    UNCERTAIN = 16
    """The 1-σ of the elevation is above the limit for a valid point."""


LASTING = Flag.DRIFT | Flag.SLOW | Flag.BRAKING
"""Flags that a sample between two points of the profile also gives to the second point."""


def frozen(values: ArrayLike) -> FloatArray:
    """Return ``values`` as a read-only, one-dimensional float64 array without gaps in memory.

    An array that already has this layout is not copied. Raises ValueError for more than one
    dimension.
    """
    array = np.asarray(values, dtype=np.float64)
    if array.ndim != 1:
        raise ValueError(f"expected one dimension, got shape {array.shape}")
    view = (array if array.flags.c_contiguous else array.copy()).view()
    view.flags.writeable = False
    return view


def read_only(values: FloatArray) -> FloatArray:
    """Return a read-only view of ``values``, of any layout, whose changes it shows.

    A kernel is compiled anew for an array that is read-only where another one was not, so callers
    that meet both give it this.
    """
    view = values.view()
    view.flags.writeable = False
    return view


def new_records(count: int, fields: np.dtype[np.void]) -> Records:
    """Return ``count`` records of these ``fields``, all zero."""
    return cast(Records, np.zeros(count, fields))


def new_record(fields: np.dtype[np.void]) -> np.record:
    """Return one record of these ``fields``, all zero; a deep copy has memory of its own."""
    record: np.record = np.zeros(1, fields).view(np.recarray)[0]
    return record


def release(values: NDArray[Any]) -> None:
    """Release the memory that reading ``values`` took, if they lie in a read-only file.

    They can be read again. Does nothing for an array in memory, or where the operating system has
    no call for it.
    """
    array, base = values, values.base
    while isinstance(base, np.ndarray):
        array, base = base, base.base
    # Another mode may have changes in these pages, which would be lost.
    if isinstance(base, mmap.mmap) and isinstance(array, np.memmap) and array.mode == "r":
        advise, unneeded = getattr(base, "madvise", None), getattr(mmap, "MADV_DONTNEED", None)
        if advise is not None and unneeded is not None:
            advise(unneeded)
