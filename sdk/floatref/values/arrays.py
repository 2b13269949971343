"""Array types shared by every value; making arrays read-only and releasing mapped files."""

import mmap
from enum import IntFlag
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]
FlagArray = NDArray[np.uint8]


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
