"""Runs of identical samples: held readings, stuck sensors, sensors at the end of their range."""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray

LONGEST = 4096
"""Runs of this length and above are counted together."""


def new_open_run() -> FloatArray:
    """Return the memory of `find_runs`: length, first index and value of the run that is open."""
    return np.zeros(3)


def new_count() -> FloatArray:
    """Return the memory of `count_runs`.

    That is length and value of the run that is open, the smallest step between different samples,
    and the samples in runs of `LONGEST` and above.
    """
    return np.array([0.0, np.nan, np.inf, 0.0])


@compiled
def _same_after(x: FloatArray, begin: int, value: float) -> int:
    """Return the index behind the samples from ``begin`` on that are ``value``."""
    end = begin
    while end < x.size and x[end] == value:
        end += 1
    return end


@compiled
def _same_before(x: FloatArray, begin: int, last: int) -> int:
    """Return the index of the first sample from ``begin`` on that all up to ``last`` equal."""
    value = x[last]
    while last > begin and x[last - 1] == value:
        last -= 1
    return last


@compiled
def find_runs(
    x: FloatArray,
    first: int,
    least: int,
    outside: FloatArray,
    memory: FloatArray,
    runs: FloatArray,
) -> tuple[int, int]:
    """Find the runs of ``least``, 2 or more, identical samples in ``x``.

    ``first`` is the index of ``x[0]`` in the channel. A row of ``runs`` gets first index, length
    and value of a run that is at most ``outside[0]`` or at least ``outside[1]``. Returns how many
    there are and how many samples are done with: the rest of ``x`` is to be given again, with what
    follows. A run up to the end of ``x`` is left open in ``memory``. Samples that cannot be part of
    a run of ``least`` are skipped.
    """
    found, i = 0, 0
    if memory[0] > 0.0:
        i = _same_after(x, 0, memory[2])
        memory[0] += i
        if i == x.size:
            return 0, i
        runs[0, 0], runs[0, 1], runs[0, 2] = memory[1], memory[0], memory[2]
        found, memory[0] = 1, 0.0
    while i + least <= x.size:
        same = _same_before(x, i, i + least - 1)
        if same > i:
            i = same
            continue
        value = x[i]
        end = _same_after(x, i + least, value)
        if value <= outside[0] or value >= outside[1]:
            if end == x.size:
                memory[0], memory[1], memory[2] = float(end - i), float(first + i), value
                return found, end
            runs[found, 0], runs[found, 1], runs[found, 2] = float(first + i), float(end - i), value
            found += 1
        i = end
    return found, i


@compiled
def count_runs(x: FloatArray, over: float, memory: FloatArray, held: IndexArray) -> None:
    """Count the runs of identical samples that end in ``x``: ``held[n]`` those of n samples.

    Those that end by a step of up to ``over`` are left out. Runs of ``held.size - 1`` and above
    are counted together. A missing (NaN) sample is in no run.
    """
    for i in range(x.size):
        value, length = x[i], memory[0]
        if length > 0.0:
            if value == memory[1]:
                memory[0] = length + 1.0
                continue
            step = abs(value - memory[1]) if value == value else np.inf
            memory[2] = min(memory[2], step)
            if step > over:
                held[min(int(length), held.size - 1)] += 1
                memory[3] += length if length >= held.size - 1 else 0.0
        memory[0], memory[1] = (1.0, value) if value == value else (0.0, value)
