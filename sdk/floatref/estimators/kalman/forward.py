"""The multi-rate extended Kalman filter: states at every sample, covariance at every node.

Between two nodes the linearized transitions A (C.3) of the samples are composed into one; its
height and velocity rows depend on the attitude and on the gyros' bias alone, those of the biases
are trivial. A node closes a sub-block, or is a sample with observations.
"""

from math import asin, cos, sin, sqrt

import numpy as np

from floatref.estimators.kalman.layout import (
    BELIEVED_AT,
    BIAS,
    CAPTURE,
    CAPTURED,
    DRIFT,
    FORGET,
    GATE,
    IN_A_ROW,
    INNOVATION,
    INPUTS,
    JUMP,
    KINDS,
    LATEST,
    LEAN,
    LEVEL,
    OFFSET,
    ORIGIN,
    REFLECTED,
    REJECTED,
    REJECTED_AT,
    RELATIVE,
    RENEW,
    RENEWED,
    RUNNING,
    RUNNING_S,
    SHIFT,
    SPREAD,
    STATES,
    STEPS,
    TRANSITION,
    TRUSTED,
    Inputs,
)
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray


@compiled
def run(
    u: Inputs,
    first: int,
    sub_block: int,
    model: FloatArray,
    at: IndexArray,
    marks: IndexArray,
    y: FloatArray,
    x: FloatArray,
    p: FloatArray,
    memory: FloatArray,
    height: FloatArray,
    node_at: IndexArray,
    nodes: FloatArray,
    updates: FloatArray,
) -> int:
    """Advance by the samples of the six inputs ``u`` and return the number of nodes.

    Sample number ``first`` is absolute. ``model`` holds the step in s, g in m/s², the lever arm
    (3) in m, squares of the process densities (7), the variance of a new datum in m², up to where
    innovations are believed (4), and the variance of a lean in rad². Observations at samples
    ``at``: four values in ``y``, NaN if there is none, four variances, and the variance that the
    drift of the GNSS height gains, shape (m, 9). ``x``, ``p`` and ``memory`` are changed;
    ``height`` gets the filtered height, and ``node_at`` (k, 2), ``nodes`` and ``updates`` what
    the backward pass needs; a node's second number is the end of its updates.
    """
    size, observed, count = height.size, 0, 0
    # A literal 0 has all that is called with it compiled once more.
    begin = done = int(np.int64(0))
    work, h = np.zeros((STATES, STATES)), np.zeros((KINDS, STATES))
    while begin < size:
        node = begin + (-(first + begin)) % sub_block
        if observed < at.size:
            node = min(node, at[observed] - first)
        _advance(u, begin, min(node + 1, size), first, model, x, memory, height)
        begin = node + 1
        if node >= size:
            break
        before, speed = x[0], x[1]
        _keep_transition(memory, model[0], nodes[count])
        _predict(p, work, memory, model, x)
        if observed < at.size and at[observed] == first + node:
            mark, seen = marks[observed], y[observed]
            if mark & FORGET and not mark & RENEW:
                nodes[count, SHIFT] = _forget(model[17], x, p, memory)
            done = _observe(u, node, model, mark, seen, x, p, memory, h, work, updates, done)
            nodes[count, RENEWED] = _other(mark)
            height[node] = x[0]
            observed += 1
        _close_node(
            first + node, done, x[0] - before, x[1] - speed, p, nodes[count], node_at[count]
        )
        count += 1
        _begin_sub_block(x, memory)
    return count


@compiled
def end(
    model: FloatArray,
    x: FloatArray,
    p: FloatArray,
    memory: FloatArray,
    node_at: IndexArray,
    nodes: FloatArray,
) -> int:
    """Make a node of the sample advanced to last, unless it is one; returns how many it made."""
    if memory[STEPS] == 0.0:
        return 0
    work = np.zeros((4, STATES))
    _keep_transition(memory, model[0], nodes[0])
    _predict(p, work, memory, model, x)
    nothing = int(np.int64(0))
    _close_node(int(memory[LATEST]), nothing, 0.0, 0.0, p, nodes[0], node_at[0])
    return 1


@compiled
def expect(
    model: FloatArray, x: FloatArray, memory: FloatArray, h: FloatArray, y: FloatArray
) -> None:
    """Write what (6.48) expects at the sample advanced to last into ``y``, (C.8) into ``h``.

    Heights are told from the one captured, (6.65).
    """
    rates = memory[INPUTS + 3 : INPUTS + 6]
    _linearize(x, rates[0], rates[1], rates[2], model, h, y)
    y[0] -= memory[CAPTURED]


@compiled
def _close_node(
    at: int,
    done: int,
    rise: float,
    climb: float,
    p: FloatArray,
    node: FloatArray,
    place: IndexArray,
) -> None:
    node[JUMP], node[JUMP + 1] = rise, climb
    k = SPREAD
    for i in range(STATES):
        for j in range(i, STATES):
            node[k] = p[i, j]
            k += 1
    place[0], place[1] = at, done


@compiled
def _advance(
    u: Inputs,
    begin: int,
    end: int,
    first: int,
    model: FloatArray,
    x: FloatArray,
    memory: FloatArray,
    height: FloatArray,
) -> None:
    """(6.47) with the mean of both ends as the input of a step, and (C.3) composed.

    So velocity and height are the trapezoidal integrals of the acceleration. Sine and cosine are
    rotated by the steps of the angles, and computed anew at every node.
    """
    fx, fy, fz, wx, wy, wz = u
    if begin < end and first + begin == 0:
        for j in range(6):
            memory[INPUTS + j] = u[j][0]
        _begin_sub_block(x, memory)
        height[0] = x[0]
        begin = 1
    step, gravity = model[0], model[1]
    half = 0.5 * step * step
    r, v, theta, phi, bias, bias_1, bias_2 = x[0], x[1], x[2], x[3], x[4], x[5], x[6]
    r3, r4, r6, r7 = memory[0], memory[1], memory[2], memory[3]
    v3, v4, v6, v7 = memory[4], memory[5], memory[6], memory[7]
    a3, a4, a6, a7 = memory[8], memory[9], memory[10], memory[11]
    b3, b4, b6, b7 = memory[12], memory[13], memory[14], memory[15]
    ux, uy, uz, w1, w2, w3 = memory[18], memory[19], memory[20], memory[21], memory[22], memory[23]
    st, ct, sp, cp = memory[24], memory[25], memory[26], memory[27]
    sum_3, sum_4, lean, level = memory[29], memory[30], x[LEAN], memory[LEVEL]
    r8, v8 = memory[16], memory[17]
    for i in range(begin, end):
        ax, ay, az = 0.5 * (ux + fx[i]), 0.5 * (uy + fy[i]), 0.5 * (uz + fz[i]) + gravity
        q1, q2, q3 = 0.5 * (w1 + wx[i]) + bias_1, 0.5 * (w2 + wy[i]) + bias_2, 0.5 * (w3 + wz[i])
        ux, uy, uz, w1, w2, w3 = fx[i], fy[i], fz[i], wx[i], wy[i], wz[i]
        across, along, inverse = sp * ay + cp * az, sp * q2 + cp * q3, 1.0 / ct
        tangent = st * inverse
        by_3, by_4 = -ct * ax - st * across, ct * (cp * ay - sp * az)
        turn_3 = (cp * q2 - sp * q3) * step
        turn_4 = (q1 + tangent * along) * step
        surge = ax - level
        rise = ct * across - st * ax + lean * surge + bias - gravity
        a34, a43, a44 = -step * along, along * step * inverse * inverse, 1.0 + turn_3 * tangent
        e3, e4, e6, e7 = (
            by_3 * a3 + by_4 * b3,
            by_3 * a4 + by_4 * b4,
            by_3 * a6 + by_4 * b6,
            by_3 * a7 + by_4 * b7,
        )
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
        even, odd = 0.5 * turn_3 * turn_3, turn_3 - turn_3 * turn_3 * turn_3 * (1.0 / 6.0)
        st, ct = st + (ct * odd - st * even), ct - (st * odd + ct * even)
        even, odd = 0.5 * turn_4 * turn_4, turn_4 - turn_4 * turn_4 * turn_4 * (1.0 / 6.0)
        sp, cp = sp + (cp * odd - sp * even), cp - (sp * odd + cp * even)
        height[i] = r
    x[0], x[1], x[2], x[3] = r, v, theta, phi
    memory[0], memory[1], memory[2], memory[3] = r3, r4, r6, r7
    memory[4], memory[5], memory[6], memory[7] = v3, v4, v6, v7
    memory[8], memory[9], memory[10], memory[11] = a3, a4, a6, a7
    memory[12], memory[13], memory[14], memory[15] = b3, b4, b6, b7
    memory[16], memory[17] = r8, v8
    memory[18], memory[19], memory[20] = ux, uy, uz
    memory[21], memory[22], memory[23] = w1, w2, w3
    memory[24], memory[25], memory[26], memory[27] = st, ct, sp, cp
    memory[STEPS] += max(end - begin, 0)
    memory[LATEST] = first + end - 1
    memory[29], memory[30] = sum_3, sum_4


@compiled
def _begin_sub_block(x: FloatArray, memory: FloatArray) -> None:
    for j in range(TRANSITION):
        memory[j] = 0.0
    memory[8], memory[13] = 1.0, 1.0
    memory[24], memory[25], memory[26], memory[27] = sin(x[2]), cos(x[2]), sin(x[3]), cos(x[3])
    memory[STEPS], memory[29], memory[30] = 0.0, 0.0, 0.0


@compiled
def _keep_transition(memory: FloatArray, step: float, node: FloatArray) -> None:
    """Copy the transition to ``node``, and follow the longitudinal specific force."""
    for j in range(TRANSITION):
        node[j] = memory[j]
    node[RENEWED], node[SHIFT] = 0.0, 0.0
    span = memory[STEPS] * step
    if span > 0.0:
        mean = memory[17] / span + memory[LEVEL]
        memory[RUNNING] += (mean - memory[RUNNING]) * min(1.0, span / RUNNING_S)


@compiled
def _predict(
    p: FloatArray, work: FloatArray, memory: FloatArray, model: FloatArray, x: FloatArray
) -> None:
    """P <- F P F' + Q over the steps since the last node, (6.10)."""
    steps = memory[STEPS]
    if steps == 0.0:
        return
    span = steps * model[0]
    for j in range(STATES):
        work[0, j], work[1, j], work[2, j], work[3, j] = _carried(memory, span, p[j])
    for i in range(4):
        p[i, 0], p[i, 1], p[i, 2], p[i, 3] = _carried(memory, span, work[i])
        for j in range(4, STATES):
            p[i, j] = work[i, j]
    _add_noise(p, memory, model, x, steps)
    for i in range(STATES):
        for j in range(i):
            p[i, j] = p[j, i]


@compiled
def _carried(f: FloatArray, span: float, a: FloatArray) -> tuple[float, float, float, float]:
    """Return height, velocity, pitch and roll of F a; the other states stay as they are."""
    rise = f[0] * a[2] + f[1] * a[3] + f[2] * a[5] + f[3] * a[6] + f[16] * a[LEAN]
    climb = f[4] * a[2] + f[5] * a[3] + f[6] * a[5] + f[7] * a[6] + f[17] * a[LEAN]
    return (
        a[0] + span * (a[1] + 0.5 * span * a[4]) + rise,
        a[1] + span * a[4] + climb,
        f[8] * a[2] + f[9] * a[3] + f[10] * a[5] + f[11] * a[6],
        f[12] * a[2] + f[13] * a[3] + f[14] * a[5] + f[15] * a[6],
    )


@compiled
def _add_noise(
    p: FloatArray, memory: FloatArray, model: FloatArray, x: FloatArray, n: float
) -> None:
    """Add Q of ``n`` steps, (C.5) and (C.6), to the upper half of P.

    A disturbance of a state with m steps to go moves velocity by m, and height by m squared over
    two, times its acceleration; the sums over m are exact for a constant sensitivity.
    """
    step = model[0]
    s1, s2 = n * (n - 1.0) / 2.0 * step, (n - 1.0) * n * (2.0 * n - 1.0) / 6.0 * step * step
    s3 = s1 * s1 * step
    s4 = s2 * (3.0 * n * n - 3.0 * n - 1.0) / 5.0 * step * step
    by_3, by_4 = memory[29] / n, memory[30] / n
    st, ct, sp, cp = sin(x[2]), cos(x[2]), sin(x[3]), cos(x[3])
    tangent = st / ct
    white, walk = model[5] * step, model[9] * step
    q1, q2, q3 = model[6] * step, model[7] * step, model[8] * step
    c33 = cp * cp * q2 + sp * sp * q3
    c34 = sp * cp * tangent * (q2 - q3)
    c44 = q1 + tangent * tangent * (sp * sp * q2 + cp * cp * q3)
    to_3, to_4 = by_3 * c33 + by_4 * c34, by_3 * c34 + by_4 * c44
    both = by_3 * to_3 + by_4 * to_4 + walk
    walk_1, walk_2 = model[10] * step, model[11] * step
    lean_3, lean_4 = cp, sp * tangent
    p[0, 0] += white * step * step * (n * n * n / 3.0 - n / 12.0) + both * s4 / 4.0
    p[0, 1] += white * n * n * step / 2.0 + both * s3 / 2.0
    p[1, 1] += white * n + both * s2
    p[0, 2] += to_3 * s2 / 2.0
    p[0, 3] += to_4 * s2 / 2.0
    p[1, 2] += to_3 * s1
    p[1, 3] += to_4 * s1
    p[2, 2] += c33 * n + walk_2 * s2 * lean_3 * lean_3
    p[2, 3] += c34 * n + walk_2 * s2 * lean_3 * lean_4
    p[3, 3] += c44 * n + walk_2 * s2 * lean_4 * lean_4 + walk_1 * s2
    p[0, 4] += walk * s2 / 2.0
    p[1, 4] += walk * s1
    p[4, 4] += walk * n
    p[1, 5] += walk_1 * by_4 * s2 / 2.0
    p[3, 5] += walk_1 * s1
    p[5, 5] += walk_1 * n
    p[1, 6] += walk_2 * (by_3 * lean_3 + by_4 * lean_4) * s2 / 2.0
    p[2, 6] += walk_2 * s1 * lean_3
    p[3, 6] += walk_2 * s1 * lean_4
    p[6, 6] += walk_2 * n


@compiled
def _observe(
    u: Inputs,
    i: int,
    model: FloatArray,
    mark: int,
    y: FloatArray,
    x: FloatArray,
    p: FloatArray,
    memory: FloatArray,
    h: FloatArray,
    work: FloatArray,
    updates: FloatArray,
    done: int,
) -> int:
    """Update by the observations ``y`` one after the other, linearized once, (6.13).

    The innovation of a later one counts what the ones before have changed, so that the order is
    of no matter. Returns the end of the updates.
    """
    predicted, prior = work[0], work[1]
    _linearize(x, u[3][i], u[4][i], u[5][i], model, h, predicted)
    base = _base(mark, model, x, p, memory, h, predicted)
    p[DRIFT, DRIFT] += y[2 * KINDS]
    for j in range(STATES):
        prior[j] = x[j]
    for kind in range(KINDS):
        if y[kind] != y[kind]:
            continue
        innovation = y[kind] - predicted[kind]
        innovation += base if kind == 0 else 0.0
        for j in range(STATES):
            innovation -= h[kind, j] * (x[j] - prior[j])
        variance, update = y[KINDS + kind], updates[done]
        if mark & TRUSTED or _believed(kind, innovation, variance, model, h, p, memory, update):
            _update(p, x, h[kind], innovation, variance, update, work)
            done += 1
    return done


@compiled
def _base(
    mark: int,
    model: FloatArray,
    x: FloatArray,
    p: FloatArray,
    memory: FloatArray,
    h: FloatArray,
    predicted: FloatArray,
) -> float:
    """Return what the observed height is told from; adapt its prediction and its row of H."""
    if mark & CAPTURE:
        memory[CAPTURED] = predicted[0]
    if mark & RENEW:
        memory[ORIGIN] = x[0]
        _clone(x, p)
    if mark & REFLECTED:
        predicted[0] = x[0] + x[OFFSET]
        h[0, 2], h[0, 3], h[0, OFFSET] = 0.0, 0.0, 1.0
        return float(memory[ORIGIN])
    if mark & RELATIVE:
        return float(memory[CAPTURED])
    predicted[0] += x[DRIFT]
    h[0, DRIFT] = 1.0
    return 0.0


@compiled
def _believed(
    kind: int,
    innovation: float,
    variance: float,
    model: FloatArray,
    h: FloatArray,
    p: FloatArray,
    memory: FloatArray,
    update: FloatArray,
) -> bool:
    """Tell whether a reading may be what it says; heights that insist are another datum."""
    far = innovation * innovation > GATE * (_project(p, h[kind], update) + variance)
    if not far or abs(innovation) <= model[13 + kind]:
        memory[IN_A_ROW] = 0.0 if kind == 0 else memory[IN_A_ROW]
        return True
    if kind == 0:
        memory[IN_A_ROW] += 1.0
        if memory[IN_A_ROW] >= BELIEVED_AT:
            memory[IN_A_ROW] = 0.0
            p[DRIFT, DRIFT] += model[12]
            return True
    if memory[REJECTED + kind] == 0.0:
        memory[REJECTED_AT + kind] = memory[LATEST]
    memory[REJECTED + kind] += 1.0
    return False


@compiled
def _other(mark: int) -> float:
    """Return the state that an observation of ``mark`` begins anew, 0 if there is none."""
    if mark & RENEW:
        return float(OFFSET)
    return float(LEAN) if mark & FORGET else 0.0


@compiled
def _forget(variance: float, x: FloatArray, p: FloatArray, memory: FloatArray) -> float:
    """Begin the lean anew, told from the present specific force; returns how far that moved.

    What the lean made of this force so far becomes part of the acceleration's bias.
    """
    shift = memory[RUNNING] - memory[LEVEL]
    memory[LEVEL] = memory[RUNNING]
    x[BIAS] += shift * x[LEAN]
    for j in range(STATES):
        p[BIAS, j] += shift * p[LEAN, j]
    for j in range(STATES):
        p[j, BIAS] += shift * p[j, LEAN]
    _renew(LEAN, variance, x, p)
    return float(shift)


@compiled
def _clone(x: FloatArray, p: FloatArray) -> None:
    """Let the offset be what the height is off by where a stop begins."""
    x[OFFSET] = 0.0
    for j in range(STATES):
        p[OFFSET, j] = -p[0, j]
    for j in range(STATES):
        p[j, OFFSET] = -p[j, 0]


@compiled
def _renew(state: int, variance: float, x: FloatArray, p: FloatArray) -> None:
    """Begin ``state`` anew, from zero."""
    x[state] = 0.0
    for j in range(STATES):
        p[state, j], p[j, state] = 0.0, 0.0
    p[state, state] = variance


@compiled
def _project(p: FloatArray, h: FloatArray, update: FloatArray) -> float:
    """Write P H' into ``update`` and return H P H'."""
    spread = 0.0
    for i in range(STATES):
        total = 0.0
        for j in range(STATES):
            total += p[i, j] * h[j]
        update[STATES + i] = total
        spread += h[i] * total
    return spread


@compiled
def _update(
    p: FloatArray,
    x: FloatArray,
    h: FloatArray,
    innovation: float,
    variance: float,
    update: FloatArray,
    work: FloatArray,
) -> None:
    """Joseph form: P <- (I - K H) P (I - K H)' + K R K'."""
    total = _project(p, h, update) + variance
    for i in range(STATES):
        gain = update[STATES + i] / total
        x[i] += gain * innovation
        left = 0.0
        for j in range(STATES):
            left += (p[i, j] - gain * update[STATES + j]) * h[j]
        work[2, i], work[3, i] = gain, left
    for i in range(STATES):
        for j in range(i, STATES):
            p[i, j] += (
                work[2, i] * variance * work[2, j]
                - work[2, i] * update[STATES + j]
                - work[3, i] * work[2, j]
            )
            p[j, i] = p[i, j]
    for i in range(STATES):
        update[i], update[STATES + i] = h[i], work[2, i]
    update[INNOVATION], update[INNOVATION + 1] = innovation / total, 1.0 / total


@compiled
def _linearize(
    x: FloatArray, w1: float, w2: float, w3: float, model: FloatArray, h: FloatArray, y: FloatArray
) -> None:
    """(6.48) into ``y`` and (C.8) into ``h``, with the lever arm's forward part."""
    lx, ly, lz = model[2], model[3], model[4]
    st, ct, sp, cp = sin(x[2]), cos(x[2]), sin(x[3]), cos(x[3])
    q1, q2, q3 = w1 + x[5], w2 + x[6], w3
    up, side = sp * ly + cp * lz, cp * ly - sp * lz
    whirl_x, whirl_y, whirl_z = q2 * lz - q3 * ly, q3 * lx - q1 * lz, q1 * ly - q2 * lx
    inclined = ct * sp
    root = sqrt(1.0 - inclined * inclined)
    y[0] = x[0] - st * lx + ct * up
    y[1] = x[1] - st * whirl_x + ct * (sp * whirl_y + cp * whirl_z)
    y[2] = x[2]
    y[3] = asin(inclined)
    for i in range(KINDS):
        for j in range(STATES):
            h[i, j] = 0.0
    h[0, 0], h[0, 2], h[0, 3] = 1.0, -ct * lx - st * up, ct * side
    h[1, 1], h[1, 2] = 1.0, -ct * whirl_x - st * (sp * whirl_y + cp * whirl_z)
    h[1, 3], h[1, 5], h[1, 6] = (
        ct * (cp * whirl_y - sp * whirl_z),
        ct * side,
        -st * lz - ct * cp * lx,
    )
    h[2, 2] = 1.0
    h[3, 2], h[3, 3] = -st * sp / root, ct * cp / root
