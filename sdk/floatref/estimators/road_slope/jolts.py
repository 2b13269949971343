"""The acceleration along the road where a brake ends: as sharp as the encoder allows, and jolts."""

import numpy as np
from scipy.sparse import csr_array

from floatref.estimators.road_slope.readings import Readings
from floatref.values.arrays import FloatArray

MOVING_MPS = 0.5
"""Speed from which counts of the encoder follow each other within a node."""
NOISE_MPS2 = 0.1
"""Noise of the unsmoothed acceleration at which it has half a part."""
NORMAL = 1.4826
"""1-σ of a normal distribution over its median magnitude."""
DECAY_S, BESIDE = 0.5, 3
"""Time in which the wheels come to rest after a jolt, and nodes before and behind it."""


def sharpen(readings: Readings, shares: csr_array, second: csr_array) -> FloatArray:
    """Return the acceleration along the road at the middles, in m/s².

    The smooth one takes a tenth of a second for the end of a brake; the ``second`` difference of
    places is as fast as the brake, and has the noise of the encoder's counts. ``shares`` is the
    mean of three nodes.
    """
    smooth = shares @ readings.along
    off = second @ readings.place - smooth
    moving = readings.speed[readings.middles] >= MOVING_MPS
    noise = NORMAL * float(np.median(np.abs(off[moving]))) if moving.any() else 0.0
    found: FloatArray = smooth + off / (1.0 + (noise / NOISE_MPS2) ** 2)
    return found


def jolts(readings: Readings) -> FloatArray:
    """Return J of every node in m/s²: how much the acceleration has just changed."""
    step = readings.interval_s
    changed = np.abs(np.diff(readings.along, prepend=readings.along[0]))
    goes_on = np.where(readings.pause_s < 1.5 * step, np.exp(-step / DECAY_S), 0.0)
    goes_on[0] = 0.0
    summed, total = np.zeros(changed.size), 0.0
    for k in range(changed.size):
        total = total * goes_on[k] + (changed[k] if goes_on[k] else 0.0)
        summed[k] = total
    padded = np.pad(summed, BESIDE, "edge")
    found: FloatArray = np.max(
        np.lib.stride_tricks.sliding_window_view(padded, 2 * BESIDE + 1), axis=1
    )
    return found
