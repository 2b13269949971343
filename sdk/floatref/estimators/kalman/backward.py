"""The Bryson-Frazier backward pass over the nodes of the filter, and its result at every sample.

The adjoint lambda takes the place of the gain L of (6.17): x_s = x - P lambda, without an inverse
of P. Inside a sub-block the correction of the height is a cubic of its values and slopes at the
ends.
"""

import numpy as np

from floatref.estimators.kalman.layout import (
    BIAS,
    INNOVATION,
    JUMP,
    LEAN,
    OFFSET,
    RENEWED,
    SHIFT,
    SPREAD,
    STATES,
)
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray


@compiled
def smooth(
    node_at: IndexArray,
    nodes: FloatArray,
    updates: FloatArray,
    before: int,
    step: float,
    adjoint: FloatArray,
    corrections: FloatArray,
) -> None:
    """Go back from the last node to the one at sample ``before``, in place of (6.17).

    That one is not in ``nodes``. ``adjoint``, shape (10,), is lambda behind the last node and
    becomes that behind ``before``. Row k of ``corrections``, shape (n, 4), gets height and velocity
    to be added on the near side of the update of node k, and the same on the far side.
    """
    for k in range(node_at.shape[0] - 1, -1, -1):
        node, out = nodes[k], corrections[k]
        correct(node, adjoint, out)
        out[0], out[1] = out[2] + node[JUMP], out[3] + node[JUMP + 1]
        low = node_at[k - 1, 1] if k > 0 else 0
        for m in range(node_at[k, 1] - 1, low - 1, -1):
            _undo(updates[m], adjoint)
        if node[RENEWED] == LEAN:
            adjoint[LEAN] = node[SHIFT] * adjoint[BIAS]
        elif node[RENEWED] == OFFSET:
            adjoint[0] -= adjoint[OFFSET]
            adjoint[OFFSET] = 0.0
        earlier = node_at[k - 1, 0] if k > 0 else before
        _back(node, (node_at[k, 0] - earlier) * step, adjoint)


@compiled
def correct(node: FloatArray, adjoint: FloatArray, out: FloatArray) -> None:
    """Write -P lambda of height and velocity behind ``node`` into ``out[2:4]``."""
    rise, climb = 0.0, node[SPREAD + 1] * adjoint[0]
    for j in range(STATES):
        rise -= node[SPREAD + j] * adjoint[j]
    climb = -climb
    for j in range(1, STATES):
        climb -= node[SPREAD + STATES - 1 + j] * adjoint[j]
    out[2], out[3] = rise, climb


@compiled
def _undo(update: FloatArray, adjoint: FloatArray) -> None:
    """Lambda <- (I - K H)' lambda - H' (y - h) / S."""
    total = update[INNOVATION]
    for j in range(STATES):
        total += update[STATES + j] * adjoint[j]
    for j in range(STATES):
        adjoint[j] -= update[j] * total


@compiled
def _back(node: FloatArray, span: float, adjoint: FloatArray) -> None:
    """Lambda <- F' lambda over ``span`` in s."""
    by_r, by_v, by_theta, by_phi = adjoint[0], adjoint[1], adjoint[2], adjoint[3]
    adjoint[1] += span * by_r
    adjoint[4] += span * by_v + 0.5 * span * span * by_r
    adjoint[LEAN] += by_r * node[16] + by_v * node[17]
    for j in range(4):
        moved = by_r * node[j] + by_v * node[4 + j] + by_theta * node[8 + j] + by_phi * node[12 + j]
        if j < 2:
            adjoint[2 + j] = moved
        else:
            adjoint[3 + j] += moved


@compiled
def closed_loop(
    node_at: IndexArray,
    nodes: FloatArray,
    updates: FloatArray,
    before: int,
    step: float,
    wanted: IndexArray,
    passed: FloatArray,
    gathered: FloatArray,
) -> None:
    """Write how an error of the filter passes on between the nodes ``wanted``.

    ``passed[k]``, shape (10, 10), gets Psi, the product of (I - K H) F from the node wanted before
    (from the sample ``before``) to number k, ``gathered[k]`` the sum of Psi' H' H Psi / S on the
    way: what the observations there add to the covariance of lambda.
    """
    at, done, seen = 0, 0, np.empty(STATES)
    _identity(passed[0], gathered[0])
    for k in range(node_at.shape[0]):
        psi, sums = passed[at], gathered[at]
        span = (node_at[k, 0] - (node_at[k - 1, 0] if k > 0 else before)) * step
        _forth(nodes[k], span, psi)
        for m in range(done, node_at[k, 1]):
            _reduce(updates[m], psi, sums, seen)
        done = node_at[k, 1]
        if wanted[at] == k:
            at += 1
            if at == wanted.size:
                return
            _identity(passed[at], gathered[at])


@compiled
def _identity(psi: FloatArray, sums: FloatArray) -> None:
    for i in range(STATES):
        for j in range(STATES):
            psi[i, j], sums[i, j] = 0.0, 0.0
        psi[i, i] = 1.0


@compiled
def _forth(node: FloatArray, span: float, psi: FloatArray) -> None:
    """Psi <- F Psi over ``span`` in s."""
    half = 0.5 * span * span
    for c in range(STATES):
        moved = psi[0, c] + span * psi[1, c] + half * psi[4, c] + node[16] * psi[LEAN, c]
        climb = psi[1, c] + span * psi[4, c] + node[17] * psi[LEAN, c]
        theta, phi = 0.0, 0.0
        for j in range(4):
            value = psi[2 + j, c] if j < 2 else psi[3 + j, c]
            moved += node[j] * value
            climb += node[4 + j] * value
            theta += node[8 + j] * value
            phi += node[12 + j] * value
        psi[0, c], psi[1, c], psi[2, c], psi[3, c] = moved, climb, theta, phi
        if node[RENEWED] == LEAN:
            psi[BIAS, c] += node[SHIFT] * psi[LEAN, c]
            psi[LEAN, c] = 0.0
        elif node[RENEWED] == OFFSET:
            psi[OFFSET, c] = -psi[0, c]


@compiled
def _reduce(update: FloatArray, psi: FloatArray, sums: FloatArray, seen: FloatArray) -> None:
    """Add Psi' H' H Psi / S to ``sums``; Psi <- (I - K H) Psi."""
    for c in range(STATES):
        seen[c] = 0.0
    for j in range(STATES):
        for c in range(STATES):
            seen[c] += update[j] * psi[j, c]
    for i in range(STATES):
        scaled, gain = seen[i] * update[INNOVATION + 1], update[STATES + i]
        for c in range(STATES):
            sums[i, c] += scaled * seen[c]
            psi[i, c] -= gain * seen[c]
