"""The true motion of a vehicle's body and of every reference point, sample by sample."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Setup
from floatref_conformance.proving_ground.drives.drive import Longitudinal
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.vehicles.kinematics import Course, Sighted
from floatref_conformance.proving_ground.vehicles.response import Response, count_steps
from floatref_conformance.proving_ground.vehicles.suspended import Suspended
from floatref_conformance.proving_ground.vehicles.suspension import SuspensionMotion, Watch

STRETCH = 32768
"""Samples carried at once, so that a stretch stays in the processor's cache."""


@dataclass(frozen=True, eq=False)
class TrackMotion:
    """What one reference point and its laser truly do; arrays of shape (n,).

    Attributes:
        longitudinal, lateral, vertical: specific force along body X, Y, Z, in m/s² (2.17).
        range_m: from the reference point along body −Z to the road, in m.
        height_m: elevation of the reference point, up, in m.
        velocity: its vertical velocity, in m/s.
        acceleration: its vertical acceleration, in m/s².
        road_m: elevation of the road under the laser's footprint, in m.
    """

    longitudinal: FloatArray
    lateral: FloatArray
    vertical: FloatArray
    range_m: FloatArray
    height_m: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    road_m: FloatArray


@dataclass(frozen=True, eq=False)
class BodyMotion:
    """What the vehicle truly does; arrays of shape (n,) on ``clock``.

    Attributes:
        clock: the recording's.
        distance: of the vehicle point along the course, in m.
        speed: in m/s.
        acceleration: longitudinal, of the vehicle point, in m/s².
        rates: angular rate of the body in body axes, shape (3, n), in rad/s.
        pitch, roll: Euler angles against the vertical, nose down and left up, in rad (6.23).
        tracks: the reference points by wheel path.
        suspension: the freedoms of the vehicle, if they were asked for.
    """

    clock: UniformClock
    distance: FloatArray
    speed: FloatArray
    acceleration: FloatArray
    rates: FloatArray
    pitch: FloatArray
    roll: FloatArray
    tracks: Mapping[str, TrackMotion]
    suspension: SuspensionMotion | None = None

    @property
    def times_s(self) -> FloatArray:
        """Time of every sample, in s."""
        return self.clock.times(self.distance.size)

    @classmethod
    def of(
        cls,
        clock: UniformClock,
        travel: FloatArray,
        shared: FloatArray,
        tracks: Mapping[str, FloatArray],
        suspension: SuspensionMotion | None = None,
    ) -> "BodyMotion":
        """Return the motion in the rows of `kernels.at_points`, made read-only."""
        for rows in (travel, shared, *tracks.values()):
            rows.flags.writeable = False
        named = {name: TrackMotion(*rows) for name, rows in tracks.items()}
        distance, speed, acceleration = travel
        pitch, roll = shared[3:]
        return cls(clock, distance, speed, acceleration, shared[:3], pitch, roll, named, suspension)


def drive_over(
    vehicle: Suspended,
    road: Road,
    course: Course,
    drive: Longitudinal,
    duration_s: float,
    rate_hz: float,
    setup: Setup,
    response_rate_hz: float | None = None,
    read: Road | None = None,
) -> BodyMotion:
    """Return the motion of ``vehicle`` on ``drive``, from static equilibrium on the first points.

    Args:
        vehicle: parameters of the model.
        road: under wheels and lasers; its grid has to reach behind distance 0.
        course: slopes and curvature of the lane.
        drive: distance, speed and acceleration of the vehicle point.
        duration_s: how long to drive, in s.
        rate_hz: rate of the result, in Hz.
        setup: where the reference points and lasers of each wheel path sit.
        response_rate_hz: rate in Hz at which the freedoms are kept; None: not at all.
        read: under the lasers, if they read another height than the tyres roll on.
    """
    clock = UniformClock.of(rate_hz)
    every = count_steps(rate_hz)
    inner = UniformClock(clock.rate * every)
    under = road if read is None else read
    seen = Sighted.of(course, under, list(setup.tracks.values()), vehicle.cg_height_m)
    count = int(duration_s * rate_hz) * every + 1
    travel, shared, tracks = empty_rows(len(setup.tracks), count)
    start = drive.motion(np.zeros(1))
    grade = road.alignment.grade(start.distance)
    ground = course.ground_force(start.speed, start.acceleration, grade)[:, 0]
    response = Response.of(vehicle, road, 1.0 / float(inner.rate), ground)
    watch = Watch(response_rate_hz, inner, count) if response_rate_hz else None
    for first, last in stretches(count):
        part = slice(first, last)
        motion = drive.motion(inner.times(last - first, first))
        travel[:, part] = motion.distance, motion.speed, motion.acceleration
        grade = road.alignment.grade(motion.distance)
        ground = course.ground_force(motion.speed, motion.acceleration, grade)
        wanted = watch.within(first, last) if watch else ()
        body = response.advance(motion.distance, ground, *wanted)
        seen.carry(body, travel[:, part], tracks[:, :, part], shared[:, part])
    if every > 1:
        tracks = _decimate(tracks, every)
        travel, shared = travel[:, ::every].copy(), shared[:, ::every].copy()
    named = dict(zip(setup.tracks, tracks, strict=True))
    suspension = watch.motion(vehicle, course, drive, road.alignment) if watch else None
    return BodyMotion.of(clock, travel, shared, named, suspension)


def _decimate(tracks: FloatArray, every: int) -> FloatArray:
    """Return every q-th sample, accelerations averaged over the interval around it.

    An accelerometer is band-limited to its recording: a sudden change between two samples
    keeps its integral. The interval is centred, so that it stays in step with the range.
    """
    from floatref_conformance.proving_ground.kernels import A_Z, F_X, F_Y, F_Z

    fewer = tracks[:, :, ::every].copy()
    offsets = np.arange(-(every // 2), every // 2 + 1)
    weights = np.ones(offsets.size)
    if every % 2 == 0:
        weights[[0, -1]] = 0.5
    weights /= every
    last = fewer.shape[2] - 1
    for row in (F_X, F_Y, F_Z, A_Z):
        fewer[:, row] = 0.0
        for weight, offset in zip(weights, offsets.tolist(), strict=True):
            inside = slice(every + offset, last * every + offset, every)
            fewer[:, row, 1:last] += weight * tracks[:, row, inside]
            for end in {0, last}:
                # Beyond the drive its first and its last sample go on.
                at = min(max(end * every + offset, 0), tracks.shape[2] - 1)
                fewer[:, row, end] += weight * tracks[:, row, at]
    return fewer


def stretches(count: int) -> Iterator[tuple[int, int]]:
    """Yield first and last sample (exclusive) of every stretch of ``count`` samples."""
    for first in range(0, count, STRETCH):
        yield first, min(first + STRETCH, count)


def empty_rows(tracks: int, count: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return arrays for travel, shared and per-track rows of ``count`` samples, unset.

    Rows have room behind them, as those of a stretch of a drive have: so `kernels.at_points` is
    compiled once, and not again for a vehicle that is parked.
    """
    from floatref_conformance.proving_ground.kernels import SHARED_ROWS, TRACK_ROWS

    room, used = count + 1, slice(count)
    shared = np.empty((SHARED_ROWS, room))[:, used]
    return np.empty((3, room))[:, used], shared, np.empty((tracks, TRACK_ROWS, room))[..., used]
