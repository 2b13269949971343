"""The Bryson-Frazier backward pass over the nodes of a filter, for every smoother.

The adjoint lambda takes the place of the gain L of (6.17): x_s = x - P lambda, without an inverse
of P. What a model has of its own, F and H, are four functions below, chosen by fields of a node or
an update when it is compiled. All are here, since numba sees no change in other files.
"""

import numpy as np

from floatref.estimators.models import kalman_values as kalman
from floatref.estimators.models import road_prior_values as road
from floatref.kernels.compiling import chosen, compiled
from floatref.values.arrays import FloatArray, IndexArray, Records

HEIGHT, VELOCITY = 0, 1


@compiled
def smooth(
    nodes: Records,
    updates: Records,
    before: int,
    step: float,
    adjoint: FloatArray,
    corrections: Records,
) -> None:
    """Go back from the last node to the one at sample ``before``, in place of (6.17).

    That one is not in ``nodes``. ``adjoint``, shape (states,), is lambda behind the last node and
    becomes that behind ``before``. ``corrections`` gets what is to be added to height and velocity
    of each node, on the near and on the far side of its update.
    """
    for k in range(nodes.shape[0] - 1, -1, -1):
        node, out = nodes[k], corrections[k]
        correct(node, adjoint, out)
        out.near_height = out.far_height + node.rise
        out.near_velocity = out.far_velocity + node.climb
        low = nodes[k - 1].updated if k > 0 else 0
        for m in range(node.updated - 1, low - 1, -1):
            _undo(updates[m], adjoint)
        earlier = nodes[k - 1].at if k > 0 else before
        _back(node, (node.at - earlier) * step, adjoint)


@compiled
def correct(node: np.record, adjoint: FloatArray, out: np.record) -> None:
    """Write -P lambda of height and velocity on the far side of the update of ``node``."""
    states, upper = adjoint.size, node.covariance
    rise = 0.0
    for j in range(states):
        rise += upper[j] * adjoint[j]
    # The second row of the upper half begins at its diagonal, behind the first.
    climb = upper[VELOCITY] * adjoint[HEIGHT] + upper[states] * adjoint[VELOCITY]
    for j in range(VELOCITY + 1, states):
        climb += upper[states - 1 + j] * adjoint[j]
    out.far_height, out.far_velocity = -rise, -climb


@compiled
def _undo(update: np.record, adjoint: FloatArray) -> None:
    """Lambda <- (I - K H)' lambda - H' (y - h) / S."""
    total, gain = update.innovation, update.gain
    for j in range(gain.size):
        total += gain[j] * adjoint[j]
    _take(update, total, adjoint)


@compiled
def closed_loop(
    nodes: Records,
    updates: Records,
    before: int,
    step: float,
    wanted: IndexArray,
    passed: FloatArray,
    gathered: FloatArray,
) -> None:
    """Write how an error of the filter passes on between the nodes ``wanted``.

    ``passed[k]``, shape (states, states), gets Psi, the product of (I - K H) F from the node wanted
    before (from the sample ``before``) to number k, ``gathered[k]`` the sum of Psi' H' H Psi / S on
    the way: what the observations there add to the covariance of lambda.
    """
    at, done, seen = 0, 0, np.empty(passed.shape[2])
    _identity(passed[0], gathered[0])
    for k in range(nodes.shape[0]):
        node, psi, sums = nodes[k], passed[at], gathered[at]
        _forth(node, (node.at - (nodes[k - 1].at if k > 0 else before)) * step, psi)
        for m in range(done, node.updated):
            _see(updates[m], psi, seen)
            _reduce(updates[m], seen, psi, sums)
        done = node.updated
        if wanted[at] == k:
            at += 1
            if at == wanted.size:
                return
            _identity(passed[at], gathered[at])


@compiled
def _identity(psi: FloatArray, sums: FloatArray) -> None:
    for i in range(psi.shape[0]):
        for j in range(psi.shape[0]):
            psi[i, j], sums[i, j] = 0.0, 0.0
        psi[i, i] = 1.0


@compiled
def _reduce(update: np.record, seen: FloatArray, psi: FloatArray, sums: FloatArray) -> None:
    """Add Psi' H' H Psi / S to ``sums``, where H Psi is ``seen``; Psi <- (I - K H) Psi."""
    gains = update.gain
    for i in range(gains.size):
        scaled, gain = seen[i] * update.information, gains[i]
        for c in range(gains.size):
            sums[i, c] += scaled * seen[c]
            psi[i, c] -= gain * seen[c]


@compiled
def _back_kalman(node: np.record, span: float, adjoint: FloatArray) -> None:
    if node.renewed == kalman.LEAN:
        adjoint[kalman.LEAN] = node.shift * adjoint[kalman.BIAS]
    elif node.renewed == kalman.OFFSET:
        adjoint[HEIGHT] -= adjoint[kalman.OFFSET]
        adjoint[kalman.OFFSET] = 0.0
    t = node.transition
    # In this order LLVM rounds half of the squared span times by_r, and fuses span times by_v.
    by_v, by_r = adjoint[VELOCITY], adjoint[HEIGHT]
    by_theta, by_phi = adjoint[kalman.PITCH], adjoint[kalman.ROLL]
    adjoint[VELOCITY] += span * by_r
    adjoint[kalman.BIAS] += span * by_v + 0.5 * span * span * by_r
    adjoint[kalman.LEAN] += by_r * t.height_lean + by_v * t.velocity_lean
    adjoint[kalman.PITCH] = (
        by_r * t.height_pitch
        + by_v * t.velocity_pitch
        + by_theta * t.pitch_pitch
        + by_phi * t.roll_pitch
    )
    adjoint[kalman.ROLL] = (
        by_r * t.height_roll
        + by_v * t.velocity_roll
        + by_theta * t.pitch_roll
        + by_phi * t.roll_roll
    )
    adjoint[kalman.ROLL_BIAS] += (
        by_r * t.height_roll_bias
        + by_v * t.velocity_roll_bias
        + by_theta * t.pitch_roll_bias
        + by_phi * t.roll_roll_bias
    )
    adjoint[kalman.PITCH_BIAS] += (
        by_r * t.height_pitch_bias
        + by_v * t.velocity_pitch_bias
        + by_theta * t.pitch_pitch_bias
        + by_phi * t.roll_pitch_bias
    )


@compiled
def _back_road(node: np.record, span: float, adjoint: FloatArray) -> None:
    if node.renewed > 0.0:
        adjoint[road.LEAN], adjoint[road.TILT] = 0.0, 0.0
    by_d, by_v = adjoint[road.CLEARANCE], adjoint[VELOCITY]
    by_r = adjoint[HEIGHT] + by_d
    adjoint[HEIGHT] += (1.0 - node.stays) * by_d
    adjoint[VELOCITY] += span * by_r
    adjoint[road.BIAS] -= span * (by_v + 0.5 * span * by_r)
    adjoint[road.LEAN] -= node.lean_twice * by_r + node.lean_once * by_v
    adjoint[road.TILT] -= node.tilt_twice * by_r + node.tilt_once * by_v
    adjoint[road.SLOPE] = node.stays * adjoint[road.SLOPE] - node.climbs * by_d
    adjoint[road.CLEARANCE] *= node.stays


@compiled
def _forth_kalman(node: np.record, span: float, psi: FloatArray) -> None:
    half, t = 0.5 * span * span, node.transition
    for c in range(kalman.STATES):
        theta, phi, lean = psi[kalman.PITCH, c], psi[kalman.ROLL, c], psi[kalman.LEAN, c]
        roll, pitch = psi[kalman.ROLL_BIAS, c], psi[kalman.PITCH_BIAS, c]
        r, v, bias = psi[HEIGHT, c], psi[VELOCITY, c], psi[kalman.BIAS, c]
        moved = r + span * v + half * bias + t.height_lean * lean
        climb = v + span * bias + t.velocity_lean * lean
        moved += t.height_pitch * theta
        moved += t.height_roll * phi
        moved += t.height_roll_bias * roll
        moved += t.height_pitch_bias * pitch
        climb += t.velocity_pitch * theta
        climb += t.velocity_roll * phi
        climb += t.velocity_roll_bias * roll
        climb += t.velocity_pitch_bias * pitch
        psi[HEIGHT, c], psi[VELOCITY, c] = moved, climb
        # From zero on, so that the first product is rounded and the others are fused.
        tipped, rolled = 0.0, 0.0
        tipped += t.pitch_pitch * theta
        tipped += t.pitch_roll * phi
        tipped += t.pitch_roll_bias * roll
        tipped += t.pitch_pitch_bias * pitch
        rolled += t.roll_pitch * theta
        rolled += t.roll_roll * phi
        rolled += t.roll_roll_bias * roll
        rolled += t.roll_pitch_bias * pitch
        psi[kalman.PITCH, c], psi[kalman.ROLL, c] = tipped, rolled
        if node.renewed == kalman.LEAN:
            psi[kalman.BIAS, c] += node.shift * lean
            psi[kalman.LEAN, c] = 0.0
        elif node.renewed == kalman.OFFSET:
            psi[kalman.OFFSET, c] = -moved


@compiled
def _forth_road(node: np.record, span: float, psi: FloatArray) -> None:
    for c in range(road.STATES):
        bias, lean, tilt = psi[road.BIAS, c], psi[road.LEAN, c], psi[road.TILT, c]
        rise = span * (psi[VELOCITY, c] - 0.5 * span * bias)
        rise -= node.lean_twice * lean + node.tilt_twice * tilt
        sinks = (1.0 - node.stays) * psi[HEIGHT, c] - node.climbs * psi[road.SLOPE, c]
        psi[road.CLEARANCE, c] = node.stays * psi[road.CLEARANCE, c] + rise + sinks
        psi[HEIGHT, c] += rise
        psi[VELOCITY, c] -= span * bias + node.lean_once * lean + node.tilt_once * tilt
        psi[road.SLOPE, c] *= node.stays
        if node.renewed > 0.0:
            psi[road.LEAN, c], psi[road.TILT, c] = 0.0, 0.0


@compiled
def _take_kalman(update: np.record, total: float, adjoint: FloatArray) -> None:
    row = update.row
    for j in range(kalman.STATES):
        adjoint[j] -= row[j] * total


@compiled
def _take_road(update: np.record, total: float, adjoint: FloatArray) -> None:
    adjoint[road.CLEARANCE] -= total


@compiled
def _see_kalman(update: np.record, psi: FloatArray, seen: FloatArray) -> None:
    row = update.row
    for c in range(kalman.STATES):
        seen[c] = 0.0
    for j in range(kalman.STATES):
        for c in range(kalman.STATES):
            seen[c] += row[j] * psi[j, c]


@compiled
def _see_road(update: np.record, psi: FloatArray, seen: FloatArray) -> None:
    for c in range(road.STATES):
        seen[c] = psi[road.CLEARANCE, c]


_back = chosen("transition", _back_kalman, _back_road)
"""Lambda <- F' lambda over a span in s, F with the states that begin anew."""
_forth = chosen("transition", _forth_kalman, _forth_road)
"""Psi <- F Psi over a span in s, F with the states that begin anew."""
_take = chosen("row", _take_kalman, _take_road)
"""Lambda <- lambda - H' times a number."""
_see = chosen("row", _see_kalman, _see_road)
"""Write H Psi."""
