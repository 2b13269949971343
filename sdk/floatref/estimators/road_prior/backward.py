"""The Bryson-Frazier backward pass of the road-prior smoother, and how errors pass on."""

import numpy as np

from floatref.estimators.road_prior.layout import (
    BIAS,
    CLIMBS,
    INNOVATION,
    JUMP,
    LEAN,
    ONCE,
    RENEWED,
    ROAD,
    SLOPE,
    SPREAD,
    STATES,
    STAYS,
    TILT,
    TWICE,
)
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray


@compiled
def smooth(
    node_at: IndexArray,
    rows: FloatArray,
    updates: FloatArray,
    before: int,
    step: float,
    adjoint: FloatArray,
    corrections: FloatArray,
) -> None:
    """Go back from the last node to the one at sample ``before``; for the arrays see `Nodes`."""
    for k in range(node_at.shape[0] - 1, -1, -1):
        row, out = rows[k], corrections[k]
        correct(row, adjoint, out)
        out[0], out[1] = out[2] + row[JUMP], out[3] + row[JUMP + 1]
        low = node_at[k - 1, 1] if k > 0 else 0
        for m in range(node_at[k, 1] - 1, low - 1, -1):
            _undo(updates[m], adjoint)
        if row[RENEWED] > 0.0:
            adjoint[LEAN], adjoint[TILT] = 0.0, 0.0
        earlier = node_at[k - 1, 0] if k > 0 else before
        _back(row, (node_at[k, 0] - earlier) * step, adjoint)


@compiled
def correct(row: FloatArray, adjoint: FloatArray, out: FloatArray) -> None:
    """Write -P lambda of height and velocity behind a node into ``out[2:4]``."""
    rise, climb = 0.0, row[SPREAD + 1] * adjoint[0]
    for j in range(STATES):
        rise += row[SPREAD + j] * adjoint[j]
    for j in range(1, STATES):
        climb += row[SPREAD + STATES - 1 + j] * adjoint[j]
    out[2], out[3] = -rise, -climb


@compiled
def _undo(update: FloatArray, adjoint: FloatArray) -> None:
    """Lambda <- (I - K H)' lambda - H' (y - h) / S."""
    total = update[INNOVATION]
    for j in range(STATES):
        total += update[j] * adjoint[j]
    adjoint[0] -= total
    adjoint[ROAD] += total


@compiled
def _back(row: FloatArray, span: float, adjoint: FloatArray) -> None:
    """Lambda <- F' lambda over ``span`` in s."""
    by_r, by_v = adjoint[0], adjoint[1]
    adjoint[1] += span * by_r
    adjoint[BIAS] -= span * (by_v + 0.5 * span * by_r)
    adjoint[LEAN] -= row[TWICE] * by_r + row[ONCE] * by_v
    adjoint[TILT] -= row[TWICE + 1] * by_r + row[ONCE + 1] * by_v
    adjoint[SLOPE] = row[STAYS] * adjoint[SLOPE] + row[CLIMBS] * adjoint[ROAD]
    adjoint[ROAD] *= row[STAYS]


@compiled
def closed_loop(
    node_at: IndexArray,
    rows: FloatArray,
    updates: FloatArray,
    before: int,
    step: float,
    wanted: IndexArray,
    passed: FloatArray,
    gathered: FloatArray,
) -> None:
    """Write how an error of the filter passes on between the nodes ``wanted``; see `Nodes`."""
    at, done, seen = 0, 0, np.empty(STATES)
    _identity(passed[0], gathered[0])
    for k in range(node_at.shape[0]):
        psi, sums = passed[at], gathered[at]
        span = (node_at[k, 0] - (node_at[k - 1, 0] if k > 0 else before)) * step
        _forth(rows[k], span, psi)
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
def _forth(row: FloatArray, span: float, psi: FloatArray) -> None:
    """Psi <- F Psi over ``span`` in s, lean and tilt begun anew."""
    for c in range(STATES):
        bias, lean, tilt = psi[BIAS, c], psi[LEAN, c], psi[TILT, c]
        psi[0, c] += span * (psi[1, c] - 0.5 * span * bias)
        psi[0, c] -= row[TWICE] * lean + row[TWICE + 1] * tilt
        psi[1, c] -= span * bias + row[ONCE] * lean + row[ONCE + 1] * tilt
        psi[ROAD, c] = row[STAYS] * psi[ROAD, c] + row[CLIMBS] * psi[SLOPE, c]
        psi[SLOPE, c] *= row[STAYS]
        if row[RENEWED] > 0.0:
            psi[LEAN, c], psi[TILT, c] = 0.0, 0.0


@compiled
def _reduce(update: FloatArray, psi: FloatArray, sums: FloatArray, seen: FloatArray) -> None:
    """Add Psi' H' H Psi / S to ``sums``; Psi <- (I - K H) Psi."""
    for c in range(STATES):
        seen[c] = psi[0, c] - psi[ROAD, c]
    for i in range(STATES):
        scaled, gain = seen[i] * update[INNOVATION + 1], update[i]
        for c in range(STATES):
            sums[i, c] += scaled * seen[c]
            psi[i, c] -= gain * seen[c]
