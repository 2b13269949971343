"""Compiled kernels: the vehicle's state update, with and without the forces of its corners.

numba's cache sees no change of `elevation_at` or of the fields of `Corners`, which are in other
files: who changes one in a clone deletes `__pycache__/*.nb?` beside this file.
"""

from math import copysign, exp

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray
from floatref_conformance.proving_ground.kernels import elevation_at
from floatref_conformance.proving_ground.vehicles.corner_forces import Corners

STATES, INPUTS = 16, 6
"""Of seven freedoms, padded to whole vector lanes; four wheels' roads and two accelerations."""
WHEELS = 4
BODY_ROWS = 9
"""Heave, pitch, roll; their first derivatives; their second derivatives."""


@compiled
def respond(
    update: FloatArray,
    outputs: FloatArray,
    vector: FloatArray,
    lanes: FloatArray,
    grid: FloatArray,
    wheel_x: FloatArray,
    distance: FloatArray,
    ground: FloatArray,
    pose: IndexArray,
    body: FloatArray,
    steps: IndexArray,
    states: FloatArray,
) -> None:
    """Advance a linear vehicle over a stretch and write the motion of its body.

    Args:
        update: next state from states and sums of old and new inputs, shape (22, 16).
        outputs: second derivatives of the body from states and inputs, shape (22, 4).
        vector: 16 states and 6 inputs of the sample before; left at those of the last.
        lanes: enveloped road under each wheel, shape (4, m), in m.
        grid: start in m and points per m of ``lanes``, shape (2,).
        wheel_x: position of each wheel ahead of the vehicle point, shape (4,), in m.
        distance: true distance, shape (n,), in m.
        ground: its longitudinal and lateral specific force, shape (2, n), in m/s².
        pose: places of heave, pitch, roll and their rates in ``vector``, shape (6,).
        body: written, shape (9, n), in m, rad and s.
        steps: rising samples after which ``vector`` is kept, shape (m,).
        states: written, shape (m, 22).
    """
    sums, fresh, second = np.empty(STATES + INPUTS), np.empty(STATES), np.empty(4)
    kept = 0
    for k in range(distance.size):
        _take_inputs(vector, sums, lanes, grid, wheel_x, distance[k], ground, k)
        combine(update, sums, fresh)
        for i in range(STATES):
            vector[i] = fresh[i]
        combine(outputs, vector, second)
        _write(body, k, vector, pose, second)
        if kept < steps.size and steps[kept] == k:
            _keep(states, kept, vector)
            kept += 1


@compiled
def respond_with_corners(
    update: FloatArray,
    outputs: FloatArray,
    vector: FloatArray,
    lanes: FloatArray,
    grid: FloatArray,
    wheel_x: FloatArray,
    distance: FloatArray,
    ground: FloatArray,
    pose: IndexArray,
    body: FloatArray,
    steps: IndexArray,
    states: FloatArray,
    corners: Corners,
) -> None:
    """Advance a vehicle as `respond` does, with the forces of its ``corners`` as further inputs.

    They enter by the trapezoidal rule too, so that position, velocity and acceleration obey it.
    The force of the new step is that of the travel which the last step's force leads to: the
    travel is off by step²/4 / mass times the change of force, which leaves the rule's order.
    """
    sums, fresh, second = np.empty(STATES + INPUTS), np.empty(STATES), np.empty(4)
    travel, both = np.empty(WHEELS), np.empty(WHEELS)
    kept = 0
    for k in range(distance.size):
        _take_inputs(vector, sums, lanes, grid, wheel_x, distance[k], ground, k)
        combine(update, sums, fresh)
        _predict(corners, fresh, travel)
        for c in range(WHEELS):
            both[c] = corners.force[c]
            _strain(corners, c, travel[c])
            both[c] += corners.force[c]
        for i in range(STATES):
            vector[i] = fresh[i]
            for c in range(WHEELS):
                vector[i] += corners.entry[i, c] * both[c]
        combine(outputs, vector, second)
        for i in range(3):
            for c in range(WHEELS):
                second[i] += corners.lift[i, c] * corners.force[c]
        _write(body, k, vector, pose, second)
        if kept < steps.size and steps[kept] == k:
            _keep(states, kept, vector)
            kept += 1


@compiled
def combine(matrix: FloatArray, vector: FloatArray, result: FloatArray) -> None:
    """Write Σⱼ ``matrix[j]``·``vector[j]`` to ``result``, four sums in one vector lane."""
    for i in range(0, result.size, 4):
        a = b = c = d = 0.0
        for j in range(STATES + INPUTS):
            a += matrix[j, i] * vector[j]
            b += matrix[j, i + 1] * vector[j]
            c += matrix[j, i + 2] * vector[j]
            d += matrix[j, i + 3] * vector[j]
        result[i], result[i + 1], result[i + 2], result[i + 3] = a, b, c, d


@compiled
def _take_inputs(
    vector: FloatArray,
    sums: FloatArray,
    lanes: FloatArray,
    grid: FloatArray,
    wheel_x: FloatArray,
    distance: float,
    ground: FloatArray,
    k: int,
) -> None:
    """Write states and sums of old and new inputs to ``sums``, and the new to ``vector``."""
    for i in range(STATES):
        sums[i] = vector[i]
    for w in range(INPUTS):
        now = ground[max(w - WHEELS, 0), k]
        if w < WHEELS:
            now = elevation_at(lanes, w, (distance + wheel_x[w] - grid[0]) * grid[1])
        sums[STATES + w] = vector[STATES + w] + now
        vector[STATES + w] = now


@compiled
def _write(
    body: FloatArray, k: int, vector: FloatArray, pose: IndexArray, second: FloatArray
) -> None:
    """Write the body's pose, its rates and their derivatives at sample ``k``."""
    for i in range(3):
        body[i, k] = vector[pose[i]]
        body[3 + i, k] = vector[pose[3 + i]]
        body[6 + i, k] = second[i]


@compiled
def _keep(states: FloatArray, row: int, vector: FloatArray) -> None:
    """Write ``vector`` to a row of ``states``, one by one.

    For an assignment of arrays numba would compile the text of its error as well.
    """
    for i in range(STATES + INPUTS):
        states[row, i] = vector[i]


@compiled
def _predict(corners: Corners, states: FloatArray, travel: FloatArray) -> None:
    """Write the travel of every corner after a step under the last step's forces."""
    for c in range(WHEELS):
        travel[c] = 0.0
        for i in range(corners.rows.shape[1]):
            travel[c] += corners.rows[c, i] * states[i]
        for j in range(WHEELS):
            travel[c] += 2.0 * corners.reach[c, j] * corners.force[j]


@compiled
def _strain(corners: Corners, c: int, travel: float) -> None:
    """Bring corner ``c`` to a travel: its friction slides there, its spring stiffens.

    Dahl's friction depends on the path alone, and so the step is its exact solution: the force
    nears the limit of the direction of travel exponentially (Fancher's equation).
    """
    moved = travel - corners.travel[c]
    limit = copysign(corners.limit[c], moved)
    left = (corners.friction[c] - limit) * exp(-abs(moved) / corners.slide_m)
    corners.friction[c] = limit + left
    corners.travel[c] = travel
    corners.force[c] = corners.cubic[c] * travel**3 + corners.friction[c]
