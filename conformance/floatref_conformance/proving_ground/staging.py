"""What a scenario stands for: its road, its drive, its course and its sensors' places."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import atan
from types import MappingProxyType

from floatref.errors import InputError
from floatref.files.sources import name_errors
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Setup, TrackSetup
from floatref_conformance.proving_ground.drives import manoeuvres
from floatref_conformance.proving_ground.drives.drive import Drive
from floatref_conformance.proving_ground.drives.runs import KMH, RUNS, run_drive
from floatref_conformance.proving_ground.roads.alignment import (
    Alignment,
    Crown,
    GradeBreak,
)
from floatref_conformance.proving_ground.roads.distress import with_joints, with_patches
from floatref_conformance.proving_ground.roads.files import file_of, road_from
from floatref_conformance.proving_ground.roads.measured import (
    SHIPPED_INTERVAL_M,
    measured_road,
    shipped_profile,
)
from floatref_conformance.proving_ground.roads.random_roads import iso8608_road, sayers_road
from floatref_conformance.proving_ground.roads.road import FULL_FROM_M, Road, flat_road
from floatref_conformance.proving_ground.roads.shaping import (
    scale_by,
    scale_factor,
    with_alignment,
    with_bump,
)
from floatref_conformance.proving_ground.roads.sines import sines_road
from floatref_conformance.proving_ground.scenario import STATIONARY, Scenario
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.tracking import Ground, follow_line
from floatref_conformance.proving_ground.vehicles.kinematics import Course
from floatref_conformance.proving_ground.vehicles.parameter_sets import find_vehicle
from floatref_conformance.proving_ground.vehicles.response import count_steps
from floatref_conformance.proving_ground.vehicles.suspended import Suspended, axles_of

BUMP_LENGTH_M = 3.0
SCALED_OVER_M = 100.0
"""A road is made long enough to have an IRI over this length, however short the drive."""
MOST_SAMPLES = 2**26
"""Most samples of the true motion, over all wheel paths: 4 GiB."""


def road_of(scenario: Scenario, length_m: float) -> Road:
    """Return the scenario's road under the tyres, as `ground_of` does."""
    return ground_of(scenario, length_m).rolled


def ground_of(scenario: Scenario, length_m: float) -> Ground:
    """Return the scenario's ground, usable up to ``length_m`` or more, scaled and with its bump.

    It is scaled by its wheel paths, whatever line the vehicle takes. Bump, joints, patches,
    crown and break are as wide as the road, so that a line laser reads them as a point does.
    """
    length_m = max(length_m, FULL_FROM_M + SCALED_OVER_M)
    kind, _, which = scenario.road.partition("-")
    seed = scenario.seed if scenario.road_seed < 0 else scenario.road_seed
    path = file_of(scenario.road)
    if path is not None:
        road = road_from(path, length_m, scenario.tracks)
    elif kind == "flat":
        road = flat_road(length_m, tracks=scenario.tracks)
    elif kind == "measured":
        road = measured_road(
            shipped_profile(), SHIPPED_INTERVAL_M, length_m, seed, tracks=scenario.tracks
        )
    elif kind == "sines":
        road = sines_road(length_m, seed, tracks=scenario.tracks)
    elif kind == "iso":
        road = iso8608_road(which, length_m, seed, tracks=scenario.tracks)
    else:
        road = sayers_road(which, length_m, seed, tracks=scenario.tracks)
    factor = 1.0
    if kind != "flat" and scenario.iri_m_per_km > 0:
        factor = scale_factor(road, scenario.iri_m_per_km)
        road = scale_by(road, factor)
    rolled, read = follow_line(scenario, road, length_m, seed, factor)
    shaped = _with_features(scenario, rolled, seed)
    return Ground(shaped, shaped if read is rolled else _with_features(scenario, read, seed))


def _with_features(scenario: Scenario, road: Road, seed: int) -> Road:
    """Return the road with its bump, its joints and patches, and its alignment."""
    if scenario.bump_mm:
        road = with_bump(road, scenario.bump_at_m, BUMP_LENGTH_M, scenario.bump_mm / 1000)
    road = _with_distress(scenario, road, seed)
    alignment = alignment_of(scenario)
    return with_alignment(road, alignment) if alignment.features else road


def alignment_of(scenario: Scenario) -> Alignment:
    """Return the crown and the break of grade of the scenario's road.

    Raises InputError for one that begins behind the end of the drive.
    """
    s, features = scenario, dict[str, Crown | GradeBreak]()
    if s.crown_mm:
        features["crown_at_m"] = Crown(s.crown_at_m, s.crown_length_m, s.crown_mm / 1000)
    if s.break_percent:
        features["break_at_m"] = GradeBreak(s.break_at_m, s.break_length_m, s.break_percent / 100)
    for name, each in features.items():
        if each.centre_m - each.length_m / 2 >= s.length_m:
            raise InputError(f"{name} is {each.centre_m:g}; the drive ends at {s.length_m:g} m")
    return Alignment(tuple(features.values()))


def _with_distress(s: Scenario, road: Road, seed: int) -> Road:
    if s.joint_mm:
        road = with_joints(road, s.joint_spacing_m, s.joint_mm / 1000, seed)
    if s.patch_mm and s.patches_per_km:
        road = with_patches(road, s.patches_per_km, s.patch_mm / 1000, seed)
    return road


def drive_of(scenario: Scenario) -> Drive:
    """Return the scenario's drive.

    Raises InputError where its numbers do not fit together or need more than `MOST_SAMPLES`.
    """
    if scenario.manoeuvre in STATIONARY:
        raise InputError(f"manoeuvre {scenario.manoeuvre}: the vehicle is parked, not driven")
    if scenario.manoeuvre in RUNS:
        drive = run_drive(scenario.manoeuvre)
    else:
        with name_errors(f"manoeuvre {scenario.manoeuvre}"):
            drive = _DRIVES[scenario.manoeuvre](scenario)
    _check_samples(scenario, drive.duration_s)
    return drive


def course_of(scenario: Scenario) -> Course:
    """Return slopes and curvature of the scenario's lane."""
    return Course(
        atan(scenario.grade_percent / 100),
        atan(scenario.cross_slope_percent / 100),
        scenario.curvature_per_km / 1000,
    )


def vehicle_of(scenario: Scenario) -> Suspended:
    """Return the scenario's vehicle, with friction and progressive springs if it has them."""
    return find_vehicle(scenario.vehicle, scenario.friction_nm, scenario.progression_per_m2)


def suite_of(scenario: Scenario) -> SensorSuite:
    """Return the scenario's sensors; a factor of 0 is the ideal suite."""
    suite = SensorSuite.ideal() if scenario.sensors == 0 else SensorSuite()
    return replace(
        suite.scale(scenario.sensors),
        slip_per_g=scenario.sensors * scenario.slip_percent_per_g / 100,
        encoder_error=scenario.encoder_error_percent / 100,
        radius_growth=scenario.sensors * scenario.radius_percent / 100,
        radius_warming=scenario.sensors * scenario.warming_percent / 100,
        range_latency_s=scenario.latency_ms / 1000,
        gyro_rate_hz=scenario.gyro_rate_hz,
    )


def setup_of(scenario: Scenario, vehicle: Suspended, lateral_m: Mapping[str, float]) -> Setup:
    """Return where sensors and axles are: above the wheel paths, from the point below the CG."""
    tracks = {
        name: TrackSetup(
            (vehicle.sensor_x_m, lateral_m[name], vehicle.sensor_z_m),
            (scenario.laser_ahead_m, 0.0, 0.0),
        )
        for name in scenario.tracks
    }
    return Setup(scenario.profile_interval_m, vehicle.antenna_m, tracks, axles=axles_of(vehicle))


def _check_samples(s: Scenario, duration_s: float) -> None:
    """Raise InputError for a drive too long to be kept in memory at the rate asked for."""
    rate_hz = s.rate_hz * count_steps(s.rate_hz)
    if not duration_s * rate_hz * len(s.tracks) <= MOST_SAMPLES:
        raise InputError(
            f"length_m {s.length_m:g} takes {duration_s:.4g} s, which at {rate_hz:g} steps/s on "
            f"{len(s.tracks)} tracks is above {MOST_SAMPLES} samples; "
            "shorten length_m or dwell_s, raise the speeds or lower rate_hz"
        )


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
    return manoeuvres.stops(
        s.speed_kmh * KMH,
        s.deceleration_g * STANDARD_GRAVITY,
        [s.event_at_m + n * s.stop_spacing_m for n in range(s.stops)],
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


def _creeping(s: Scenario) -> Drive:
    slowest, fastest = s.speed_kmh * KMH, s.event_speed_kmh * KMH
    if 0 < slowest < fastest:
        _check_samples(s, s.length_m / fastest)
    return manoeuvres.creeping(slowest, fastest, s.length_m)


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
        "creeping": _creeping,
    }
)
