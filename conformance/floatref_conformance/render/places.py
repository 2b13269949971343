"""Where things lie along the drive of a scenario: its speed, its events, its bumps."""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.checks.stretches import Stretches
from floatref_conformance.proving_ground.drives.artificial import (
    SIMULATED_SPEED,
    Bounce,
    artificial_drive,
)
from floatref_conformance.proving_ground.drives.drive import Drive
from floatref_conformance.proving_ground.drives.runs import KMH, RUNS, SECTION_START_M
from floatref_conformance.proving_ground.parked import plates_of
from floatref_conformance.proving_ground.scenario import STATIONARY, Scenario
from floatref_conformance.proving_ground.staging import BUMP_LENGTH_M, drive_of

EVENTS = {
    "braking": "brake released",
    "near-stop": "brake released",
    "stop": "stop",
    "coasting": "coasting begins",
    "throttle": "throttle begins",
    "dead-start": "start from rest",
}
"""What happens at the event of each manoeuvre."""
INSTANTS = 4000


@dataclass(frozen=True)
class Place:
    """A stretch of distance with a name, in m; a point where ``end_m`` is ``start_m``."""

    start_m: float
    end_m: float
    name: str


def is_parked(scenario: Scenario) -> bool:
    """Return whether the vehicle is stationary while an artificial encoder gives a speed."""
    return scenario.manoeuvre in STATIONARY


def drive_shown(scenario: Scenario) -> Drive:
    """Return the drive of the wheel, or that of the artificial encoder."""
    if is_parked(scenario):
        return artificial_drive(scenario.speed_kmh * KMH)
    return drive_of(scenario)


def speed_along(scenario: Scenario) -> tuple[FloatArray, FloatArray]:
    """Return distance in m and speed in km/h at many instants, those of every jolt included."""
    drive = drive_shown(scenario)
    even = np.linspace(0.0, drive.duration_s, INSTANTS)
    motion = drive.motion(np.union1d(even, drive.knot_times_s))
    return motion.distance, motion.speed / KMH


def events(scenario: Scenario) -> tuple[Place, ...]:
    """Return the points where something happens; every standstill is one."""
    kind = RUNS[scenario.manoeuvre].kind if scenario.manoeuvre in RUNS else scenario.manoeuvre
    name = EVENTS.get(kind)
    if name is None:
        return ()
    if kind == "stop":
        drive = drive_of(scenario)
        stood = drive.knot_distances_m[(drive.knot_speeds_mps == 0) & (drive.knot_distances_m > 0)]
        return tuple(Place(float(at), float(at), name) for at in np.unique(stood.round(2)))
    at = 0.0 if kind == "dead-start" else _event_m(scenario)
    return (Place(at, at, name),)


def bumps(scenario: Scenario) -> tuple[Place, ...]:
    """Return where the road has a bump of known height, or the floor its plates."""
    if is_parked(scenario):
        return tuple(
            Place(plate.start_m, plate.start_m + plate.length_m, f"plate, {track}")
            for track, plate in plates_of(scenario).items()
        )
    if not scenario.bump_mm:
        return ()
    start = scenario.bump_at_m - BUMP_LENGTH_M / 2
    return (Place(start, start + BUMP_LENGTH_M, f"bump of {scenario.bump_mm:g} mm"),)


def bounce_place(scenario: Scenario) -> Place | None:
    """Return the simulated distance over which the body of a parked vehicle is pushed."""
    if scenario.manoeuvre != "bounce":
        return None
    push = Bounce()
    speed = scenario.speed_kmh * KMH or SIMULATED_SPEED
    start, end = push.start_s * speed, (push.start_s + push.duration_s) * speed
    return Place(start, end, "body pushed up and down")


def join_stretches(stretches: Stretches) -> Stretches:
    """Return ``stretches`` in order, those that overlap or touch as one."""
    apart: list[tuple[float, float]] = []
    for start, end in sorted(stretches):
        if apart and start <= apart[-1][1]:
            apart[-1] = apart[-1][0], max(apart[-1][1], end)
        else:
            apart.append((start, end))
    return tuple(apart)


def _event_m(scenario: Scenario) -> float:
    """Return the distance of the event; that of a published run is the run's own."""
    if scenario.manoeuvre in RUNS:
        return SECTION_START_M + (RUNS[scenario.manoeuvre].event_location_m or 0.0)
    return scenario.event_at_m
