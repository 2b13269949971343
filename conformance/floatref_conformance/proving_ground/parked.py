"""Stationary tests: the closed-form body of a parked vehicle under the whole sensor chain."""

from collections.abc import Mapping

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Setup, TrackSetup
from floatref_conformance.proving_ground.drives.artificial import (
    Bounce,
    Plate,
    Stationary,
    artificial_drive,
)
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.roads.road import flat_road
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.sensors.noise import stream
from floatref_conformance.proving_ground.staging import setup_of
from floatref_conformance.proving_ground.vehicles.kinematics import Course, Sighted
from floatref_conformance.proving_ground.vehicles.motion import (
    BodyMotion,
    empty_rows,
    stretches,
)
from floatref_conformance.proving_ground.vehicles.parameter_sets import find_vehicle

FIRST_START_M, LAST_START_M = 455.0, 525.0
"""Between these a plate starts: a high-pass wavelength, 91.44 m, beyond the first 360.9 m of
the run, and with the ground behind it outside the last 106 m of 640 m."""
SHORTEST_M, LONGEST_M = 2.0, 4.0
"""Lengths between which a plate's is drawn."""
APART_M = 10.0
"""Least difference of two plates' starts: no plate lies beside another on the same distance."""


def plates_of(scenario: Scenario) -> Mapping[str, Plate]:
    """Return the 5-mm plate of every wheel path, its place and length drawn from the seed.

    The starts differ by `APART_M` or more, or by equal shares of the room if it is too small
    for that; which wheel path comes first is drawn too. All are whole centimetres.
    """
    rng = stream(scenario.seed, "plates")
    count = len(scenario.tracks)
    room = LAST_START_M - FIRST_START_M
    apart = min(APART_M, room / count)
    free = np.sort(rng.uniform(0.0, room - (count - 1) * apart, count))
    starts = rng.permutation(FIRST_START_M + free + apart * np.arange(count))
    lengths = rng.uniform(SHORTEST_M, LONGEST_M, count)
    return {
        name: Plate(round(float(start), 2), round(float(length), 2))
        for name, start, length in zip(scenario.tracks, starts, lengths, strict=True)
    }


def park(scenario: Scenario) -> tuple[BodyMotion, Setup]:
    """Return the motion of a quiescent or bounce test and where its sensors sit.

    Distance and speed are the artificial encoder's. The body pitches and rolls about the
    middle of the reference points, whose height the closed form gives. The floor is level;
    under each laser its wheel path's plate of `plates_of` lies over a stretch of that distance.
    """
    vehicle = find_vehicle(scenario.vehicle)
    floor = flat_road(1.0, tracks=scenario.tracks)
    setup = setup_of(scenario, vehicle, floor.lateral_m)
    drive = artificial_drive(scenario.speed_kmh * KMH)
    clock = UniformClock.of(scenario.rate_hz)
    count = int(drive.duration_s * scenario.rate_hz) + 1
    travel, shared, tracks = empty_rows(len(scenario.tracks), count)
    body = Stationary(Bounce() if scenario.manoeuvre == "bounce" else None)
    above = [TrackSetup((0.0, floor.lateral_m[name], vehicle.sensor_z_m)) for name in setup.tracks]
    seen = Sighted.of(Course(), floor, above, vehicle.sensor_z_m)
    for first, last in stretches(count):
        part, times = slice(first, last), clock.times(last - first, first)
        motion = drive.motion(times)
        travel[:, part] = motion.distance, motion.speed, motion.acceleration
        seen.carry(_rows(body, times), travel[:, part], tracks[:, :, part], shared[:, part])
    named = dict(zip(setup.tracks, tracks, strict=True))
    for name, plate in plates_of(scenario).items():
        _lay(plate, named[name], travel[0], shared)
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
