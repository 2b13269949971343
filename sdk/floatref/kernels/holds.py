"""Runs of identical samples: held readings, stuck sensors, sensors at the end of their range."""

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray

MEMORY = 7
"""Length of the memory: length, value and first index of the run that is open, the step into it,
the smallest step between different samples, the least and the greatest sample."""
LONGEST = 4096
"""Runs of this length and above are counted together."""


@compiled
def find_runs(
    x: FloatArray,
    first: int,
    least: int,
    memory: FloatArray,
    held: IndexArray,
    runs: FloatArray,
) -> int:
    """Find the runs of ``least`` or more identical samples that end in ``x``; return how many.

    ``first`` is the index of ``x[0]`` in the channel. A row of ``runs`` gets first index, length,
    value, and the larger of the steps into the run and out of it. ``held[n]`` grows by the samples
    that lie in runs of length n. A missing (NaN) sample is in no run, and a step from or to it is
    beyond all others.
    """
    found = 0
    for i in range(x.size):
        value, length = x[i], memory[0]
        if length > 0.0 and value == memory[1]:
            memory[0] = length + 1.0
            continue
        step = abs(value - memory[1]) if length > 0.0 and value == value else 1e300
        if length > 0.0:
            held[min(int(length), held.size - 1)] += int(length)
            if value == value and step < memory[4]:
                memory[4] = step
            if length >= least:
                runs[found, 0], runs[found, 1] = memory[2], length
                runs[found, 2], runs[found, 3] = memory[1], max(step, memory[3])
                found += 1
        if value == value:
            memory[0], memory[1], memory[2], memory[3] = 1.0, value, float(first + i), step
            memory[5], memory[6] = min(memory[5], value), max(memory[6], value)
        else:
            memory[0] = 0.0
    return found
