"""Array types shared by every value, and the freezing that keeps values immutable."""

from enum import IntFlag

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


def frozen(values: ArrayLike) -> FloatArray:
    """Return ``values`` as a read-only, one-dimensional float64 array.

    A float64 array is not copied: the caller gives it up. Raises ValueError for more
    than one dimension.
    """
    array = np.asarray(values, dtype=np.float64)
    if array.ndim != 1:
        raise ValueError(f"expected one dimension, got shape {array.shape}")
    view = array.view()
    view.flags.writeable = False
    return view
