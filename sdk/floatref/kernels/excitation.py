"""What the encoder tells of the vehicle's longitudinal motion, and how its body answers."""

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray


@compiled
def curvature(values: FloatArray, weights: FloatArray, found: FloatArray) -> None:
    """Write the sums of ``values`` k to k + n - 1 by the n ``weights`` into ``found[k]``."""
    for k in range(found.size):
        total = 0.0
        for j in range(weights.size):
            total += weights[j] * values[k + j]
        found[k] = total


@compiled
def respond(
    a: FloatArray, by: FloatArray, fade: float, memory: FloatArray, found: FloatArray
) -> None:
    """Write the response of an oscillator to ``a``; NaN there are made the latest, times ``fade``.

    ``memory`` holds response, its rate and the latest of ``a``; ``by``, shape (2, 4), what the next
    response and rate are made of: those three and the next of ``a``.
    """
    value, rate, latest = memory[0], memory[1], memory[2]
    for k in range(a.size):
        if a[k] != a[k]:
            a[k] = fade * latest
        new = by[0, 0] * value + by[0, 1] * rate + by[0, 2] * latest + by[0, 3] * a[k]
        rate = by[1, 0] * value + by[1, 1] * rate + by[1, 2] * latest + by[1, 3] * a[k]
        value, latest = new, a[k]
        found[k] = value
    memory[0], memory[1], memory[2] = value, rate, latest
