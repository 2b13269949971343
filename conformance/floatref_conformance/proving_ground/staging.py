"""What a scenario stands for: its road, its drive, its course and its sensors' places."""

from collections.abc import Callable, Mapping
from math import atan
from types import MappingProxyType

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Setup, TrackSetup
from floatref_conformance.proving_ground import manoeuvres
from floatref_conformance.proving_ground.drive import Drive
from floatref_conformance.proving_ground.iso8608 import iso8608_road
from floatref_conformance.proving_ground.kinematics import Course
from floatref_conformance.proving_ground.measured import (
    SHIPPED_INTERVAL_M,
    measured_road,
    shipped_profile,
)
from floatref_conformance.proving_ground.road import FULL_FROM_M, Road, flat_road
from floatref_conformance.proving_ground.runs import KMH, RUNS, run_drive
from floatref_conformance.proving_ground.sayers import sayers_road
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.sensors import SensorSuite
from floatref_conformance.proving_ground.shaping import scaled_to, with_bump
from floatref_conformance.proving_ground.vehicle import Vehicle

BUMP_LENGTH_M = 3.0
SCALED_OVER_M = 100.0
"""A road is made long enough to have an IRI over this length, however short the drive."""


def road_of(scenario: Scenario, length_m: float) -> Road:
    """Return the scenario's road, usable up to ``length_m`` or more, scaled and with its bump."""
    length_m = max(length_m, FULL_FROM_M + SCALED_OVER_M)
    kind, _, which = scenario.road.partition("-")
    if kind == "flat":
        road = flat_road(length_m, tracks=scenario.tracks)
    elif kind == "measured":
        road = measured_road(
            shipped_profile(), SHIPPED_INTERVAL_M, length_m, scenario.seed, tracks=scenario.tracks
        )
    elif kind == "iso":
        road = iso8608_road(which, length_m, scenario.seed, tracks=scenario.tracks)
    else:
        road = sayers_road(which, length_m, scenario.seed, tracks=scenario.tracks)
    if kind != "flat" and scenario.iri_m_per_km > 0:
        road = scaled_to(road, scenario.iri_m_per_km)
    if scenario.bump_mm:
        road = with_bump(road, scenario.bump_at_m, BUMP_LENGTH_M, scenario.bump_mm / 1000)
    return road


def drive_of(scenario: Scenario) -> Drive:
    """Return the scenario's drive; InputError where its numbers do not fit together."""
    if scenario.manoeuvre in RUNS:
        return run_drive(scenario.manoeuvre)
    return _DRIVES[scenario.manoeuvre](scenario)


def course_of(scenario: Scenario) -> Course:
    """Return slopes and curvature of the scenario's lane."""
    return Course(
        atan(scenario.grade_percent / 100),
        atan(scenario.cross_slope_percent / 100),
        scenario.curvature_per_km / 1000,
    )


def suite_of(scenario: Scenario) -> SensorSuite:
    """Return the scenario's sensors; a factor of 0 is the ideal suite."""
    if scenario.sensors == 0:
        return SensorSuite.ideal()
    return SensorSuite().scaled(scenario.sensors)


def setup_of(scenario: Scenario, vehicle: Vehicle, lateral_m: Mapping[str, float]) -> Setup:
    """Return where the sensors sit: above the wheel paths, from the point below the CG."""
    tracks = {
        name: TrackSetup((vehicle.sensor_x_m, lateral_m[name], vehicle.sensor_z_m))
        for name in scenario.tracks
    }
    return Setup(scenario.profile_interval_m, vehicle.antenna_m, tracks)


def _braking(s: Scenario) -> Drive:
    return manoeuvres.braking(
        s.speed_kmh * KMH,
        s.event_speed_kmh * KMH,
        s.deceleration_g * STANDARD_GRAVITY,
        s.event_at_m,
        s.length_m,
    )


def _coasting(s: Scenario) -> Drive:
    drag = s.deceleration_g * STANDARD_GRAVITY
    return manoeuvres.coasting(
        s.speed_kmh * KMH, s.final_speed_kmh * KMH, s.event_at_m, s.length_m, drag
    )


def _throttle(s: Scenario) -> Drive:
    gain = s.deceleration_g * STANDARD_GRAVITY
    return manoeuvres.throttle(
        s.speed_kmh * KMH, s.final_speed_kmh * KMH, s.event_at_m, s.length_m, gain
    )


def _stop(s: Scenario) -> Drive:
    return manoeuvres.stop(
        s.speed_kmh * KMH,
        s.deceleration_g * STANDARD_GRAVITY,
        s.event_at_m,
        s.dwell_s,
        s.final_speed_kmh * KMH,
        s.length_m,
    )


def _near_stop(s: Scenario) -> Drive:
    return manoeuvres.near_stop(
        s.speed_kmh * KMH,
        s.event_speed_kmh * KMH,
        s.deceleration_g * STANDARD_GRAVITY,
        s.event_at_m,
        s.dwell_s,
        s.final_speed_kmh * KMH,
        s.length_m,
    )


_DRIVES: Mapping[str, Callable[[Scenario], Drive]] = MappingProxyType(
    {
        "constant": lambda s: manoeuvres.constant(s.speed_kmh * KMH, s.length_m),
        "coasting": _coasting,
        "throttle": _throttle,
        "braking": _braking,
        "near-stop": _near_stop,
        "stop": _stop,
        "dead-start": lambda s: manoeuvres.dead_start(
            s.dwell_s, s.final_speed_kmh * KMH, s.length_m
        ),
        "creeping": lambda s: manoeuvres.creeping(
            s.speed_kmh * KMH, s.event_speed_kmh * KMH, s.length_m
        ),
    }
)
