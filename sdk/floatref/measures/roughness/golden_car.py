"""The Golden-Car Model as a recursion over the points of a profile, fused with its input.

The transition over one interval at constant slope is exact and diagonal: each of the two
vibration modes is one complex number, so a point costs two complex multiplications. ``modes``
holds, mode after mode, the real and imaginary part of its pole and of its input gain; the real
parts of both modes add up to the output (Karamihas 2021, steps 1 to 3 of 2.1.1).

The slopes enter less ``start_slope``: at that slope the car is at rest, so it starts with zero
states. Elevation is finite, in m, with at least two points; ``per_step`` is 1/interval in 1/m.
"""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.measures.roughness.quarter_car import Modes
from floatref.values.arrays import FloatArray


@compiled
def car_response(
    elevation: FloatArray,
    window: int,
    start_slope: float,
    per_step: float,
    modes: Modes,
    states: FloatArray,
    response: FloatArray,
) -> None:
    """Write the output after each of the first ``response.size`` intervals to ``response``.

    The car goes on from ``states``, shape (4,), which it leaves as they are then. A piece of a
    profile needs ``window`` points beyond its last interval, or the profile's end.
    """
    (a_re, a_im, a_gain_re, a_gain_im), (b_re, b_im, b_gain_re, b_gain_im) = modes
    a_x, a_y, b_x, b_y = states
    last = elevation.size - 1
    per_window = per_step / window
    for k in range(response.size):
        if k + window <= last:
            slope = (elevation[k + window] - elevation[k]) * per_window - start_slope
        else:
            slope = (elevation[last] - elevation[k]) * per_step / (last - k) - start_slope
        # The newest state enters each sum last: the chain from point to point stays short.
        a_next = (a_gain_re * slope - a_im * a_y) + a_re * a_x
        a_y = (a_gain_im * slope + a_im * a_x) + a_re * a_y
        a_x = a_next
        b_next = (b_gain_re * slope - b_im * b_y) + b_re * b_x
        b_y = (b_gain_im * slope + b_im * b_x) + b_re * b_y
        b_x = b_next
        response[k] = a_x + b_x
    states[0], states[1], states[2], states[3] = a_x, a_y, b_x, b_y


@compiled
def rectified_sums(
    elevation: FloatArray,
    window: int,
    start_slope: float,
    per_step: float,
    modes: Modes,
    edges: np.ndarray[tuple[int], np.dtype[np.int64]],
    sums: FloatArray,
) -> None:
    """Write the sum of the rectified output from ``edges[j]`` to ``edges[j + 1]`` to ``sums[j]``.

    The car runs once from the first interval to the last edge and is not started again.
    """
    (a_re, a_im, a_gain_re, a_gain_im), (b_re, b_im, b_gain_re, b_gain_im) = modes
    a_x = a_y = b_x = b_y = 0.0
    last = elevation.size - 1
    per_window = per_step / window
    for segment in range(sums.size):
        total = 0.0
        for k in range(edges[segment], edges[segment + 1]):
            if k + window <= last:
                slope = (elevation[k + window] - elevation[k]) * per_window - start_slope
            else:
                slope = (elevation[last] - elevation[k]) * per_step / (last - k) - start_slope
            a_next = (a_gain_re * slope - a_im * a_y) + a_re * a_x
            a_y = (a_gain_im * slope + a_im * a_x) + a_re * a_y
            a_x = a_next
            b_next = (b_gain_re * slope - b_im * b_y) + b_re * b_x
            b_y = (b_gain_im * slope + b_im * b_x) + b_re * b_y
            b_x = b_next
            total += abs(a_x + b_x)
        sums[segment] = total
