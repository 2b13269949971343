"""The forward pass of the road-prior smoother: a linear Kalman filter over sub-blocks.

States are height r, velocity v, bias b, road z, its slope s and the coefficients k of two inputs u,
with r'' = a - b - k u, and z and s processes of the distance travelled; a reading of the height
sensor is r - z. Accelerations and inputs are linear between samples and between nodes, so that all
integrals are exact.
"""

from math import exp, expm1

import numpy as np

from floatref.estimators.road_prior.layout import (
    ALONG,
    ANEW,
    BEFORE,
    BIAS,
    CLIMBS,
    EDGE,
    GAP,
    INNOVATION,
    JUMP,
    LATEST,
    LEAN,
    LEAN_EXPECTED,
    LEAN_PRIOR,
    MISSING,
    ONCE,
    READING,
    RENEWED,
    ROAD,
    ROAD_REACH,
    ROAD_STEP,
    SEEN,
    SLOPE,
    SLOPE_STEP,
    SPREAD,
    STATES,
    STAYS,
    STEP,
    STEPS,
    STILL,
    TILT,
    TILT_EXPECTED,
    TILT_PRIOR,
    TRAVEL,
    TWICE,
    WALK,
    WALK_ALONG,
    WHITE,
)
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray

STANDING_S = 0.05
"""Where the vehicle has stood for so long, the laser may sway over an edge of the road."""


@compiled
def run(
    a: FloatArray,
    first: int,
    sub_block: int,
    model: FloatArray,
    ends: FloatArray,
    x: FloatArray,
    p: FloatArray,
    memory: FloatArray,
    height: FloatArray,
    node_at: IndexArray,
    rows: FloatArray,
    updates: FloatArray,
) -> int:
    """Advance by the accelerations ``a`` in m/s² and return the number of nodes.

    Sample number ``first`` is absolute; every multiple of ``sub_block`` is a node, and ``ends``
    tells what is known there. ``x``, ``p`` and ``memory`` are changed; ``height`` gets the height
    integrated from the node before, and ``node_at`` (k, 2), ``rows`` and ``updates`` what the
    backward pass needs.
    """
    count = 0
    # A literal 0 has what is called with it compiled once more.
    begin = done = int(np.int64(0))
    while begin < a.size:
        node = begin + (-(first + begin)) % sub_block
        _integrate(a, begin, min(node + 1, a.size), first, model[STEP], memory, height)
        begin = node + 1
        if node >= a.size:
            break
        done = _node(model, ends[count], x, p, memory, rows[count], updates, done)
        node_at[count, 0], node_at[count, 1] = first + node, done
        height[node] = x[0]
        count += 1
    return count


@compiled
def end(
    at: int,
    model: FloatArray,
    known: FloatArray,
    x: FloatArray,
    p: FloatArray,
    memory: FloatArray,
    node_at: IndexArray,
    rows: FloatArray,
) -> int:
    """Make a node of sample ``at``, the last, unless it is one; returns how many it made."""
    if memory[STEPS] == 0.0:
        return 0
    nothing = int(np.int64(0))
    _node(model, known, x, p, memory, rows[0], np.empty((1, STATES)), nothing)
    node_at[0, 0], node_at[0, 1] = at, 0
    return 1


@compiled
def _integrate(
    a: FloatArray,
    begin: int,
    end: int,
    first: int,
    step: float,
    memory: FloatArray,
    height: FloatArray,
) -> None:
    if begin < end and first + begin == 0:
        memory[LATEST] = a[0]
        height[0] = memory[0]
        begin = 1
    r, v, latest = memory[0], memory[1], memory[LATEST]
    half, sixth = 0.5 * step, step * step / 6.0
    for i in range(begin, end):
        r += step * v + sixth * (2.0 * latest + a[i])
        v += half * (latest + a[i])
        latest = a[i]
        height[i] = r
    memory[0], memory[1], memory[LATEST] = r, v, latest
    memory[STEPS] += max(end - begin, 0)


@compiled
def _node(
    model: FloatArray,
    known: FloatArray,
    x: FloatArray,
    p: FloatArray,
    memory: FloatArray,
    row: FloatArray,
    updates: FloatArray,
    done: int,
) -> int:
    """Predict to the node, begin lean and tilt anew if asked, and update by the reading."""
    near_r, near_v = memory[0], memory[1]
    span = memory[STEPS] * model[STEP]
    for j in range(2):
        row[ONCE + j] = 0.5 * span * (memory[BEFORE + j] + known[j])
        row[TWICE + j] = span * span * (memory[BEFORE + j] / 3.0 + known[j] / 6.0)
    row[STAYS] = exp(-known[TRAVEL] / model[ROAD_REACH])
    row[CLIMBS] = row[STAYS] * known[TRAVEL]
    if span > 0.0:
        _predict(model, known, span, row, x, p, memory)
    memory[STILL] = memory[STILL] + span if known[TRAVEL] <= 0.0 else 0.0
    row[RENEWED] = known[ANEW]
    if known[ANEW] > 0.0:
        _renew(LEAN, model[LEAN_EXPECTED], model[LEAN_PRIOR], x, p)
        _renew(TILT, model[TILT_EXPECTED], model[TILT_PRIOR], x, p)
    if known[SEEN] == known[SEEN]:
        innovation = known[SEEN] - x[0] + x[ROAD]
        _let_go(innovation, model, memory[STILL], p)
        _update(innovation, model[READING], x, p, updates[done])
        done += 1
    row[JUMP], row[JUMP + 1] = x[0] - near_r, x[1] - near_v
    at = SPREAD
    for i in range(STATES):
        for j in range(i, STATES):
            row[at] = p[i, j]
            at += 1
    memory[0], memory[1], memory[STEPS] = x[0], x[1], 0.0
    for j in range(3):
        memory[BEFORE + j] = known[j]
    return done


@compiled
def _let_go(innovation: float, model: FloatArray, still: float, p: FloatArray) -> None:
    """At a standstill, take the road for another one where a reading is too far off for this."""
    if still < STANDING_S:
        return
    expected = p[0, 0] - 2.0 * p[0, ROAD] + p[ROAD, ROAD] + model[READING]
    if innovation * innovation > model[EDGE] * expected:
        p[ROAD, ROAD] += innovation * innovation


@compiled
def _predict(
    model: FloatArray,
    known: FloatArray,
    span: float,
    row: FloatArray,
    x: FloatArray,
    p: FloatArray,
    memory: FloatArray,
) -> None:
    """Move x and P from the node before, whose height and velocity are integrated already."""
    x[0] = memory[0] - 0.5 * span * span * x[BIAS] - row[TWICE] * x[LEAN] - row[TWICE + 1] * x[TILT]
    x[1] = memory[1] - span * x[BIAS] - row[ONCE] * x[LEAN] - row[ONCE + 1] * x[TILT]
    x[ROAD] = row[STAYS] * x[ROAD] + row[CLIMBS] * x[SLOPE]
    x[SLOPE] *= row[STAYS]
    # Rows of P F', and once turned, of F P F'.
    for i in range(STATES):
        _carry(row, span, p[i])
    for i in range(STATES):
        for j in range(i):
            p[i, j], p[j, i] = p[j, i], p[i, j]
    for i in range(STATES):
        _carry(row, span, p[i])
    along = 0.5 * (memory[BEFORE + ALONG] ** 2 + known[ALONG] ** 2)
    walk = model[WALK] + model[WALK_ALONG] * along
    white = model[WHITE] + (model[GAP] - model[WHITE]) * known[MISSING]
    t2, t3 = span * span, span * span * span
    _spread(p, 0, 0, white * t3 / 3.0 + walk * t3 * t2 / 20.0)
    _spread(p, 0, 1, white * t2 / 2.0 + walk * t2 * t2 / 8.0)
    _spread(p, 1, 1, white * span + walk * t3 / 3.0)
    _spread(p, 0, BIAS, -walk * t3 / 6.0)
    _spread(p, 1, BIAS, -walk * t2 / 2.0)
    _spread(p, BIAS, BIAS, walk * span)
    _roughen(model, known[TRAVEL], p)


@compiled
def _roughen(model: FloatArray, travel: float, p: FloatArray) -> None:
    """Add what ``travel`` in m brings of new road, without differences of exponentials."""
    gone = 2.0 * travel / model[ROAD_REACH]
    fresh = -0.5 * model[ROAD_REACH] * expm1(-gone)
    # The integrals of x exp(-2x / reach) and of its x-fold, within 1e-3 gone^2.
    once = fresh * travel / (2.0 + gone / 3.0)
    twice = fresh * travel * travel / (3.0 + 0.75 * gone)
    _spread(p, ROAD, ROAD, model[ROAD_STEP] * fresh + model[SLOPE_STEP] * twice)
    _spread(p, ROAD, SLOPE, model[SLOPE_STEP] * once)
    _spread(p, SLOPE, SLOPE, model[SLOPE_STEP] * fresh)


@compiled
def _carry(row: FloatArray, span: float, c: FloatArray) -> None:
    """Replace ``c`` by F c."""
    c[0] += span * (c[1] - 0.5 * span * c[BIAS])
    c[0] -= row[TWICE] * c[LEAN] + row[TWICE + 1] * c[TILT]
    c[1] -= span * c[BIAS] + row[ONCE] * c[LEAN] + row[ONCE + 1] * c[TILT]
    c[ROAD] = row[STAYS] * c[ROAD] + row[CLIMBS] * c[SLOPE]
    c[SLOPE] *= row[STAYS]


@compiled
def _spread(p: FloatArray, i: int, j: int, value: float) -> None:
    p[i, j] += value
    if i != j:
        p[j, i] += value


@compiled
def _renew(state: int, expected: float, variance: float, x: FloatArray, p: FloatArray) -> None:
    x[state] = expected
    for j in range(STATES):
        p[state, j], p[j, state] = 0.0, 0.0
    p[state, state] = variance


@compiled
def _update(
    innovation: float, variance: float, x: FloatArray, p: FloatArray, update: FloatArray
) -> None:
    """Joseph form with H of +1 for the height and -1 for the road."""
    total = p[0, 0] - 2.0 * p[0, ROAD] + p[ROAD, ROAD] + variance
    for i in range(STATES):
        update[i] = (p[i, 0] - p[i, ROAD]) / total
        x[i] += update[i] * innovation
    for i in range(STATES):
        seen = p[i, 0] - p[i, ROAD]
        for j in range(STATES):
            p[i, j] -= seen * update[j]
    for j in range(STATES):
        seen = p[0, j] - p[ROAD, j]
        for i in range(STATES):
            p[i, j] -= update[i] * seen
    for i in range(STATES):
        for j in range(i, STATES):
            p[i, j] += variance * update[i] * update[j]
            p[j, i] = p[i, j]
    update[INNOVATION], update[INNOVATION + 1] = innovation / total, 1.0 / total
