"""The zero-phase high-pass at a cut-off that follows the speed (5.7), on whole arrays.

It is the array form of what the stages of section 5.7 do block by block with the same kernels,
and gives the same bits: without blocks, flags and states it shows the time of the filter alone.
"""

import numpy as np

from floatref.kernels.schedule import frequencies, tangents
from floatref.kernels.varying import MEMORY, high_pass_12, high_pass_21
from floatref.values.arrays import FloatArray

PIECE = 16_384
"""Samples taken together, so that the data between two loops stays in the cache."""


def adaptive_high_pass(
    x: FloatArray,
    speed: FloatArray,
    step: float,
    low_speed_hz: float = 0.45,
    wavelength_m: float = 105.91,
    transition_speed: float = 2.778,
    steepness: float = 2.5,
) -> FloatArray:
    """Return ``x`` after HPF_B3S1, HPF_B3S2, HPF_B3S2R and HPF_B3S1R at the cut-off of (5.3).

    ``speed`` in m/s has the shape (N,) of ``x``, ``step`` is its time step in s; the rest are the
    constants of (5.3), whose frequencies must lie below half the sampling rate.
    """
    y, c, cutoff = np.empty(x.size), np.empty(x.size), np.empty(PIECE)
    settings = low_speed_hz, wavelength_m, transition_speed, steepness
    first, second = np.zeros(MEMORY), np.zeros(MEMORY)
    pieces = [slice(at, at + PIECE) for at in range(0, x.size, PIECE)]
    for part in pieces:
        frequencies(speed[part], cutoff, *settings)
        tangents(cutoff[: c[part].size], step, c[part])
        high_pass_12(x[part], y[part], c[part], first, second, False)
    first, second = np.zeros(MEMORY), np.zeros(MEMORY)
    for part in reversed(pieces):
        high_pass_21(y[part], y[part], c[part], second, first, True)
    return y
