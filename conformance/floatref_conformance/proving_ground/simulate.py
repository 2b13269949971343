"""From a scenario to a recording and the truth behind it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from importlib.metadata import version

import numpy as np

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.proving_ground.parked import park
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.roads.wander import STRAIGHT, Line
from floatref_conformance.proving_ground.scenario import STATIONARY, Scenario
from floatref_conformance.proving_ground.sensors.chain import Chain, VerticalError
from floatref_conformance.proving_ground.sensors.gauging import as_installed, response_channels
from floatref_conformance.proving_ground.sensors.odometry import (
    optical_distance,
    wheel_encoders,
    wheel_speed,
)
from floatref_conformance.proving_ground.sensors.satellite import gnss_channels, gnss_speed
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.staging import (
    course_of,
    drive_of,
    ground_of,
    setup_of,
    suite_of,
    vehicle_of,
)
from floatref_conformance.proving_ground.tracking import Ground, line_of, read_beside
from floatref_conformance.proving_ground.vehicles.motion import BodyMotion, drive_over


@dataclass(frozen=True, eq=False)
class Simulation:
    """A recording and what it should have measured.

    Attributes:
        recording: what the sensors delivered.
        truth: unfiltered elevation along the laser's footprint against true distance, at the
            setup's profile interval. Of a line laser it is the bridged height of the line, one
            height of what the footprint covers; the tyres roll on the line's middle.
        motion: the true motion.
        errors: the slow errors of the vertical accelerometers, by wheel path.
    """

    recording: Recording
    truth: Profile
    motion: BodyMotion
    errors: Mapping[str, VerticalError]


def simulate(
    scenario: Scenario, road: Road | Ground | None = None, suite: SensorSuite | None = None
) -> Simulation:
    """Simulate a scenario, on ``road`` and with ``suite`` in place of its own if given.

    A `Ground` gives the tyres and the lasers a road each.

    Raises InputError for numbers that do not make a drive, or a road without the scenario's
    wheel paths or too short for the drive.
    """
    suite = suite_of(scenario) if suite is None else suite
    if scenario.manoeuvre in STATIONARY:
        motion, setup = park(scenario)
        return _record(scenario, suite.idling(), motion, setup)
    drive, course = drive_of(scenario), course_of(scenario)
    vehicle = vehicle_of(scenario)
    # A vehicle on a road that is given keeps to its wheel paths.
    line = STRAIGHT if isinstance(road, Road) else line_of(scenario)
    ground = ground_of(scenario, drive.length_m) if road is None else _ground(scenario, road)
    road = ground.rolled
    _check_road(scenario, road, drive.length_m)
    known = as_installed(vehicle.make_setup(), suite.vehicle_error, scenario.seed)
    setup = replace(setup_of(scenario, vehicle, road.lateral_m), vehicle=known)
    kept = suite.response_rate_hz if scenario.response else None
    motion = drive_over(
        vehicle, road, course, drive, drive.duration_s, scenario.rate_hz, setup, kept, ground.read
    )
    return _record(scenario, suite, motion, setup, line)


def stationary(
    kind: str = "quiescent", seed: int = 0, rate_hz: float = 16000.0, speed_kmh: float = 72.0
) -> Simulation:
    """Simulate a parked vehicle with an artificial encoder and a 5-mm plate under the laser.

    ``kind`` is "quiescent" or "bounce"; the truth is flat but for the plate.
    """
    if kind not in STATIONARY:
        known = suggest(kind, STATIONARY, "choose from")
        raise InputError(f"stationary test {kind!r}: unknown; {known}")
    return simulate(Scenario(seed=seed, manoeuvre=kind, rate_hz=rate_hz, speed_kmh=speed_kmh))


def truth_of(motion: BodyMotion, interval_m: float) -> Profile:
    """Return the road under every laser at ``k * interval_m`` of true distance.

    Point k takes the first sample at or beyond it; where samples are wider apart than the
    interval, it lies between them, linear in distance.
    """
    distance = motion.distance
    points = interval_m * np.arange(int(distance[-1] / interval_m) + 1)
    points = points[points <= distance[-1]]
    after = np.searchsorted(distance, points)
    before = np.maximum(after - 1, 0)
    step = distance[after] - distance[before]
    wide = step > interval_m
    back = np.where(wide, (distance[after] - points) / np.where(wide, step, 1.0), 0.0)
    tracks = []
    for name, track in motion.tracks.items():
        z = track.road_m
        tracks.append(ProfileTrack.of(name, z[after] - back * (z[after] - z[before])))
    return Profile(interval_m, tuple(tracks), pipeline="truth")


def _record(
    scenario: Scenario,
    suite: SensorSuite,
    motion: BodyMotion,
    setup: Setup,
    line: Line = STRAIGHT,
) -> Simulation:
    """Return what the sensors make of a motion, and the truth."""
    chain = Chain(suite, scenario.seed, motion)
    channels, errors = [chain.distance()], {}
    shake = chain.shaking()
    for track in scenario.tracks:
        vertical, errors[track] = chain.vertical(track, shake)
        channels += [vertical, chain.height(track)]
        if scenario.imu:
            channels.append(chain.horizontal("longitudinal_specific_force", track))
            channels.append(chain.horizontal("lateral_specific_force", track))
    if scenario.imu:
        channels += chain.gyros()
    if scenario.gnss:
        standing = scenario.manoeuvre in STATIONARY
        channels += gnss_channels(chain, setup, course_of(scenario).curvature_per_m, standing, line)
    if motion.suspension is not None:
        channels += response_channels(suite, scenario.seed, motion.suspension, setup)
    channels += _more_distances(scenario, chain, setup)
    model = f"proving ground {version('floatref')}"
    recording = Recording(tuple(channels), setup, "floatref", model)
    return Simulation(recording, truth_of(motion, setup.profile_interval_m), motion, errors)


def _more_distances(scenario: Scenario, chain: Chain, setup: Setup) -> Iterator[Channel]:
    """Yield the encoders of both sides and the second source of distance, if they are recorded.

    A parked body turns about its reference points, another one about its centre of gravity.
    """
    standing = scenario.manoeuvre in STATIONARY
    course = course_of(scenario)
    if scenario.encoder_per_side:
        yield from wheel_encoders(chain, setup, 0.0 if standing else course.curvature_per_m)
    if scenario.second_distance == "gnss":
        vehicle, antenna = vehicle_of(scenario), setup.gnss_antenna_offset_m
        x, z = (vehicle.sensor_x_m, vehicle.sensor_z_m) if standing else (0.0, vehicle.cg_height_m)
        lever = (antenna[0] - x, antenna[1], antenna[2] - z)
        yield gnss_speed(chain, lever, course.grade_rad, standing)
    elif scenario.second_distance == "can":
        yield wheel_speed(chain, standing)
    elif scenario.second_distance == "optical":
        yield optical_distance(chain, standing)


def _ground(scenario: Scenario, road: Road | Ground) -> Ground:
    """Return the ground on a given road, which a vehicle follows without wander."""
    if isinstance(road, Ground):
        return road
    if scenario.laser_line_mm == 0:
        return Ground(road, road)
    seed = scenario.seed if scenario.road_seed < 0 else scenario.road_seed
    return read_beside(road, STRAIGHT, seed, scenario.laser_line_mm / 1000)


def _check_road(scenario: Scenario, road: Road, length_m: float) -> None:
    """Raise InputError unless the road has the wheel paths and the length."""
    missing = [name for name in scenario.tracks if name not in road.elevation]
    if missing:
        raise InputError(f"track {missing[0]}: the road has no such wheel path")
    if road.end_m < length_m:
        raise InputError(f"the road ends at {road.end_m:g} m, the drive at {length_m:g} m")
