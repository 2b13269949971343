"""The forward pass of the road-prior smoother: a linear Kalman filter over sub-blocks.

States are height r, velocity v, bias b, clearance d = r - z above the road z, its slope s and the
coefficients k of two inputs u, with r'' = a - b - k u, and z and s processes of the distance
travelled; a reading of the height sensor is d. Accelerations and inputs are linear between samples
and between nodes, so that all integrals are exact.
"""

from math import exp, expm1

import numpy as np

from floatref.estimators.models.road_prior_values import (
    BIAS,
    CLEARANCE,
    HEIGHT,
    LEAN,
    SLOPE,
    STATES,
    TILT,
    VELOCITY,
    Filter,
    Inputs,
    Model,
    Output,
)
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, Records

STANDING_S = 0.05
"""Where the vehicle has stood for so long, the laser may sway over an edge of the road."""


@compiled
def run(model: Model, inputs: Inputs, state: Filter, out: Output) -> int:
    """Filter the samples of ``inputs``, change ``state``, write ``out``; return how many nodes.

    Every multiple of the sub-block is a node. Heights are integrated from the node before.
    """
    a, first, count = inputs.acceleration, inputs.first, 0
    # A literal 0 has what is called with it compiled once more.
    begin = done = int(np.int64(0))
    while begin < a.size:
        at = begin + (-(first + begin)) % model.sub_block
        _integrate(model.step, inputs, begin, min(at + 1, a.size), state.memory, out.height)
        begin = at + 1
        if at >= a.size:
            break
        node = out.nodes[count]
        done = _node(model, inputs.ends[count], state, node, out.updates, done)
        node.at = first + at
        out.height[at] = state.x[HEIGHT]
        count += 1
    return count


@compiled
def end(
    model: Model, at: int, known: np.record, state: Filter, nodes: Records, updates: Records
) -> int:
    """Make a node of sample ``at``, the last, unless it is one; returns how many it made."""
    if state.memory.steps == 0.0:
        return 0
    nothing = int(np.int64(0))
    _node(model, known, state, nodes[0], updates, nothing)
    nodes[0].at = at
    return 1


@compiled
def _integrate(
    step: float, inputs: Inputs, begin: int, end: int, memory: np.record, height: FloatArray
) -> None:
    """Add what accelerations linear between samples make of velocity and height."""
    a = inputs.acceleration
    if begin < end and inputs.first + begin == 0:
        memory.acceleration = a[0]
        height[0] = memory.height
        begin = 1
    r, v, latest = memory.height, memory.velocity, memory.acceleration
    half, sixth = 0.5 * step, step * step / 6.0
    for i in range(begin, end):
        r += step * v + sixth * (2.0 * latest + a[i])
        v += half * (latest + a[i])
        latest = a[i]
        height[i] = r
    memory.height, memory.velocity, memory.acceleration = r, v, latest
    memory.steps += max(end - begin, 0)


@compiled
def _node(
    model: Model, known: np.record, state: Filter, node: np.record, updates: Records, done: int
) -> int:
    """Predict to the node, begin lean and tilt anew if asked, and update by the reading."""
    x, p, memory = state.x, state.p, state.memory
    near_r, near_v = memory.height, memory.velocity
    span = memory.steps * model.step
    _integrate_inputs(model, known, span, memory, node)
    if span > 0.0:
        _predict(model, known, span, node, state)
    memory.still = memory.still + span if known.travel <= 0.0 else 0.0
    node.renewed = known.anew
    if known.anew > 0.0:
        _renew(LEAN, model.lean, model.lean_prior, x, p)
        _renew(TILT, model.tilt, model.tilt_prior, x, p)
    if known.seen == known.seen:
        innovation = known.seen - x[CLEARANCE]
        _let_go(model, innovation, memory.still, p)
        _update(innovation, model.reading, x, p, updates[done])
        done += 1
    node.rise, node.climb, node.updated = x[HEIGHT] - near_r, x[VELOCITY] - near_v, done
    _keep_covariance(p, node)
    memory.height, memory.velocity, memory.steps = x[HEIGHT], x[VELOCITY], 0.0
    memory.leaning, memory.tilting, memory.along = known.leaning, known.tilting, known.along
    return done


@compiled
def _integrate_inputs(
    model: Model, known: np.record, span: float, memory: np.record, node: np.record
) -> None:
    """Write the elements of F: inputs linear since the node before, and the road's memory."""
    node.lean_once = 0.5 * span * (memory.leaning + known.leaning)
    node.tilt_once = 0.5 * span * (memory.tilting + known.tilting)
    node.lean_twice = span * span * (memory.leaning / 3.0 + known.leaning / 6.0)
    node.tilt_twice = span * span * (memory.tilting / 3.0 + known.tilting / 6.0)
    node.stays = exp(-known.travel / model.reach)
    node.climbs = node.stays * known.travel


@compiled
def _keep_covariance(p: FloatArray, node: np.record) -> None:
    upper, k = node.covariance, 0
    for i in range(STATES):
        for j in range(i, STATES):
            upper[k] = p[i, j]
            k += 1


@compiled
def _let_go(model: Model, innovation: float, still: float, p: FloatArray) -> None:
    """At a standstill, take the road for another one where a reading is too far off for this."""
    if still < STANDING_S:
        return
    if innovation * innovation > model.edge * (p[CLEARANCE, CLEARANCE] + model.reading):
        p[CLEARANCE, CLEARANCE] += innovation * innovation


@compiled
def _predict(model: Model, known: np.record, span: float, node: np.record, state: Filter) -> None:
    """Move x, and P <- F P F' + Q, from the node before.

    Height and velocity without the states' part are integrated already.
    """
    x, p, memory = state.x, state.p, state.memory
    road = node.stays * (x[HEIGHT] - x[CLEARANCE]) + node.climbs * x[SLOPE]
    x[HEIGHT] = memory.height - 0.5 * span * span * x[BIAS]
    x[HEIGHT] -= node.lean_twice * x[LEAN] + node.tilt_twice * x[TILT]
    x[VELOCITY] = (
        memory.velocity - span * x[BIAS] - node.lean_once * x[LEAN] - node.tilt_once * x[TILT]
    )
    x[CLEARANCE] = x[HEIGHT] - road
    x[SLOPE] *= node.stays
    # Rows of P F', and once turned, of F P F'.
    for i in range(STATES):
        _carry(node, span, p[i])
    for i in range(STATES):
        for j in range(i):
            p[i, j], p[j, i] = p[j, i], p[i, j]
    for i in range(STATES):
        _carry(node, span, p[i])
    along = 0.5 * (memory.along**2 + known.along**2)
    walk = model.walk + model.walk_along * along
    white = model.white + (model.gap - model.white) * known.missing
    t2, t3 = span * span, span * span * span
    _shake(p, HEIGHT, white * t3 / 3.0 + walk * t3 * t2 / 20.0)
    _shake(p, VELOCITY, white * t2 / 2.0 + walk * t2 * t2 / 8.0)
    _shake(p, BIAS, -walk * t3 / 6.0)
    _spread(p, VELOCITY, VELOCITY, white * span + walk * t3 / 3.0)
    _spread(p, VELOCITY, BIAS, -walk * t2 / 2.0)
    _spread(p, BIAS, BIAS, walk * span)
    _roughen(model, known.travel, p)


@compiled
def _roughen(model: Model, travel: float, p: FloatArray) -> None:
    """Add what ``travel`` in m brings of new road, without differences of exponentials."""
    gone = 2.0 * travel / model.reach
    fresh = -0.5 * model.reach * expm1(-gone)
    # The integrals of x exp(-2x / reach) and of its x-fold, within 1e-3 gone^2.
    once = fresh * travel / (2.0 + gone / 3.0)
    twice = fresh * travel * travel / (3.0 + 0.75 * gone)
    _spread(p, CLEARANCE, CLEARANCE, model.road * fresh + model.slope * twice)
    _spread(p, CLEARANCE, SLOPE, -model.slope * once)
    _spread(p, SLOPE, SLOPE, model.slope * fresh)


@compiled
def _carry(node: np.record, span: float, c: FloatArray) -> None:
    """Replace ``c`` by F c."""
    rise = span * (c[VELOCITY] - 0.5 * span * c[BIAS])
    rise -= node.lean_twice * c[LEAN] + node.tilt_twice * c[TILT]
    sinks = (1.0 - node.stays) * c[HEIGHT] - node.climbs * c[SLOPE]
    c[CLEARANCE] = node.stays * c[CLEARANCE] + rise + sinks
    c[HEIGHT] += rise
    c[VELOCITY] -= span * c[BIAS] + node.lean_once * c[LEAN] + node.tilt_once * c[TILT]
    c[SLOPE] *= node.stays


@compiled
def _spread(p: FloatArray, i: int, j: int, value: float) -> None:
    p[i, j] += value
    if i != j:
        p[j, i] += value


@compiled
def _shake(p: FloatArray, state: int, value: float) -> None:
    """Add a covariance of the height's noise, which is the clearance's too, with a ``state``'s."""
    _spread(p, HEIGHT, state, value)
    _spread(p, CLEARANCE, state, value)
    if state == HEIGHT:
        p[CLEARANCE, CLEARANCE] += value


@compiled
def _renew(state: int, expected: float, variance: float, x: FloatArray, p: FloatArray) -> None:
    x[state] = expected
    for j in range(STATES):
        p[state, j], p[j, state] = 0.0, 0.0
    p[state, state] = variance


@compiled
def _update(
    innovation: float, variance: float, x: FloatArray, p: FloatArray, update: np.record
) -> None:
    """Joseph form with H of 1 for the clearance."""
    gain = update.gain
    total = p[CLEARANCE, CLEARANCE] + variance
    for i in range(STATES):
        gain[i] = p[i, CLEARANCE] / total
        x[i] += gain[i] * innovation
    # P (I - K H)', then (I - K H) times that, then K R K' added.
    for i in range(STATES):
        seen = p[i, CLEARANCE]
        for j in range(STATES):
            p[i, j] -= seen * gain[j]
    for j in range(STATES):
        seen = p[CLEARANCE, j]
        for i in range(j + 1):
            p[i, j] -= gain[i] * seen
    for i in range(STATES):
        for j in range(i, STATES):
            p[i, j] += variance * gain[i] * gain[j]
            p[j, i] = p[i, j]
    update.innovation, update.information = innovation / total, 1.0 / total
