"""Unknown inputs and states of a linear model by Gillijns and De Moor: steps (a)-(c) of Zhu."""

from math import sqrt

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray
from floatref.vehicle_response.estimators.joint_values import Estimates, Memory, System

DEFICIENT = 1e-10
"""Share of a column of J, squared, that the others must not have, else its input is unknown."""


@compiled
def joint_input_state(samples: FloatArray, system: System, memory: Memory, out: Estimates) -> int:
    """Estimate inputs and states of ``samples``, shape (N, m), into ``out``; return samples done.

    That is less than N when states or covariance are no longer finite, or rounding has left it not
    positive. Readings not finite are left out. Where J of the others has no full rank, the step
    only predicts: the input is NaN, and its last value goes on with the variance ``unknown``, an
    error of which the part ``stays`` is the same at the next sample.
    """
    rows = system.variance.size
    present, before = np.empty(rows, dtype=np.int64), np.empty(rows, dtype=np.int64)
    known, ranked, size = -1, False, len(samples)
    for k in range(size):
        count = _finite(samples[k], present)
        if not _same(present, count, before, known):
            ranked, known = _full_rank(system, present, count), count
        if not ranked:
            _lose(system.unknown, memory.spread)
        elif not _update(samples[k], present, count, system, memory):
            return k
        _write(k, ranked, system.after, memory, out)
        _predict(system, memory, ranked)
        if not _stays_finite(memory):
            return k
    return size


@compiled
def _is_finite(value: float) -> bool:
    return value - value == 0.0


@compiled
def _stays_finite(memory: Memory) -> bool:
    for i in range(memory.state.size):
        if not (_is_finite(memory.covariance[i, i]) and _is_finite(memory.state[i])):
            return False
    return True


@compiled
def _finite(sample: FloatArray, present: IndexArray) -> int:
    """Write the places of the finite values; return how many there are."""
    count = 0
    for i in range(sample.size):
        if _is_finite(sample[i]):
            present[count] = i
            count += 1
    return count


@compiled
def _same(present: IndexArray, count: int, before: IndexArray, known: int) -> bool:
    """Return whether the same ``count`` are present as before; note them."""
    same = count == known
    for i in range(count):
        same = same and present[i] == before[i]
        before[i] = present[i]
    return same


@compiled
def _lose(unknown: FloatArray, spread: FloatArray) -> None:
    """Write the covariance of inputs that no reading shows."""
    for i in range(unknown.size):
        for j in range(unknown.size):
            spread[i, j] = unknown[i] if i == j else 0.0


@compiled
def _full_rank(system: System, present: IndexArray, count: int) -> bool:
    """Return whether the present rows of J, each over its sigma, have independent columns."""
    scaled = np.empty((count, system.direct.shape[1]))
    for r in range(count):
        for i in range(scaled.shape[1]):
            scaled[r, i] = system.direct[present[r], i] / sqrt(system.variance[present[r]])
    return _cholesky(_multiply_transposed(scaled, scaled), DEFICIENT)


@compiled
def _multiply_transposed(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return aᵀ·b."""
    product = np.zeros((a.shape[1], b.shape[1]))
    for r in range(a.shape[0]):
        for i in range(a.shape[1]):
            for j in range(b.shape[1]):
                product[i, j] += a[r, i] * b[r, j]
    return product


@compiled
def _add_product(a: FloatArray, b: FloatArray, total: FloatArray) -> None:
    """Add a·b to ``total``."""
    for i in range(a.shape[0]):
        for k in range(a.shape[1]):
            for j in range(b.shape[1]):
                total[i, j] += a[i, k] * b[k, j]


@compiled
def _add_times_transposed(a: FloatArray, b: FloatArray, total: FloatArray) -> None:
    """Add a·bᵀ to ``total``."""
    for i in range(a.shape[0]):
        for j in range(b.shape[0]):
            added = 0.0
            for k in range(a.shape[1]):
                added += a[i, k] * b[j, k]
            total[i, j] += added


@compiled
def _cholesky(matrix: FloatArray, least: float) -> bool:
    """Put L of L·Lᵀ in the lower half; False if a pivot is not above that share of its diagonal."""
    for j in range(matrix.shape[0]):
        pivot = matrix[j, j]
        for k in range(j):
            pivot -= matrix[j, k] * matrix[j, k]
        if not pivot > least * matrix[j, j]:
            return False
        matrix[j, j] = sqrt(pivot)
        for i in range(j + 1, matrix.shape[0]):
            total = matrix[i, j]
            for k in range(j):
                total -= matrix[i, k] * matrix[j, k]
            matrix[i, j] = total / matrix[j, j]
    return True


@compiled
def _divide(lower: FloatArray, right: FloatArray) -> None:
    """Put L⁻¹·right in the place of ``right``, shape (rows, columns)."""
    for i in range(right.shape[0]):
        for k in range(i):
            for c in range(right.shape[1]):
                right[i, c] -= lower[i, k] * right[k, c]
        for c in range(right.shape[1]):
            right[i, c] /= lower[i, i]


@compiled
def _update(
    sample: FloatArray, present: IndexArray, count: int, system: System, memory: Memory
) -> bool:
    """Do steps (a) and (b) of Zhu; return False, all as it was, if a matrix has no inverse.

    With R̃ = Λ·Λᵀ all of these steps is in W = Λ⁻¹·G·P, H = Λ⁻¹·J and e = Λ⁻¹·(Z - G·X).
    """
    size, inputs = system.influence.shape
    output, weighted = np.empty((count, size)), np.zeros((count, size))
    passed, left = np.empty((count, inputs)), np.empty((count, 1))
    spanned = np.zeros((count, count))
    for i in range(count):
        row = present[i]
        left[i, 0], spanned[i, i] = sample[row], system.variance[row]
        for k in range(size):
            output[i, k] = system.output[row, k]
            left[i, 0] -= output[i, k] * memory.state[k]
        for k in range(inputs):
            passed[i, k] = system.feedthrough[row, k]
    _add_product(output, memory.covariance, weighted)
    _add_times_transposed(weighted, output, spanned)
    if not _cholesky(spanned, 0.0):
        return False
    _divide(spanned, weighted)
    _divide(spanned, passed)
    _divide(spanned, left)
    root = _multiply_transposed(passed, passed)
    if not _cholesky(root, 0.0):
        return False
    _estimate(weighted, passed, left, root, memory)
    return True


@compiled
def _estimate(
    weighted: FloatArray, passed: FloatArray, left: FloatArray, root: FloatArray, memory: Memory
) -> None:
    """Write F, P_F, X, P and P_XF from W, H, e and the Cholesky factor ``root`` of HᵀH.

    L·(R̃ - J·P_F·Jᵀ)·Lᵀ of step (b) is WᵀW - (HᵀW)ᵀ·P_F·(HᵀW), and P_XF is -(HᵀW)ᵀ·P_F.
    """
    size, inputs = memory.crossed.shape
    inverse, common = np.eye(inputs), _multiply_transposed(passed, weighted)
    _divide(root, inverse)
    spread, seen = _multiply_transposed(inverse, inverse), _multiply_transposed(passed, left)
    taken, shared = _multiply_transposed(weighted, weighted), _multiply_transposed(common, spread)
    for i in range(inputs):
        memory.force[i] = 0.0
        for j in range(inputs):
            memory.spread[i, j] = spread[i, j]
            memory.force[i] += spread[i, j] * seen[j, 0]
    for r in range(left.shape[0]):
        for j in range(inputs):
            left[r, 0] -= passed[r, j] * memory.force[j]
    moved = _multiply_transposed(weighted, left)
    for i in range(size):
        memory.state[i] += moved[i, 0]
        for j in range(inputs):
            memory.crossed[i, j] = -shared[i, j]
        for j in range(size):
            memory.covariance[i, j] -= taken[i, j]
    _add_product(shared, common, memory.covariance)


@compiled
def _write(k: int, seen: bool, after: FloatArray, memory: Memory, out: Estimates) -> None:
    """Write inputs, states with ``after`` times the inputs, and their variances."""
    size, inputs = after.shape
    for j in range(inputs):
        out.forces[k, j] = memory.force[j] if seen else np.nan
        out.force_variance[k, j] = memory.spread[j, j] if seen else np.nan
    for i in range(size):
        mean, square = memory.state[i], memory.covariance[i, i]
        for j in range(inputs):
            mean += after[i, j] * memory.force[j]
            square += 2.0 * after[i, j] * memory.crossed[i, j]
            for m in range(inputs):
                square += after[i, j] * after[i, m] * memory.spread[j, m]
        out.states[k, i], out.states_variance[k, i] = mean, square


@compiled
def _predict(system: System, memory: Memory, seen: bool) -> None:
    """Do step (c) of Zhu: the next states and covariance, and what they owe to the inputs.

    Inputs that are ``seen``, and so estimated anew or lost from now on, leave nothing.
    """
    a, b = system.transition, system.influence
    size, inputs = b.shape
    half, side, whole = np.zeros((size, size)), np.zeros((size, inputs)), np.zeros((size, size))
    moved = np.zeros((size, 1))
    _add_product(a, memory.state.reshape(size, 1), moved)
    _add_product(b, memory.force.reshape(inputs, 1), moved)
    _add_product(a, memory.covariance, half)
    _add_times_transposed(b, memory.crossed, half)
    _add_product(a, memory.crossed, side)
    _add_product(b, memory.spread, side)
    _add_times_transposed(half, a, whole)
    _add_times_transposed(side, b, whole)
    for i in range(size):
        memory.state[i] = moved[i, 0]
        for j in range(inputs):
            memory.crossed[i, j] = 0.0 if seen else system.stays * side[i, j]
        for j in range(size):
            mean = 0.5 * (whole[i, j] + whole[j, i])
            memory.covariance[i, j] = mean + system.disturbance[i, j]
