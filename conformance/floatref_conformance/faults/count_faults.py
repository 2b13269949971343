"""What a faulty encoder does to the distance: effects that last to the end of the run.

Each is an effect of a stretch that begins where the fault begins and ends with the run, and takes
the time for which the fault lasts.
"""

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.faults.sample_faults import Effect

COUNTER = 65_536
"""A counter of 16 bits returns to 0 after this number of counts."""


def count(factor: float, length_s: float = np.inf) -> Effect:
    """Count ``factor`` times the counts for ``length_s``; what is not counted stays lost."""

    def apply(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
        steps = np.diff(values, prepend=values[:1])
        steps[times < times[0] + length_s] *= factor
        return np.asarray(values[0] + np.cumsum(steps))

    return apply


def silence(length_s: float) -> Effect:
    """Hold the distance for ``length_s``; then it is true again."""
    return lambda values, times, source: np.where(times < times[0] + length_s, values[:1], values)


def leap(size_m: float) -> Effect:
    """Count ``size_m`` at once that were not travelled."""
    return lambda values, times, source: values + size_m


def descend(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
    """Count backwards: both lines of the encoder are exchanged."""
    return np.asarray(2.0 * values[0] - values)


def wrap(count_m: float) -> Effect:
    """Return to 0 as a counter of 16 bits does, at ``count_m`` for each count."""
    return lambda values, times, source: np.mod(values, COUNTER * count_m)


def tremble(size_m: float, share: float) -> Effect:
    """Be ``size_m`` behind in single samples, ``share`` of all: edges that are read twice."""
    return lambda values, times, source: (
        values - size_m * (source.uniform(size=values.size) < share)
    )


def jitter(sigma_s: float) -> Effect:
    """Read counts at moments that are off by ``sigma_s``."""

    def apply(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
        read_s = times + sigma_s * source.standard_normal(times.size)
        return np.maximum.accumulate(np.interp(read_s, times, values))

    return apply


def hesitate(every_s: float, length_s: float) -> Effect:
    """Hold for ``length_s`` in every ``every_s`` and catch up: a bus that delivers late."""

    def apply(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
        held = np.mod(times - times[0], every_s) >= every_s - length_s
        last = np.maximum.accumulate(np.where(held, 0, np.arange(values.size)))
        return values[last]

    return apply
