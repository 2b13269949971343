"""Samples of a push, copied and checked in one loop: numpy takes three calls for that."""

from math import inf

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray


@compiled
def copy_sound(values: FloatArray, target: FloatArray, start: int) -> bool:
    """Copy ``values``, shape (N,), into ``target`` from ``start`` on; False if one is infinite.

    ``target`` has room for them. NaN, a missing sample, is sound.
    """
    sound = True
    for k in range(values.size):
        target[start + k] = values[k]
        # No branch: 160 samples are copied in vectors.
        sound &= abs(values[k]) != inf
    return sound
