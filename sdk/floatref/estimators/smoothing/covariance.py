"""How covariances of the smoother follow from those of the filter, between a few of its nodes."""

from math import cos, exp, sin, sqrt

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import BoolArray, FloatArray, IndexArray


@compiled
def settle(column: FloatArray, passed: FloatArray, gathered: FloatArray, left: FloatArray) -> None:
    """Write (I - Lambda P) e_r of all marks into ``left``, nothing known behind the last.

    Lambda, the covariance of lambda, goes back as Psi' Lambda Psi + G.
    """
    states = column.shape[1]
    information, half = np.zeros((states, states)), np.zeros((states, states))
    for k in range(column.shape[0] - 1, -1, -1):
        for i in range(states):
            total = 1.0 if i == 0 else 0.0
            for j in range(states):
                total -= information[i, j] * column[k, j]
            left[k, i] = total
        _multiply_transposed(information, passed[k], half)
        _multiply_transposed(passed[k], half, information)
        for i in range(states):
            for j in range(states):
                information[i, j] += gathered[k, i, j]


@compiled
def _multiply_transposed(a: FloatArray, b: FloatArray, product: FloatArray) -> None:
    """Write a' b into ``product``."""
    states = a.shape[0]
    for i in range(states):
        for j in range(states):
            total = 0.0
            for k in range(states):
                total += a[k, i] * b[k, j]
            product[i, j] = total


@compiled
def compose(between: BoolArray, passed: FloatArray, gathered: FloatArray) -> None:
    """Put what passes through the marks ``between`` others into the mark behind each.

    Over two steps Psi is Psi_2 Psi_1, and G is G_1 + Psi_1' G_2 Psi_1. The last mark is a mark that
    stays.
    """
    states = passed.shape[1]
    half, product = np.zeros((states, states)), np.zeros((states, states))
    for k in range(between.size - 1):
        if not between[k]:
            continue
        for i in range(states):
            for j in range(states):
                total = 0.0
                for n in range(states):
                    total += passed[k + 1, i, n] * passed[k, n, j]
                product[i, j] = total
        _multiply_transposed(gathered[k + 1], passed[k], half)
        _multiply_transposed(passed[k], half, gathered[k + 1])
        for i in range(states):
            for j in range(states):
                gathered[k + 1, i, j] += gathered[k, i, j]
                passed[k + 1, i, j] = product[i, j]


@compiled
def relate(
    column: FloatArray,
    left: FloatArray,
    passed: FloatArray,
    distance_m: FloatArray,
    width_m: float,
    found: FloatArray,
) -> None:
    """Write E[e_i e_j] of the smoothed heights at all marks up to ``width_m`` apart, (n, n)."""
    states = column.shape[1]
    moved, carried = np.zeros(states), np.zeros(states)
    for i in range(column.shape[0]):
        for s in range(states):
            moved[s] = column[i, s]
        for j in range(i, column.shape[0]):
            if distance_m[j] - distance_m[i] > width_m:
                break
            if j > i:
                _apply(passed[j], moved, carried)
            total = 0.0
            for s in range(states):
                total += left[j, s] * moved[s]
            found[i, j], found[j, i] = total, total


@compiled
def spread(
    related: FloatArray, weights: FloatArray, low: IndexArray, high: IndexArray, found: FloatArray
) -> None:
    """Write the variance of the weighted sums of errors into ``found``, shape (m,).

    Row k of ``weights``, shape (m, n), is 0 but for marks ``low[k]`` to ``high[k] - 1``.
    """
    for k in range(found.size):
        total = 0.0
        for i in range(low[k], high[k]):
            inner = 0.5 * weights[k, i] * related[i, i]
            for j in range(i + 1, high[k]):
                inner += weights[k, j] * related[i, j]
            total += 2.0 * weights[k, i] * inner
        found[k] = total


@compiled
def reach(column: FloatArray, passed: FloatArray, found: FloatArray) -> None:
    """Write Psi P e_r, from each mark to the last, into ``found``, shape (n, states)."""
    size, states = column.shape
    # What is multiplied up is Psi'.
    psi, product = np.zeros((states, states)), np.zeros((states, states))
    for i in range(states):
        psi[i, i] = 1.0
    for k in range(size - 1, -1, -1):
        for i in range(states):
            total = 0.0
            for j in range(states):
                total += psi[j, i] * column[k, j]
            found[k, i] = total
        _multiply_transposed(passed[k], psi, product)
        for i in range(states):
            for j in range(states):
                psi[i, j] = product[i, j]


@compiled
def _apply(psi: FloatArray, vector: FloatArray, carried: FloatArray) -> None:
    states = vector.size
    for i in range(states):
        total = 0.0
        for j in range(states):
            total += psi[i, j] * vector[j]
        carried[i] = total
    for i in range(states):
        vector[i] = carried[i]


@compiled
def high_pass(
    distance_m: FloatArray, wanted: IndexArray, cutoff: float, reach_m: float, found: FloatArray
) -> None:
    """Write what HPF_B3x2 takes of all marks for those ``wanted``, in order.

    ``found`` has shape (m, n) and is zero; ``cutoff`` is a wave number in rad/m, and marks further
    than ``reach_m`` away count nothing.
    """
    size, root, low = distance_m.size, sqrt(0.75), 0
    for k in range(wanted.size):
        row, place, total = found[k], distance_m[wanted[k]], 0.0
        while place - distance_m[low] > reach_m:
            low += 1
        end = low
        while end < size and distance_m[end] - place <= reach_m:
            width = distance_m[min(end + 1, size - 1)] - distance_m[max(end - 1, 0)]
            a = cutoff * abs(distance_m[end] - place)
            b = root * a
            row[end] = width * (exp(-a) + exp(-0.5 * a) * (cos(b) + 2.0 * root * sin(b)))
            total += row[end]
            end += 1
        for j in range(low, end):
            row[j] = -row[j] / total if total > 0.0 else -1.0 / (end - low)
        row[wanted[k]] += 1.0
