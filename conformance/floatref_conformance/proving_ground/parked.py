"""Stationary tests: the closed-form body of a parked vehicle under the whole sensor chain."""

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Setup, TrackSetup
from floatref_conformance.proving_ground.artificial import (
    Bounce,
    Plate,
    Stationary,
    artificial_drive,
)
from floatref_conformance.proving_ground.kinematics import Course, Sighted
from floatref_conformance.proving_ground.motion import BodyMotion, empty_rows
from floatref_conformance.proving_ground.road import flat_road
from floatref_conformance.proving_ground.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import setup_of
from floatref_conformance.proving_ground.vehicles import vehicle_called


def parked(scenario: Scenario, plate: Plate | None = None) -> tuple[BodyMotion, Setup]:
    """Return the motion of a quiescent or bounce test and where its sensors sit.

    Distance and speed are the artificial encoder's. The body pitches and rolls about the
    middle of the reference points, whose height the closed form gives. The floor is level;
    ``plate`` (default: 5 mm) lies under every laser over its stretch of that distance.
    """
    plate = Plate() if plate is None else plate
    vehicle = vehicle_called(scenario.vehicle)
    floor = flat_road(1.0, tracks=scenario.tracks)
    setup = setup_of(scenario, vehicle, floor.lateral_m)
    drive = artificial_drive(scenario.speed_kmh * KMH)
    clock = UniformClock.of(scenario.rate_hz)
    count = int(drive.duration_s * scenario.rate_hz) + 1
    travel, shared, tracks = empty_rows(len(scenario.tracks), count)
    told = drive.motion(clock.times(count))
    travel[:] = told.distance, told.speed, told.acceleration
    bounce = Bounce() if scenario.manoeuvre == "bounce" else None
    above = [TrackSetup((0.0, floor.lateral_m[name], vehicle.sensor_z_m)) for name in setup.tracks]
    seen = Sighted.of(Course(), floor, above, vehicle.sensor_z_m)
    seen.carry(_rows(Stationary(bounce), clock.times(count)), travel, tracks, shared)
    for rows in tracks:
        _lay(plate, rows, travel[0], shared)
    named = dict(zip(setup.tracks, tracks, strict=True))
    return BodyMotion.of(clock, travel, shared, named), setup


def _rows(body: Stationary, times: FloatArray) -> FloatArray:
    """Return the closed form in the rows of `kernels.at_points`, shape (9, n)."""
    b = body.body(times)
    return np.stack(
        [
            *(b.height, b.pitch, b.roll),
            *(b.velocity, b.pitch_rate, b.roll_rate),
            *(b.acceleration, b.pitch_acceleration, b.roll_acceleration),
        ]
    )


def _lay(plate: Plate, rows: FloatArray, distance: FloatArray, shared: FloatArray) -> None:
    """Put the plate between floor and laser, in place; (2.18) for the tilted beam."""
    from floatref_conformance.proving_ground.kernels import PITCH_ANGLE, RANGE, ROAD, ROLL_ANGLE

    thickness = plate.elevation(distance)
    rows[ROAD] += thickness
    rows[RANGE] -= thickness / (np.cos(shared[PITCH_ANGLE]) * np.cos(shared[ROLL_ANGLE]))
