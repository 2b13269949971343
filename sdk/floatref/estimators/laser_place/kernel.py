"""Compiled loops: the half car's smoother of constant gain, and filters in sections."""

import numpy as np

from floatref.kernels.compiling import compiled, compiled_unfused
from floatref.values.arrays import FloatArray


@compiled
def filter_forward(
    transition: FloatArray,
    before: FloatArray,
    now: FloatArray,
    gain: FloatArray,
    reading: FloatArray,
    direct: FloatArray,
    u: FloatArray,
    force: FloatArray,
    predicted: FloatArray,
    filtered: FloatArray,
) -> None:
    """Write the states before and after each reading of ``force``, shape (n, states) each.

    ``filtered[0]`` holds the first state on entry; ``u``, shape (n, inputs), is linear between
    samples. For the others see `half_car.Gains` and `half_car.HalfCar`.
    """
    size, inputs = gain.size, direct.size
    for k in range(force.size):
        error = force[k]
        for i in range(size):
            x = 0.0
            if k == 0:
                x = filtered[0, i]
            else:
                for j in range(size):
                    x += transition[i, j] * filtered[k - 1, j]
                for j in range(inputs):
                    x += before[i, j] * u[k - 1, j] + now[i, j] * u[k, j]
            predicted[k, i] = x
            error -= reading[i] * x
        for j in range(inputs):
            error -= direct[j] * u[k, j]
        for i in range(size):
            filtered[k, i] = predicted[k, i] + gain[i] * error


@compiled
def smooth_backward(back: FloatArray, predicted: FloatArray, filtered: FloatArray) -> None:
    """Replace the ``filtered`` states by the smoothed ones, from the last to the first."""
    size = back.shape[0]
    change = np.empty(size)
    for k in range(filtered.shape[0] - 2, -1, -1):
        for j in range(size):
            change[j] = filtered[k + 1, j] - predicted[k + 1, j]
        for i in range(size):
            x = filtered[k, i]
            for j in range(size):
                x += back[i, j] * change[j]
            filtered[k, i] = x


@compiled_unfused
def filter_sections(sections: FloatArray, states: FloatArray, x: FloatArray) -> None:
    """Replace ``x`` by what the sections of second order make of it, one after the other.

    ``sections`` has shape (m, 6), as `band.sections_of` returns them, and ``states`` (m, 2): what
    each remembers before the first sample.
    """
    for s in range(sections.shape[0]):
        b0, b1, b2 = sections[s, 0], sections[s, 1], sections[s, 2]
        a1, a2 = sections[s, 4], sections[s, 5]
        near, far = states[s, 0], states[s, 1]
        for k in range(x.size):
            value = x[k]
            y = b0 * value + near
            near = b1 * value - a1 * y + far
            far = b2 * value - a2 * y
            x[k] = y
