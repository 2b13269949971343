"""A signal at times between its samples: a sum of windowed sincs that passes a lower band."""

from math import floor

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray


@compiled
def interpolate(
    samples: FloatArray,
    first: int,
    begin: int,
    ratio: float,
    reach: float,
    half: FloatArray,
    found: FloatArray,
) -> None:
    """Write the signal at the places ``(begin + k)·ratio``, counted in input samples.

    ``samples`` begins at the input sample ``first``. ``half`` is the weight at evenly spaced
    distances from 0 to ``reach`` input samples; between them it is linear. Weights are brought to
    the sum 1. What reaches beyond ``samples``, or to a missing (NaN) one, is NaN.
    """
    spread = (half.size - 1) / reach
    for k in range(found.size):
        place = (begin + k) * ratio
        low = floor(place - reach) + 1
        high = floor(place + reach)
        if low < first or high >= first + samples.size:
            found[k] = np.nan
            continue
        total, weights = 0.0, 0.0
        for i in range(low, high + 1):
            at = abs(i - place) * spread
            cell = min(int(at), half.size - 2)
            weight = half[cell] + (at - cell) * (half[cell + 1] - half[cell])
            total += weight * samples[i - first]
            weights += weight
        found[k] = total / weights
