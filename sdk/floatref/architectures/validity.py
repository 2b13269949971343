"""From flags to validity: which points of a profile can be trusted."""

import numpy as np

from floatref.values.arrays import BoolArray, Flag, FlagArray


def valid_points(flags: FlagArray, reach: int) -> BoolArray:
    """Return which points are valid.

    A point is not if its own sample was bridged, or if the accelerometer's was within ``reach``
    points of it: the error that the bridge leaves in the floating reference height is spread
    by the high-pass filter over about its cut-off wavelength to either side.
    """
    drift = (flags & np.uint8(Flag.DRIFT)) != 0
    trusted: BoolArray = flags == 0
    if not drift.any():
        return trusted
    # Counting flags in a sliding window is a difference of running counts.
    count = np.concatenate(([0], np.cumsum(drift)))
    index = np.arange(flags.size)
    low, high = np.maximum(index - reach, 0), np.minimum(index + reach + 1, flags.size)
    trusted &= count[high] == count[low]
    return trusted
