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


PROGRESS = 5
"""Length of the memory of `progress`: how far the signal has been, the index of the last sample
there, whether the sample before is known, the sum of its steps and of their squares."""


@compiled
def progress(
    x: FloatArray,
    first: int,
    memory: FloatArray,
    longer: float,
    steps: IndexArray,
    behind: IndexArray,
) -> tuple[int, int]:
    """Follow how far ``x`` has been; return the number of rows of ``steps`` and of ``behind``.

    A row of ``steps`` gets the index of a sample that is farther by more than ``longer`` than all
    before it, and that of the last one which was as far as any; ``behind`` the index of samples
    that are less far. A step from a missing (NaN) sample is none.
    """
    far, back = 0, 0
    for i in range(x.size):
        value, step = x[i], x[i] - memory[0]
        if value != value:
            memory[2] = 0.0
            continue
        if step < 0.0:
            behind[back] = first + i
            back += 1
        else:
            if memory[2] != 0.0:
                memory[3] += step
                memory[4] += step * step
                if step > longer:
                    steps[far, 0], steps[far, 1] = first + i, int(memory[1])
                    far += 1
            memory[0], memory[1] = value, float(first + i)
        memory[2] = 1.0
    return far, back
