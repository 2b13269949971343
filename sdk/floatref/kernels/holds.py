"""Runs of identical samples: held readings, stuck sensors, sensors at the end of their range."""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray, Records, new_record

LONGEST = 4096
"""Runs of this length and above are counted together."""


RUN = np.dtype([("first", np.int64), ("length", np.int64), ("value", np.float64)], align=True)
"""A run: first index, length and value; length 0 if `find_runs` has no open one."""

COUNT = np.dtype(
    [
        *((name, np.float64) for name in ("value", "quantum")),
        *((name, np.int64) for name in ("length", "in_long")),
    ],
    align=True,
)
"""The memory of `count_runs`: value and length of the run that is open, the smallest step between
different samples, and the samples in runs of `LONGEST` and above (in_long)."""


def new_count() -> np.record:
    """Return the memory of `count_runs` before any sample."""
    count = new_record(COUNT)
    count.value, count.quantum = np.nan, np.inf
    return count


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
    memory: np.record,
    runs: Records,
) -> tuple[int, int]:
    """Find the runs of ``least``, 2 or more, identical samples in ``x``.

    Runs whose value is at most ``outside[0]`` or at least ``outside[1]`` are written into ``runs``;
    ``first`` is the index of ``x[0]`` in the channel. Returns the number of runs written, and the
    number of samples that are done with: the caller gives the rest of ``x`` again, with what
    follows. A run up to the end of ``x`` is left open in ``memory``. Samples that cannot be part of
    a run of ``least`` are skipped.
    """
    found, i = 0, 0
    if memory.length > 0:
        i = _same_after(x, 0, memory.value)
        length = memory.length + i
        memory.length = length
        if i == x.size:
            return 0, i
        _write(runs[0], memory.first, length, memory.value)
        found, memory.length = 1, 0
    while i + least <= x.size:
        same = _same_before(x, i, i + least - 1)
        if same > i:
            i = same
            continue
        value = x[i]
        end = _same_after(x, i + least, value)
        if value <= outside[0] or value >= outside[1]:
            if end == x.size:
                _write(memory, first + i, end - i, value)
                return found, end
            _write(runs[found], first + i, end - i, value)
            found += 1
        i = end
    return found, i


@compiled
def _write(run: np.record, first: int, length: int, value: float) -> None:
    """Make ``run`` this one."""
    run.first, run.length, run.value = first, length, value


@compiled
def count_runs(x: FloatArray, over: float, memory: np.record, held: IndexArray) -> None:
    """Count the runs of identical samples that end in ``x``: ``held[n]`` those of n samples.

    Those that end by a step of up to ``over`` are left out. Runs of ``held.size - 1`` and above
    are counted together. A missing (NaN) sample is in no run.
    """
    for i in range(x.size):
        value, length = x[i], memory.length
        if length > 0:
            if value == memory.value:
                memory.length = length + 1
                continue
            step = abs(value - memory.value) if value == value else np.inf
            memory.quantum = min(memory.quantum, step)
            if step > over:
                held[min(length, held.size - 1)] += 1
                memory.in_long += length if length >= held.size - 1 else 0
        memory.length, memory.value = (1 if value == value else 0), value
