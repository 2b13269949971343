"""The multi-rate extended Kalman filter of chapter 6: x at every sample, P at every node.

At every sample the state is predicted by (6.9). P is predicted by (6.10) from node to node only:
between two nodes the linearized transitions A (C.3) of the samples are composed into one, whose
height and velocity rows depend on the attitude and on the gyros' biases alone, while those of the
biases are trivial. A node closes a sub-block, or is a sample with observations; these update x
and P by (6.13), one scalar after the other.

The file is longer than others on purpose. numba keeps a compiled function until the file of that
function changes, and sees no change in the files of those that it calls: in several files the
loops below could run with stale parts of each other.
"""

from math import asin, cos, sin, sqrt
from typing import NamedTuple

import numpy as np

from floatref.estimators.models.kalman_values import (
    BELIEVED_AT,
    BIAS,
    CAPTURE,
    DRIFT,
    FORGET,
    GATE,
    HEIGHT,
    KINDS,
    LEAN,
    OFFSET,
    PITCH,
    PITCH_BIAS,
    REFLECTED,
    RELATIVE,
    RENEW,
    ROLL,
    ROLL_BIAS,
    RUNNING_S,
    STATES,
    TRUSTED,
    VELOCITY,
    Filter,
    Inputs,
    Model,
    Observations,
    Output,
)
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, Records


class Work(NamedTuple):
    """Room for what an update computes.

    Attributes:
        h: H of (C.8), shape (KINDS, STATES).
        predicted: h(x) of (6.48), shape (KINDS,).
        prior: x before all observations of the sample, shape (STATES,).
        projected: P H' of a scalar, shape (STATES,).
        gain: K of a scalar, shape (STATES,).
        rest: (I - K H) P H' of a scalar, shape (STATES,).
        carried: A P of the first four rows, shape (4, STATES).
    """

    h: FloatArray
    predicted: FloatArray
    prior: FloatArray
    projected: FloatArray
    gain: FloatArray
    rest: FloatArray
    carried: FloatArray


@compiled
def run(
    model: Model, inputs: Inputs, observations: Observations, state: Filter, out: Output
) -> int:
    """Filter the samples of ``inputs``, change ``state``, write ``out``; return how many nodes."""
    first, size, observed, count = inputs.first, out.height.size, 0, 0
    # A literal 0 has all that is called with it compiled once more.
    begin = done = int(np.int64(0))
    work = _room()
    x, memory = state.x, state.memory
    while begin < size:
        at = begin + (-(first + begin)) % model.sub_block
        if observed < observations.at.size:
            at = min(at, observations.at[observed] - first)
        _advance(model, inputs, begin, min(at + 1, size), state, out.height)
        begin = at + 1
        if at >= size:
            break
        node = out.nodes[count]
        before, speed = x[HEIGHT], x[VELOCITY]
        _keep_transition(model, memory, node)
        _predict(model, state, work.carried)
        if observed < observations.at.size and observations.at[observed] == first + at:
            mark = observations.marks[observed]
            if mark & FORGET and not mark & RENEW:
                node.shift = _forget(model.lean, state)
            rates = inputs.roll_rate[at], inputs.pitch_rate[at], inputs.yaw_rate[at]
            done = _observe(model, rates, observations, observed, state, work, out.updates, done)
            node.renewed = _other(mark)
            out.height[at] = x[HEIGHT]
            observed += 1
        node.at, node.updated = first + at, done
        node.rise, node.climb = x[HEIGHT] - before, x[VELOCITY] - speed
        _keep_covariance(state.p, node)
        count += 1
        _begin_sub_block(x, memory)
    return count


@compiled
def end(model: Model, state: Filter, nodes: Records) -> int:
    """Make a node of the sample advanced to last, unless it is one; returns how many it made."""
    if state.memory.steps == 0.0:
        return 0
    node = nodes[0]
    _keep_transition(model, state.memory, node)
    _predict(model, state, np.zeros((4, STATES)))
    node.at, node.updated, node.rise, node.climb = state.memory.latest, 0, 0.0, 0.0
    _keep_covariance(state.p, node)
    return 1


@compiled
def expect(model: Model, state: Filter, h: FloatArray, predicted: FloatArray) -> None:
    """Write h(x) of (6.48) at the sample advanced to last, and (C.8) into ``h``.

    The height is relative to the one captured, (6.65).
    """
    memory = state.memory
    rates = memory.roll_rate, memory.pitch_rate, memory.yaw_rate
    _linearize(model, state.x, rates, h, predicted)
    predicted[HEIGHT] -= memory.captured


@compiled
def _room() -> Work:
    return Work(
        np.zeros((KINDS, STATES)),
        np.zeros(KINDS),
        np.zeros(STATES),
        np.zeros(STATES),
        np.zeros(STATES),
        np.zeros(STATES),
        np.zeros((4, STATES)),
    )


@compiled
def _advance(
    model: Model, u: Inputs, begin: int, end: int, state: Filter, height: FloatArray
) -> None:
    """Predict x by (6.47), the mean of both ends the input of a step, and compose A of (C.3).

    So velocity and height are the trapezoidal integrals of the acceleration. All that changes is
    in local variables, which the processor has in registers: this loop is most of the work.
    """
    x, memory, t = state.x, state.memory, state.memory.transition
    if begin < end and u.first + begin == 0:
        _keep_inputs(u, 0, memory)
        _begin_sub_block(x, memory)
        height[0] = x[HEIGHT]
        begin = 1
    step, gravity = model.step, model.gravity
    half = 0.5 * step * step
    r, v, theta, phi = x[HEIGHT], x[VELOCITY], x[PITCH], x[ROLL]
    bias, bias_1, bias_2, lean = x[BIAS], x[ROLL_BIAS], x[PITCH_BIAS], x[LEAN]
    # r_3 is A[1,3] of (C.3): the height by the pitch; a and b are the rows of pitch and roll.
    r3, r4, r6, r7 = t.height_pitch, t.height_roll, t.height_roll_bias, t.height_pitch_bias
    v3, v4, v6, v7 = t.velocity_pitch, t.velocity_roll, t.velocity_roll_bias, t.velocity_pitch_bias
    a3, a4, a6, a7 = t.pitch_pitch, t.pitch_roll, t.pitch_roll_bias, t.pitch_pitch_bias
    b3, b4, b6, b7 = t.roll_pitch, t.roll_roll, t.roll_roll_bias, t.roll_pitch_bias
    r8, v8, level = t.height_lean, t.velocity_lean, memory.level
    ux, uy, uz = memory.x, memory.y, memory.z
    w1, w2, w3 = memory.roll_rate, memory.pitch_rate, memory.yaw_rate
    st, ct, sp, cp = memory.sin_pitch, memory.cos_pitch, memory.sin_roll, memory.cos_roll
    sum_3, sum_4 = memory.by_pitch, memory.by_roll
    fx, fy, fz, wx, wy, wz = u.x, u.y, u.z, u.roll_rate, u.pitch_rate, u.yaw_rate
    for i in range(begin, end):
        ax, ay, az = 0.5 * (ux + fx[i]), 0.5 * (uy + fy[i]), 0.5 * (uz + fz[i]) + gravity
        q1, q2, q3 = 0.5 * (w1 + wx[i]) + bias_1, 0.5 * (w2 + wy[i]) + bias_2, 0.5 * (w3 + wz[i])
        ux, uy, uz, w1, w2, w3 = fx[i], fy[i], fz[i], wx[i], wy[i], wz[i]
        across, along, inverse = sp * ay + cp * az, sp * q2 + cp * q3, 1.0 / ct
        tangent = st * inverse
        # The acceleration by pitch and roll, (C.4) without the powers of the step.
        by_3, by_4 = -ct * ax - st * across, ct * (cp * ay - sp * az)
        # (6.27), (6.28) and (6.37), the latter with what an axis that leans forward feels.
        turn_3 = (cp * q2 - sp * q3) * step
        turn_4 = (q1 + tangent * along) * step
        surge = ax - level
        rise = ct * across - st * ax + lean * surge + bias - gravity
        a34, a43, a44 = -step * along, along * step * inverse * inverse, 1.0 + turn_3 * tangent
        e3, e4 = by_3 * a3 + by_4 * b3, by_3 * a4 + by_4 * b4
        e6, e7 = by_3 * a6 + by_4 * b6, by_3 * a7 + by_4 * b7
        r3, r4 = r3 + step * v3 + half * e3, r4 + step * v4 + half * e4
        r6, r7 = r6 + step * v6 + half * e6, r7 + step * v7 + half * e7
        v3, v4, v6, v7 = v3 + step * e3, v4 + step * e4, v6 + step * e6, v7 + step * e7
        a3, b3 = a3 + a34 * b3, a44 * b3 + a43 * a3
        a4, b4 = a4 + a34 * b4, a44 * b4 + a43 * a4
        a6, b6 = a6 + a34 * b6, a44 * b6 + a43 * a6 + step
        a7, b7 = a7 + a34 * b7 + cp * step, a44 * b7 + a43 * a7 + sp * tangent * step
        r8, v8 = r8 + step * v8 + half * surge, v8 + step * surge
        sum_3, sum_4 = sum_3 + by_3, sum_4 + by_4
        r, v = r + (step * v + half * rise), v + step * rise
        theta, phi = theta + turn_3, phi + turn_4
        # Sine and cosine are rotated by the steps of the angles: a series of third order is exact
        # to rounding for so small ones, and far cheaper. They are computed anew at every node.
        even, odd = 0.5 * turn_3 * turn_3, turn_3 - turn_3 * turn_3 * turn_3 * (1.0 / 6.0)
        st, ct = st + (ct * odd - st * even), ct - (st * odd + ct * even)
        even, odd = 0.5 * turn_4 * turn_4, turn_4 - turn_4 * turn_4 * turn_4 * (1.0 / 6.0)
        sp, cp = sp + (cp * odd - sp * even), cp - (sp * odd + cp * even)
        height[i] = r
    x[HEIGHT], x[VELOCITY], x[PITCH], x[ROLL] = r, v, theta, phi
    t.height_pitch, t.height_roll, t.height_roll_bias, t.height_pitch_bias = r3, r4, r6, r7
    t.velocity_pitch, t.velocity_roll, t.velocity_roll_bias, t.velocity_pitch_bias = v3, v4, v6, v7
    t.pitch_pitch, t.pitch_roll, t.pitch_roll_bias, t.pitch_pitch_bias = a3, a4, a6, a7
    t.roll_pitch, t.roll_roll, t.roll_roll_bias, t.roll_pitch_bias = b3, b4, b6, b7
    t.height_lean, t.velocity_lean = r8, v8
    memory.sin_pitch, memory.cos_pitch, memory.sin_roll, memory.cos_roll = st, ct, sp, cp
    memory.by_pitch, memory.by_roll = sum_3, sum_4
    memory.steps += max(end - begin, 0)
    memory.latest = u.first + end - 1
    if begin < end:
        _keep_inputs(u, end - 1, memory)


@compiled
def _keep_inputs(u: Inputs, i: int, memory: np.record) -> None:
    memory.x, memory.y, memory.z = u.x[i], u.y[i], u.z[i]
    memory.roll_rate, memory.pitch_rate = u.roll_rate[i], u.pitch_rate[i]
    memory.yaw_rate = u.yaw_rate[i]


@compiled
def _begin_sub_block(x: FloatArray, memory: np.record) -> None:
    """Set the transition to I and the sums to 0."""
    t = memory.transition
    t.height_pitch, t.height_roll, t.height_roll_bias, t.height_pitch_bias = 0.0, 0.0, 0.0, 0.0
    t.velocity_pitch, t.velocity_roll = 0.0, 0.0
    t.velocity_roll_bias, t.velocity_pitch_bias = 0.0, 0.0
    t.pitch_pitch, t.pitch_roll, t.pitch_roll_bias, t.pitch_pitch_bias = 1.0, 0.0, 0.0, 0.0
    t.roll_pitch, t.roll_roll, t.roll_roll_bias, t.roll_pitch_bias = 0.0, 1.0, 0.0, 0.0
    t.height_lean, t.velocity_lean = 0.0, 0.0
    memory.sin_pitch, memory.cos_pitch = sin(x[PITCH]), cos(x[PITCH])
    memory.sin_roll, memory.cos_roll = sin(x[ROLL]), cos(x[ROLL])
    memory.steps, memory.by_pitch, memory.by_roll = 0.0, 0.0, 0.0


@compiled
def _keep_transition(model: Model, memory: np.record, node: np.record) -> None:
    """Copy the transition to ``node``, and follow the longitudinal specific force."""
    node.transition = memory.transition
    node.renewed, node.shift = 0, 0.0
    span = memory.steps * model.step
    if span > 0.0:
        mean = memory.transition.velocity_lean / span + memory.level
        memory.running += (mean - memory.running) * min(1.0, span / RUNNING_S)


@compiled
def _keep_covariance(p: FloatArray, node: np.record) -> None:
    upper, k = node.covariance, 0
    for i in range(STATES):
        for j in range(i, STATES):
            upper[k] = p[i, j]
            k += 1


@compiled
def _predict(model: Model, state: Filter, carried: FloatArray) -> None:
    """P <- A P A' + W Q W' over the steps since the last node, (6.10)."""
    p, memory = state.p, state.memory
    if memory.steps == 0.0:
        return
    t, span = memory.transition, memory.steps * model.step
    # Column by column A P, then row by row (A P) A'; the states from the biases on do not move.
    for j in range(STATES):
        carried[0, j], carried[1, j], carried[2, j], carried[3, j] = _carry(t, span, p[j])
    for i in range(4):
        p[i, 0], p[i, 1], p[i, 2], p[i, 3] = _carry(t, span, carried[i])
        for j in range(4, STATES):
            p[i, j] = carried[i, j]
    _add_noise(model, state)
    for i in range(STATES):
        for j in range(i):
            p[i, j] = p[j, i]


@compiled
def _carry(t: np.record, span: float, c: FloatArray) -> tuple[float, float, float, float]:
    """Return height, velocity, pitch and roll of A c; the other states stay as they are."""
    c3, c4, c6, c7, c8 = c[PITCH], c[ROLL], c[ROLL_BIAS], c[PITCH_BIAS], c[LEAN]
    rise = t.height_pitch * c3 + t.height_roll * c4 + t.height_roll_bias * c6
    rise = rise + t.height_pitch_bias * c7 + t.height_lean * c8
    climb = t.velocity_pitch * c3 + t.velocity_roll * c4 + t.velocity_roll_bias * c6
    climb = climb + t.velocity_pitch_bias * c7 + t.velocity_lean * c8
    return (
        c[HEIGHT] + span * (c[VELOCITY] + 0.5 * span * c[BIAS]) + rise,
        c[VELOCITY] + span * c[BIAS] + climb,
        t.pitch_pitch * c3 + t.pitch_roll * c4 + t.pitch_roll_bias * c6 + t.pitch_pitch_bias * c7,
        t.roll_pitch * c3 + t.roll_roll * c4 + t.roll_roll_bias * c6 + t.roll_pitch_bias * c7,
    )


@compiled
def _add_noise(model: Model, state: Filter) -> None:
    """Add W Q W' of all steps since the node, (C.5) and (C.6), to the upper half of P.

    A disturbance of a state with m steps to go moves velocity by m, and height by m squared over
    two, times its acceleration; the sums over m are exact for a constant sensitivity.
    """
    p, x, memory = state.p, state.x, state.memory
    step, n = model.step, memory.steps
    # Sums of m and m squared over the steps, and what (sum of m) squared and m^4 come to.
    s1, s2 = n * (n - 1.0) / 2.0 * step, (n - 1.0) * n * (2.0 * n - 1.0) / 6.0 * step * step
    s3 = s1 * s1 * step
    s4 = s2 * (3.0 * n * n - 3.0 * n - 1.0) / 5.0 * step * step
    by_3, by_4 = memory.by_pitch / n, memory.by_roll / n
    st, ct, sp, cp = sin(x[PITCH]), cos(x[PITCH]), sin(x[ROLL]), cos(x[ROLL])
    tangent = st / ct
    white, walk = model.white * step, model.walk * step
    q1, q2, q3 = model.white_roll * step, model.white_pitch * step, model.white_yaw * step
    # White noise of the three rates turns pitch and roll by the rows of (C.6).
    c33 = cp * cp * q2 + sp * sp * q3
    c34 = sp * cp * tangent * (q2 - q3)
    c44 = q1 + tangent * tangent * (sp * sp * q2 + cp * cp * q3)
    to_3, to_4 = by_3 * c33 + by_4 * c34, by_3 * c34 + by_4 * c44
    both = by_3 * to_3 + by_4 * to_4 + walk
    walk_1, walk_2 = model.walk_roll * step, model.walk_pitch * step
    # What the walk of the pitch rate's bias is in pitch and roll.
    to_pitch, to_roll = cp, sp * tangent
    p[HEIGHT, HEIGHT] += white * step * step * (n * n * n / 3.0 - n / 12.0) + both * s4 / 4.0
    p[HEIGHT, VELOCITY] += white * n * n * step / 2.0 + both * s3 / 2.0
    p[VELOCITY, VELOCITY] += white * n + both * s2
    p[HEIGHT, PITCH] += to_3 * s2 / 2.0
    p[HEIGHT, ROLL] += to_4 * s2 / 2.0
    p[VELOCITY, PITCH] += to_3 * s1
    p[VELOCITY, ROLL] += to_4 * s1
    p[PITCH, PITCH] += c33 * n + walk_2 * s2 * to_pitch * to_pitch
    p[PITCH, ROLL] += c34 * n + walk_2 * s2 * to_pitch * to_roll
    p[ROLL, ROLL] += c44 * n + walk_2 * s2 * to_roll * to_roll + walk_1 * s2
    p[HEIGHT, BIAS] += walk * s2 / 2.0
    p[VELOCITY, BIAS] += walk * s1
    p[BIAS, BIAS] += walk * n
    p[VELOCITY, ROLL_BIAS] += walk_1 * by_4 * s2 / 2.0
    p[ROLL, ROLL_BIAS] += walk_1 * s1
    p[ROLL_BIAS, ROLL_BIAS] += walk_1 * n
    p[VELOCITY, PITCH_BIAS] += walk_2 * (by_3 * to_pitch + by_4 * to_roll) * s2 / 2.0
    p[PITCH, PITCH_BIAS] += walk_2 * s1 * to_pitch
    p[ROLL, PITCH_BIAS] += walk_2 * s1 * to_roll
    p[PITCH_BIAS, PITCH_BIAS] += walk_2 * n


@compiled
def _observe(
    model: Model,
    rates: tuple[float, float, float],
    observations: Observations,
    k: int,
    state: Filter,
    work: Work,
    updates: Records,
    done: int,
) -> int:
    """Update by observation ``k``, its readings one after the other, linearized once, (6.13).

    The innovation of a later one counts what the ones before have changed, so that the order is
    of no matter. Returns the end of the updates.
    """
    mark, y, variances = observations.marks[k], observations.values[k], observations.variances[k]
    x, h, predicted, prior = state.x, work.h, work.predicted, work.prior
    _linearize(model, x, rates, h, predicted)
    base = _base(mark, state, h, predicted)
    state.p[DRIFT, DRIFT] += observations.drifted[k]
    for j in range(STATES):
        prior[j] = x[j]
    for kind in range(KINDS):
        if y[kind] != y[kind]:
            continue
        innovation = y[kind] - predicted[kind]
        innovation += base if kind == HEIGHT else 0.0
        for j in range(STATES):
            innovation -= h[kind, j] * (x[j] - prior[j])
        if mark & TRUSTED or _is_plausible(model, state, kind, innovation, variances[kind], work):
            _update(state, h[kind], innovation, variances[kind], work, updates[done])
            done += 1
    return done


@compiled
def _base(mark: int, state: Filter, h: FloatArray, predicted: FloatArray) -> float:
    """Return what the observed height is relative to; adapt its prediction and its row of H."""
    x, memory = state.x, state.memory
    if mark & CAPTURE:
        memory.captured = predicted[HEIGHT]
    if mark & RENEW:
        memory.origin = x[HEIGHT]
        _clone(x, state.p)
    if mark & REFLECTED:
        predicted[HEIGHT] = x[HEIGHT] + x[OFFSET]
        h[HEIGHT, PITCH], h[HEIGHT, ROLL], h[HEIGHT, OFFSET] = 0.0, 0.0, 1.0
        return float(memory.origin)
    if mark & RELATIVE:
        return float(memory.captured)
    predicted[HEIGHT] += x[DRIFT]
    h[HEIGHT, DRIFT] = 1.0
    return 0.0


@compiled
def _is_plausible(
    model: Model, state: Filter, kind: int, innovation: float, variance: float, work: Work
) -> bool:
    """Return whether a reading may be right; heights that insist are another datum."""
    memory = state.memory
    spread = _project(state.p, work.h[kind], work.projected) + variance
    far = innovation * innovation > GATE * spread
    if not far or abs(innovation) <= model.floors[kind]:
        memory.in_a_row = 0.0 if kind == HEIGHT else memory.in_a_row
        return True
    if kind == HEIGHT:
        another = memory.in_a_row + 1.0 >= BELIEVED_AT
        memory.in_a_row = 0.0 if another else memory.in_a_row + 1.0
        if another:
            state.p[DRIFT, DRIFT] += model.datum
            return True
    if memory.rejected[kind] == 0:
        memory.rejected_at[kind] = memory.latest
    memory.rejected[kind] += 1
    return False


@compiled
def _other(mark: int) -> int:
    """Return the state that an observation of ``mark`` begins anew; 0 for any other mark."""
    if mark & RENEW:
        return OFFSET
    return LEAN if mark & FORGET else 0


@compiled
def _forget(variance: float, state: Filter) -> float:
    """Begin the lean anew, relative to the present specific force; return how far that moved.

    What the lean made of this force so far becomes part of the acceleration's bias.
    """
    x, p, memory = state.x, state.p, state.memory
    shift = memory.running - memory.level
    memory.level = memory.running
    x[BIAS] += shift * x[LEAN]
    for j in range(STATES):
        p[BIAS, j] += shift * p[LEAN, j]
    for j in range(STATES):
        p[j, BIAS] += shift * p[j, LEAN]
    x[LEAN] = 0.0
    for j in range(STATES):
        p[LEAN, j], p[j, LEAN] = 0.0, 0.0
    p[LEAN, LEAN] = variance
    return float(shift)


@compiled
def _clone(x: FloatArray, p: FloatArray) -> None:
    """Let the offset be what the height is off by where a stop begins."""
    x[OFFSET] = 0.0
    for j in range(STATES):
        p[OFFSET, j] = -p[HEIGHT, j]
    for j in range(STATES):
        p[j, OFFSET] = -p[j, HEIGHT]


@compiled
def _project(p: FloatArray, h: FloatArray, projected: FloatArray) -> float:
    """Write P H' into ``projected`` and return H P H'."""
    spread = 0.0
    for i in range(STATES):
        total = 0.0
        for j in range(STATES):
            total += p[i, j] * h[j]
        projected[i] = total
        spread += h[i] * total
    return spread


@compiled
def _update(
    state: Filter,
    h: FloatArray,
    innovation: float,
    variance: float,
    work: Work,
    update: np.record,
) -> None:
    """X <- x + K (y - h), K = P H' / S, and P <- (I - K H) P (I - K H)' + K R K', (6.13).

    P is updated in the form of Joseph: unlike (I - K H) P it stays positive and symmetric when K
    is rounded.
    """
    p, x, projected, gain, rest = state.p, state.x, work.projected, work.gain, work.rest
    total = _project(p, h, projected) + variance
    for i in range(STATES):
        k = projected[i] / total
        x[i] += k * innovation
        left = 0.0
        for j in range(STATES):
            left += (p[i, j] - k * projected[j]) * h[j]
        gain[i], rest[i] = k, left
    for i in range(STATES):
        for j in range(i, STATES):
            p[i, j] += gain[i] * variance * gain[j] - gain[i] * projected[j] - rest[i] * gain[j]
            p[j, i] = p[i, j]
    row, kept = update.row, update.gain
    for i in range(STATES):
        row[i], kept[i] = h[i], gain[i]
    update.innovation, update.information = innovation / total, 1.0 / total


@compiled
def _linearize(
    model: Model,
    x: FloatArray,
    rates: tuple[float, float, float],
    h: FloatArray,
    predicted: FloatArray,
) -> None:
    """Write h(x) of (6.48) and H of (C.8), with the lever arm's forward part."""
    lx, ly, lz = model.arm_x, model.arm_y, model.arm_z
    st, ct, sp, cp = sin(x[PITCH]), cos(x[PITCH]), sin(x[ROLL]), cos(x[ROLL])
    q1, q2, q3 = rates[0] + x[ROLL_BIAS], rates[1] + x[PITCH_BIAS], rates[2]
    up, side = sp * ly + cp * lz, cp * ly - sp * lz
    whirl_x, whirl_y, whirl_z = q2 * lz - q3 * ly, q3 * lx - q1 * lz, q1 * ly - q2 * lx
    inclined = ct * sp
    root = sqrt(1.0 - inclined * inclined)
    predicted[HEIGHT] = x[HEIGHT] - st * lx + ct * up
    predicted[VELOCITY] = x[VELOCITY] - st * whirl_x + ct * (sp * whirl_y + cp * whirl_z)
    predicted[PITCH] = x[PITCH]
    predicted[ROLL] = asin(inclined)
    for i in range(KINDS):
        for j in range(STATES):
            h[i, j] = 0.0
    h[HEIGHT, HEIGHT], h[HEIGHT, PITCH], h[HEIGHT, ROLL] = 1.0, -ct * lx - st * up, ct * side
    h[VELOCITY, VELOCITY] = 1.0
    h[VELOCITY, PITCH] = -ct * whirl_x - st * (sp * whirl_y + cp * whirl_z)
    h[VELOCITY, ROLL] = ct * (cp * whirl_y - sp * whirl_z)
    h[VELOCITY, ROLL_BIAS], h[VELOCITY, PITCH_BIAS] = ct * side, -st * lz - ct * cp * lx
    h[PITCH, PITCH] = 1.0
    h[ROLL, PITCH], h[ROLL, ROLL] = -st * sp / root, ct * cp / root
