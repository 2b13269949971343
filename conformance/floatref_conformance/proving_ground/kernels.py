"""Compiled kernels: the kinematics of a vehicle's sensors."""

from math import asin, atan2, cos, sin

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray

Vector = tuple[float, float, float]
Frame = tuple[Vector, Vector, Vector]

F_X, F_Y, F_Z, RANGE, R_Z, V_Z, A_Z, ROAD = range(8)
RATE_X, RATE_Y, RATE_Z, PITCH_ANGLE, ROLL_ANGLE = range(5)
TRACK_ROWS, SHARED_ROWS = 8, 5


@compiled
def elevation_at(rows: FloatArray, row: int, position: float) -> float:
    """Return a row of ``rows`` at a fractional index: linear between points, constant beyond.

    The row is named and not handed over: a view of it is counted, which takes as long again.
    """
    if position <= 0.0:
        return float(rows[row, 0])
    index, last = int(position), rows.shape[1] - 1
    if index >= last:
        return float(rows[row, last])
    below = rows[row, index]
    return float(below + (position - index) * (rows[row, index + 1] - below))


@compiled
def footprint(
    paths: FloatArray,
    grid: FloatArray,
    pairs: FloatArray,
    track: int,
    lens: Vector,
    beam: Vector,
    guess: float,
) -> float:
    """Return the range in m from the ``lens`` against the ``beam`` (body Z) down to the road.

    Fixed-point iteration of (2.18) over the road under the footprint; it converges as the
    road's slope times the body's tilt. ``pairs[track]`` holds the rows of the wheel paths to the
    right and left of the track, the lateral position of the first in m and 1 / their distance.
    """
    x, y, z = lens
    right_row, left_row = int(pairs[track, 0]), int(pairs[track, 1])
    for _ in range(50):
        position = (x - guess * beam[0] - grid[0]) * grid[1]
        right = elevation_at(paths, right_row, position)
        left = elevation_at(paths, left_row, position)
        weight = (y - guess * beam[1] - pairs[track, 2]) * pairs[track, 3]
        last, guess = guess, (z - right - weight * (left - right)) / beam[2]
        if abs(guess - last) < 1e-11:
            break
    return guess


@compiled
def at_points(
    body: FloatArray,
    travel: FloatArray,
    course: FloatArray,
    points: FloatArray,
    paths: FloatArray,
    grid: FloatArray,
    pairs: FloatArray,
    tracks: FloatArray,
    shared: FloatArray,
) -> None:
    """Carry the body's motion to the reference points and lasers, in exact sines.

    The course's frame (x along the lane, z normal to it) turns about the vertical with
    curvature × speed. (2.17) is specific force = Rᵀ(a + g·up), (2.18) the footprint.

    Args:
        body: heave, pitch, roll and their derivatives in that frame, shape (9, n).
        travel: distance, speed, acceleration of the vehicle point on the course, shape (3, n).
        course: curvature in 1/m, components of `up` in the course's frame, g in m/s², height of
            the centre of gravity in m, shape (6,).
        points: per track, reference point from the centre of gravity (x, y, z), then
            laser offset (x, y) from it, in m, shape (tracks, 5).
        paths: elevation of the wheel paths from right to left, shape (paths, m), in m.
        grid: start in m and points per m of ``paths``, shape (2,).
        pairs: see `footprint`, shape (tracks, 4).
        tracks: written, shape (tracks, 8, n).
        shared: written, shape (5, n).
    """
    guess = np.zeros(points.shape[0])
    for k in range(body.shape[1]):
        frame = axes(body[1, k], body[2, k])
        turn, turning = turn_rate_at(course, travel[1, k]), turn_rate_at(course, travel[2, k])
        rate, rate_change = rates(frame, body, k, turn, turning)
        force, velocity = at_centre(course, body, travel, k, turn, turning)
        force = into_body(frame, force)
        up = (course[1], course[2], course[3])
        beam = (frame[0][2], frame[1][2], frame[2][2])
        zeta = course[5] + body[0, k]
        vertical = into_body(frame, up)
        shared[RATE_X, k], shared[RATE_Y, k], shared[RATE_Z, k] = rate
        if up[0] == 0.0 and up[1] == 0.0:
            shared[PITCH_ANGLE, k], shared[ROLL_ANGLE, k] = body[1, k], body[2, k]
        else:
            shared[PITCH_ANGLE, k] = -asin(vertical[0])
            shared[ROLL_ANGLE, k] = atan2(vertical[1], vertical[2])
        for t in range(points.shape[0]):
            r = (points[t, 0], points[t, 1], points[t, 2])
            whirl = cross(rate, r)
            f = add(force, add(cross(rate_change, r), cross(rate, whirl)))
            tracks[t, F_X, k], tracks[t, F_Y, k], tracks[t, F_Z, k] = f
            tracks[t, A_Z, k] = dot(vertical, f) - course[4]
            tracks[t, V_Z, k] = dot(up, velocity) + dot(vertical, whirl)
            tracks[t, R_Z, k] = up[0] * travel[0, k] + up[2] * zeta + dot(vertical, r)
            p = (r[0] + points[t, 3], r[1] + points[t, 4], r[2])
            lens = (travel[0, k] + dot(frame[0], p), dot(frame[1], p), zeta + dot(frame[2], p))
            h = guess[t] = footprint(paths, grid, pairs, t, lens, beam, guess[t])
            tracks[t, RANGE, k], tracks[t, ROAD, k] = h, dot(up, lens) - h * dot(up, beam)


@compiled
def axes(pitch: float, roll: float) -> Frame:
    """Return the rows of (6.23) without yaw: the course's axes in body components."""
    st, ct, sp, cp = sin(pitch), cos(pitch), sin(roll), cos(roll)
    return (ct, st * sp, st * cp), (0.0, cp, -sp), (-st, ct * sp, ct * cp)


@compiled
def turn_rate_at(course: FloatArray, speed: float) -> Vector:
    """Return the course's turn rate about the vertical, in its own frame, at a speed."""
    pace = course[0] * speed
    return pace * course[1], pace * course[2], pace * course[3]


@compiled
def rates(
    frame: Frame, body: FloatArray, k: int, turn: Vector, turning: Vector
) -> tuple[Vector, Vector]:
    """Return the body's angular rate and acceleration in body axes, the inverse of (6.27-28)."""
    cp, sp = frame[1][1], -frame[1][2]
    own = (body[5, k], body[4, k] * cp, -body[4, k] * sp)
    twist = body[4, k] * body[5, k]
    own_change = (body[8, k], body[7, k] * cp - twist * sp, -body[7, k] * sp - twist * cp)
    carried = into_body(frame, turn)
    change = add(add(into_body(frame, turning), own_change), cross(carried, own))
    return add(carried, own), change


@compiled
def at_centre(
    course: FloatArray, body: FloatArray, travel: FloatArray, k: int, turn: Vector, turning: Vector
) -> tuple[Vector, Vector]:
    """Return specific force and velocity of the centre of gravity in the course's frame."""
    lift = (0.0, 0.0, course[5] + body[0, k])
    swept = cross(turn, lift)
    own = (travel[2, k], 0.0, body[6, k])
    coriolis = cross(turn, (travel[1, k], 0.0, 2.0 * body[3, k]))
    frame_made = add(cross(turning, lift), cross(turn, swept))
    weight = (course[4] * course[1], course[4] * course[2], course[4] * course[3])
    force = add(add(own, weight), add(coriolis, frame_made))
    return force, add((travel[1, k], 0.0, body[3, k]), swept)


@compiled
def into_body(frame: Frame, vector: Vector) -> Vector:
    """Return ``vector`` of the course's frame in body axes, (6.24)."""
    a, b, c = frame
    x, y, z = vector
    return (
        a[0] * x + b[0] * y + c[0] * z,
        a[1] * x + b[1] * y + c[1] * z,
        a[2] * x + b[2] * y + c[2] * z,
    )


@compiled
def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product of ``a`` and ``b``."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@compiled
def add(a: Vector, b: Vector) -> Vector:
    """Return the sum of ``a`` and ``b``."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@compiled
def dot(a: Vector, b: Vector) -> float:
    """Return the scalar product of ``a`` and ``b``."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
