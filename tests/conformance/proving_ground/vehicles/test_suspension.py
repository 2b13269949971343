"""Laws of the freedoms on the response channels' clock: means over intervals, and the springs."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.channels import STANDARD_GRAVITY as G
from floatref.values.recording import Setup, TrackSetup
from floatref_conformance.proving_ground.drives.drive import Drive, Segment
from floatref_conformance.proving_ground.roads.road import Road, flat_road
from floatref_conformance.proving_ground.roads.sines import sines_road
from floatref_conformance.proving_ground.vehicles.corner_forces import SLIDE_M
from floatref_conformance.proving_ground.vehicles.full_car import ROLL, Vehicle
from floatref_conformance.proving_ground.vehicles.kinematics import Course
from floatref_conformance.proving_ground.vehicles.motion import drive_over
from floatref_conformance.proving_ground.vehicles.parameter_sets import (
    LOADED_VAN,
    VEHICLES,
    with_springs,
)
from floatref_conformance.proving_ground.vehicles.suspended import Suspended
from floatref_conformance.proving_ground.vehicles.suspension import SuspensionMotion

SETUP = Setup(tracks={"left": TrackSetup((-2.9, 0.86, 0.282))})
STRAIGHT = Course()
SLOWING = Drive(20.0, (Segment(0.5), Segment(1.5, -3.0), Segment(0.5)))


def seen(
    rate_hz: float = 1000.0,
    road: Road | None = None,
    vehicle: Suspended = LOADED_VAN,
    recording_hz: float = 16000.0,
    course: Course = STRAIGHT,
    drive: Drive = SLOWING,
) -> SuspensionMotion:
    road = sines_road(60.0, 4) if road is None else road
    motion = drive_over(
        vehicle, road, course, drive, drive.duration_s, recording_hz, SETUP, rate_hz
    )
    assert motion.suspension is not None
    return motion.suspension


@pytest.mark.parametrize("recording_hz", [16000.0, 8000.0, 1000.0])
def test_five_means_make_the_mean_over_five_intervals(recording_hz: float) -> None:
    """No content is lost or folded: 200 Hz is 1000 Hz averaged, on a road with an edge."""
    x = np.arange(-20.0, 60.0, 0.005)
    step = Road(-20.0, 0.005, {"left": 0.02 * (x > 15.0)}, {"left": 0.0})
    fast = seen(1000.0, step, recording_hz=recording_hz).acceleration
    slow = seen(200.0, step, recording_hz=recording_hz).acceleration
    means = np.lib.stride_tricks.sliding_window_view(fast, 5, axis=1).mean(axis=2)
    inner = slice(1, slow.shape[1] - 1)
    assert np.ptp(slow[3]) > 50.0
    assert means[:, 3::5][:, : slow.shape[1] - 2] == pytest.approx(slow[:, inner], abs=1e-9)


def test_acceleration_is_the_second_difference_of_position() -> None:
    """Whose weights are a triangle: means of 1, 6 and 1 eighths, on smooth waves."""
    motion = seen(drive=Drive(20.0, (Segment(2.5),)))
    twice = np.diff(motion.position[:, 1:-1], 2, axis=1) * 1000.0**2
    before, at, after = (motion.acceleration[:, 1 + k : k - 3 or None] for k in range(3))
    mean = (before + 6 * at + after) / 8
    largest = np.abs(mean).max(axis=1)
    assert (largest[3:] > 0.1).all()
    assert np.all(np.abs(twice - mean).max(axis=1) < 2e-3 * np.maximum(largest, 0.1))


def test_a_rate_that_does_not_divide_the_models_sees_the_same_drive() -> None:
    whole, odd = seen(1000.0), seen(999.0)
    times = odd.clock.times(odd.position.shape[1])
    for row in range(7):
        at = np.interp(times, whole.clock.times(whole.position.shape[1]), whole.position[row])
        assert np.abs(at - odd.position[row]).max() < 1e-3 * np.abs(at).max() + 1e-9
    assert odd.position[3].std() > 1e-4


@pytest.mark.parametrize("name", ["loaded-van", "soft-van", "pickup"])
def test_each_front_wheel_obeys_its_own_equation_of_motion(name: str) -> None:
    """m·z'' is the sum of spring, damper, anti-roll bar and tyre."""
    vehicle = VEHICLES[name]
    assert isinstance(vehicle, Vehicle)
    drive = Drive(20.0, (Segment(2.5),))
    motion, front = seen(vehicle=vehicle, drive=drive), vehicle.front
    travel = [vehicle.gauges(y).deflections["suspension_deflection"] for y in (0.8, -0.8)]
    for wheel, (own, other) in enumerate((travel, travel[::-1])):
        force = front.spring * own @ motion.position + front.damper * own @ motion.velocity
        force += front.anti_roll * (own - other) @ motion.position
        force += front.tyre * (motion.road[wheel] - motion.position[3 + wheel])
        inertia = front.wheel_kg * motion.acceleration[3 + wheel]
        assert np.abs(inertia).max() > 20.0
        error = np.abs(force - inertia)[1:-1]
        assert error.max() < 1e-3 * np.abs(inertia).max()


def test_a_wheel_feels_the_friction_and_the_stiffening_of_its_spring() -> None:
    """m·z'' has k·p·d³ and the force that rubs, followed along the travel by a plain loop."""
    vehicle = with_springs(LOADED_VAN, 2500.0, 1000.0)
    drive = Drive(20.0, (Segment(2.5),))
    motion, front = seen(vehicle=vehicle, drive=drive), vehicle.front
    own, other = (vehicle.gauges(y).deflections["suspension_deflection"] for y in (0.8, -0.8))
    travel = own @ motion.position
    rubbing, rubs = np.zeros(travel.size), 0.0
    for k, moved in enumerate(np.diff(travel), 1):
        limit = front.friction * np.sign(moved)
        rubs = limit + (rubs - limit) * np.exp(-abs(moved) / SLIDE_M)
        rubbing[k] = rubs
    force = front.spring * travel * (1 + 1000.0 * travel**2) + front.damper * own @ motion.velocity
    force += front.anti_roll * (own - other) @ motion.position
    force += front.tyre * (motion.road[0] - motion.position[3])
    inertia = front.wheel_kg * motion.acceleration[3]
    off = np.abs(force + rubbing - inertia)[1:-1].max()
    assert off < 1e-2 * np.abs(inertia).max()
    assert np.abs(force - inertia)[1:-1].max() > 10 * off


def test_wheels_meet_the_road_one_after_the_other() -> None:
    """The rear wheels' road is the front wheels' a wheelbase later."""
    drive = Drive(20.0, (Segment(2.5),))
    motion = seen(road=sines_road(60.0, 9), drive=drive)
    times = motion.clock.times(motion.road.shape[1])
    late = np.interp(times - LOADED_VAN.wheelbase_m / 20.0, times, motion.road[0])
    started = times > LOADED_VAN.wheelbase_m / 20.0
    assert np.abs(motion.road[0]).max() > 1e-3
    assert motion.road[2][started] == pytest.approx(late[started], abs=1e-5)


@pytest.mark.slow
@settings(deadline=None, max_examples=10)
@given(grade=st.floats(-0.1, 0.1), cross=st.floats(-0.08, 0.08), curvature=st.floats(-0.01, 0.01))
def test_lane_force_is_gravity_and_what_the_drive_adds(
    grade: float, cross: float, curvature: float
) -> None:
    """Its square is g² + a² + (κ·v²)² but for products; on a level straight it is (a, 0, g)."""
    drive = Drive(15.0, (Segment(1.0, -2.0),))
    course = Course(grade, cross, curvature)
    motion = seen(road=flat_road(40.0), drive=drive, course=course, recording_hz=1000.0)
    speed = 15.0 - 2.0 * motion.clock.times(motion.lane.shape[1])
    up = np.array(course.up)[:, None]
    turn = curvature * np.cross(up.T, [[1.0, 0.0, 0.0]]).T * speed**2
    wanted = G * up + turn + np.array([[-2.0], [0.0], [0.0]])
    assert motion.lane == pytest.approx(wanted, rel=1e-3, abs=2e-3)


def test_cornering_rolls_the_tilt_that_gauges_feel() -> None:
    course = Course(curvature_per_m=0.005)
    motion = seen(road=flat_road(60.0), course=course, drive=Drive(20.0, (Segment(2.0),)))
    assert np.array_equal(motion.tilt()[1], motion.position[ROLL])
    assert motion.tilt()[1][-1] > np.radians(0.5)
