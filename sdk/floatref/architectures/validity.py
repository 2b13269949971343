"""From flags to validity: which points of a profile can be trusted."""

from collections.abc import Iterator

import numpy as np

from floatref.values.arrays import BoolArray, Flag, FlagArray

PIECE = 1 << 18
"""Points looked at together, so that memory stays bounded on a long profile."""


def valid_points(flags: FlagArray, reach: int) -> BoolArray:
    """Return which points are valid.

    A point is not if its own sample was bridged, or if the accelerometer's was within ``reach``
    points of it: the error that the bridge leaves in the floating reference height is spread
    by the high-pass filter over about its cut-off wavelength to either side.
    """
    trusted: BoolArray = flags == 0
    for begin in range(0, flags.size, PIECE):
        drift = (flags[begin : begin + PIECE] & np.uint8(Flag.DRIFT)) != 0
        for first, last in _groups(drift, 2 * reach + 1):
            trusted[max(begin + first - reach, 0) : begin + last + reach + 1] = False
    return trusted


def _groups(marked: BoolArray, apart: int) -> Iterator[tuple[int, int]]:
    """Yield first and last of the marked points in groups, up to ``apart`` from the next."""
    index = np.flatnonzero(marked)
    if index.size:
        gaps = np.flatnonzero(np.diff(index) > apart)
        firsts, lasts = index[np.append(0, gaps + 1)], index[np.append(gaps, -1)]
        yield from zip(firsts.tolist(), lasts.tolist(), strict=True)
