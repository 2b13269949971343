"""How far an encoder has been: its steps ahead, and the samples that lie behind."""

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray

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
