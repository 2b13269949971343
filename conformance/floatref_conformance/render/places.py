"""Where things lie along the drive of a scenario: its speed, its events, what is scored."""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.artificial import SIMULATED_SPEED, Bounce, artificial_drive
from floatref_conformance.proving_ground.drive import Drive
from floatref_conformance.proving_ground.parked import plates_of
from floatref_conformance.proving_ground.runs import KMH, RUNS, SECTION_START_M
from floatref_conformance.proving_ground.scenario import STATIONARY, Scenario
from floatref_conformance.proving_ground.staging import BUMP_LENGTH_M, drive_of

BEFORE_EVENT_M, BEHIND_EVENT_M = 96.0, 64.9
"""The 160.9 m (0.1 mile) that are scored lie so far before and behind an event."""
EVENTS = {
    "braking": "brake released",
    "near-stop": "brake released",
    "stop": "stop",
    "coasting": "coasting begins",
    "throttle": "throttle begins",
    "dead-start": "start from rest",
}
"""What happens at the event of each manoeuvre."""
WITHOUT_EVENT_M = ((490.0, 220.0), (400.0, 130.0))
"""Shortest recordings, and where the scored stretch of one without an event starts, in m."""
INSTANTS = 4000


@dataclass(frozen=True)
class Place:
    """A stretch of distance with a name, in m; a point where ``end_m`` is ``start_m``."""

    start_m: float
    end_m: float
    name: str


def is_parked(scenario: Scenario) -> bool:
    """Return whether the vehicle stands while an artificial encoder tells a speed."""
    return scenario.manoeuvre in STATIONARY


def driven(scenario: Scenario) -> Drive:
    """Return what the wheel does, or what the artificial encoder tells."""
    if is_parked(scenario):
        return artificial_drive(scenario.speed_kmh * KMH)
    return drive_of(scenario)


def speed_along(scenario: Scenario) -> tuple[FloatArray, FloatArray]:
    """Return distance in m and speed in km/h at many instants, those of every jolt included."""
    drive = driven(scenario)
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


def bounced(scenario: Scenario) -> Place | None:
    """Return the simulated distance over which the body of a parked vehicle is pushed."""
    if scenario.manoeuvre != "bounce":
        return None
    push = Bounce()
    speed = scenario.speed_kmh * KMH or SIMULATED_SPEED
    start, end = push.start_s * speed, (push.start_s + push.duration_s) * speed
    return Place(start, end, "body pushed up and down")


def scored(scenario: Scenario) -> Place | None:
    """Return the 160.9 m that are scored as a whole; None for a manoeuvre that has none."""
    if is_parked(scenario) or scenario.manoeuvre == "dead-start":
        return None
    happens = events(scenario)
    length = driven(scenario).length_m
    if happens:
        start = happens[0].start_m - BEFORE_EVENT_M
    else:
        starts = [start for shortest, start in WITHOUT_EVENT_M if length >= shortest]
        if not starts:
            return None
        start = starts[0]
    return Place(start, start + BEFORE_EVENT_M + BEHIND_EVENT_M, "scored whole")


def _event_m(scenario: Scenario) -> float:
    """Return the distance of the event; that of a published run is the run's own."""
    if scenario.manoeuvre in RUNS:
        return SECTION_START_M + (RUNS[scenario.manoeuvre].event_location_m or 0.0)
    return scenario.event_at_m
