"""Laws of the rigid body that carries the sensors: (2.17)-(2.20), footprint, slopes, turns."""

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY as G
from floatref.values.clock import UniformClock
from floatref.values.recording import Setup, TrackSetup
from floatref_conformance.proving_ground.drives.drive import Drive, Segment
from floatref_conformance.proving_ground.roads.random_roads import sayers_road
from floatref_conformance.proving_ground.roads.road import Road, flat_road
from floatref_conformance.proving_ground.vehicles.kinematics import Course, Sighted
from floatref_conformance.proving_ground.vehicles.motion import BodyMotion, drive_over, empty_rows
from floatref_conformance.proving_ground.vehicles.parameter_sets import LOADED_VAN, SOFT_VAN

RATE = 4000.0
CLOCK_COUNT = 2001
STRAIGHT = Course()
TRAPEZOID_ERRORS = [(16000.0, 2e-6, 2e-6), (1000.0, 4e-3, 2e-5)]
"""1 kHz does not resolve the jumps of the brake, but they must not make the height drift."""
BEHIND = TrackSetup((-2.9, 0.86, 0.28))


def waving(seed: int, count: int = CLOCK_COUNT) -> FloatArray:
    """Return heave, pitch and roll of sine waves with their derivatives, shape (9, n)."""
    rng = np.random.default_rng(seed)
    t = np.arange(count) / RATE
    rows = np.empty((9, count))
    for i, size in enumerate((0.05, 0.06, 0.05)):
        omega, phase = 2 * np.pi * rng.uniform(0.5, 3.0), rng.uniform(0, 2 * np.pi)
        rows[i] = size * np.sin(omega * t + phase)
        rows[3 + i] = size * omega * np.cos(omega * t + phase)
        rows[6 + i] = -size * omega**2 * np.sin(omega * t + phase)
    return rows


def travelling(seed: int, count: int = CLOCK_COUNT) -> FloatArray:
    """Return distance, speed and acceleration of a varying drive, shape (3, n)."""
    rng = np.random.default_rng(seed + 1)
    drive = Drive(rng.uniform(12, 25), (Segment(1.0, rng.uniform(-5, 5), rng.uniform(-8, 8)),))
    motion = drive.motion(np.arange(count) / RATE)
    return np.stack([motion.distance, motion.speed, motion.acceleration])


def carried(
    body: FloatArray,
    travel: FloatArray,
    course: Course = STRAIGHT,
    road: Road | None = None,
    point: TrackSetup = BEHIND,
    cg_height_m: float = 0.9,
) -> BodyMotion:
    road = flat_road(40.0) if road is None else road
    rest, shared, tracks = empty_rows(1, body.shape[1])
    rest[:] = travel
    Sighted.of(course, road, [point], cg_height_m).carry(body, rest, tracks, shared)
    return BodyMotion.of(UniformClock.of(RATE), rest, shared, {"left": tracks[0]})


courses = st.builds(Course, st.floats(-0.1, 0.1), st.floats(-0.08, 0.08), st.floats(-0.02, 0.02))
seeds = st.integers(0, 10**6)


@settings(deadline=None, max_examples=15)
@given(seed=seeds, course=courses)
def test_velocity_and_acceleration_are_derivatives_of_height(seed: int, course: Course) -> None:
    """By central differences, whose error is the third and fourth derivative's."""
    point = carried(waving(seed), travelling(seed), course).tracks["left"]
    dt = 1 / RATE
    slope = (point.height_m[2:] - point.height_m[:-2]) / (2 * dt)
    bend = (point.velocity[2:] - point.velocity[:-2]) / (2 * dt)
    assert np.abs(slope - point.velocity[1:-1]).max() < 2e-4
    assert np.abs(bend - point.acceleration[1:-1]).max() < 4e-3


@pytest.mark.slow
@pytest.mark.cites("(2.17)")
@settings(deadline=None, max_examples=15)
@given(seed=seeds)
def test_centre_of_gravity_feels_the_equations_of_the_text(seed: int) -> None:
    """(2.17) with the 1 g kept, on a level straight: a_y = 0 and a_z is the heave's."""
    body, travel = waving(seed), travelling(seed)
    centre = TrackSetup((0.0, 0.0, 0.9))
    point = carried(body, travel, point=centre).tracks["left"]
    st_, ct, sp, cp = np.sin(body[1]), np.cos(body[1]), np.sin(body[2]), np.cos(body[2])
    a_x, lifted = travel[2], body[6] + G
    assert point.longitudinal == pytest.approx(a_x * ct - lifted * st_, abs=1e-11)
    assert point.lateral == pytest.approx(a_x * st_ * sp + lifted * ct * sp, abs=1e-11)
    assert point.vertical == pytest.approx(a_x * st_ * cp + lifted * ct * cp, abs=1e-11)


@pytest.mark.slow
@pytest.mark.cites("(2.19)", "(2.20)")
@settings(deadline=None, max_examples=15)
@given(seed=seeds)
def test_both_corrections_of_the_text_recover_the_vertical_acceleration(seed: int) -> None:
    """(2.19) from horizontal accelerations found by differencing positions, (2.20) from forces."""
    body, travel = waving(seed), travelling(seed)
    motion = carried(body, travel)
    point, theta, phi = motion.tracks["left"], motion.pitch, motion.roll
    st_, ct, sp, cp = np.sin(theta), np.cos(theta), np.sin(phi), np.cos(phi)
    r = np.array([-2.9, 0.86, 0.28 - 0.9])
    x = travel[0] + ct * r[0] + st_ * sp * r[1] + st_ * cp * r[2]
    y = cp * r[1] - sp * r[2]
    dt = 1 / RATE
    a_x, a_y = (np.diff(p, 2) / dt**2 for p in (x, y))
    inner = slice(1, -1)
    first = (point.vertical[inner] - a_x * (st_ * cp)[inner] + a_y * sp[inner]) / (ct * cp)[
        inner
    ] - G
    second = -point.longitudinal * st_ + point.lateral * ct * sp + point.vertical * ct * cp - G
    assert first == pytest.approx(point.acceleration[inner], abs=1e-3)
    bend = np.diff(point.height_m, 2) / dt**2
    assert second[inner] == pytest.approx(bend, abs=5e-3)


@pytest.mark.cites("(2.18)")
@settings(deadline=None, max_examples=15)
@given(seed=seeds)
def test_range_over_a_level_floor_grows_with_both_cosines(seed: int) -> None:
    """(2.18)."""
    motion = carried(waving(seed), travelling(seed))
    point = motion.tracks["left"]
    upright = np.cos(motion.pitch) * np.cos(motion.roll)
    assert point.range_m == pytest.approx(point.height_m / upright, abs=1e-12)
    assert np.abs(point.road_m).max() < 1e-12


@pytest.mark.slow
@settings(deadline=None, max_examples=10)
@given(seed=seeds, offset=st.tuples(st.floats(-0.3, 0.3), st.floats(-0.1, 0.1), st.just(0.0)))
def test_footprint_lies_on_the_road_at_the_end_of_the_beam(
    seed: int, offset: tuple[float, float, float]
) -> None:
    body, travel = waving(seed), travelling(seed)
    road = sayers_road("limit", 60.0, seed)
    setup = TrackSetup((-2.9, 0.86, 0.28), offset)
    point = carried(body, travel, road=road, point=setup).tracks["left"]
    st_, ct, sp, cp = np.sin(body[1]), np.cos(body[1]), np.sin(body[2]), np.cos(body[2])
    p = (-2.9 + offset[0], 0.86 + offset[1], 0.28 - 0.9 - point.range_m)
    x = travel[0] + ct * p[0] + st_ * sp * p[1] + st_ * cp * p[2]
    y = cp * p[1] - sp * p[2]
    z = 0.9 + body[0] - st_ * p[0] + ct * sp * p[1] + ct * cp * p[2]
    assert point.road_m == pytest.approx(z, abs=1e-12)
    assert road.across(x, y) == pytest.approx(z, abs=1e-9)


def turned(about: str, angle: FloatArray) -> FloatArray:
    """Return the matrices that rotate by ``angle`` about an axis, shape (n, 3, 3)."""
    first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[about]
    matrix = np.zeros((angle.size, 3, 3)) + np.eye(3)
    matrix[:, first, first] = matrix[:, second, second] = np.cos(angle)
    matrix[:, first, second], matrix[:, second, first] = -np.sin(angle), np.sin(angle)
    return matrix


@settings(deadline=None, max_examples=10)
@given(seed=seeds, course=courses)
def test_specific_force_is_the_acceleration_in_space_less_gravity(
    seed: int, course: Course
) -> None:
    """The point's path in a frame that does not turn, differenced twice, in body axes."""
    body, travel = waving(seed), travelling(seed)
    still = np.zeros(CLOCK_COUNT)
    lane = turned("z", course.curvature_per_m * travel[0])
    lane = (
        lane @ turned("y", still - course.grade_rad) @ turned("x", still + course.cross_slope_rad)
    )
    attitude = lane @ turned("y", body[1]) @ turned("x", body[2])
    arm = lane[:, :, 2] * (0.9 + body[0])[:, None] + attitude @ np.array([-2.9, 0.86, 0.28 - 0.9])
    forward = lane[:, :, 0] * travel[1][:, None]
    space = (forward[2:] - forward[:-2]) * RATE / 2 + np.diff(arm, 2, axis=0) * RATE**2
    force = np.einsum("nij,ni->nj", attitude[1:-1], space + np.array([0.0, 0.0, G]))
    point = carried(body, travel, course).tracks["left"]
    felt = np.stack([point.longitudinal, point.lateral, point.vertical], axis=1)
    assert np.abs(felt[1:-1] - force).max() < 4e-3


def test_gravity_tilts_on_a_slope() -> None:
    """At rest uphill and left side up the body feels g along the slopes, and is so inclined."""
    course = Course(grade_rad=0.05, cross_slope_rad=0.03)
    still = np.zeros((9, 10))
    motion = carried(still, np.zeros((3, 10)), course)
    point = motion.tracks["left"]
    assert motion.pitch == pytest.approx(np.full(10, -0.05))
    assert motion.roll == pytest.approx(np.full(10, 0.03))
    assert point.longitudinal == pytest.approx(np.full(10, G * np.sin(0.05)))
    assert point.lateral == pytest.approx(np.full(10, G * np.cos(0.05) * np.sin(0.03)))
    assert np.abs(point.acceleration).max() < 1e-12


def test_steady_turn_pushes_to_its_inside_and_yaws() -> None:
    still, travel = np.zeros((9, 10)), np.zeros((3, 10))
    travel[1] = 15.0
    motion = carried(
        still, travel, Course(curvature_per_m=0.01), point=TrackSetup((0.0, 0.86, 0.28))
    )
    inner = motion.tracks["left"]
    assert motion.rates[2] == pytest.approx(np.full(10, 0.15))
    assert inner.lateral == pytest.approx(np.full(10, 0.15**2 * (100.0 - 0.86)))
    assert np.abs(inner.longitudinal).max() < 1e-12


@pytest.mark.parametrize(("rate", "speed_error", "height_error"), TRAPEZOID_ERRORS)
def test_twice_integrated_acceleration_is_the_height(
    rate: float, speed_error: float, height_error: float
) -> None:
    """On a rough road through a hard brake to a standstill, from rest on the level start."""
    road = sayers_road("rough", 90.0, 7)
    drive = Drive(16.0, (Segment(1.5), Segment(4.0, -4.0), Segment(1.0)))
    points = {"left": TrackSetup((SOFT_VAN.sensor_x_m, 0.86, 0.282))}
    motion = drive_over(
        SOFT_VAN, road, Course(), drive, drive.duration_s, rate, Setup(tracks=points)
    )
    point = motion.tracks["left"]
    half = 0.5 / rate
    velocity = np.cumsum(half * (point.acceleration[1:] + point.acceleration[:-1]))
    velocity = np.concatenate([[0.0], velocity])
    height = np.cumsum(half * (velocity[1:] + velocity[:-1])) + point.height_m[0]
    assert np.abs(velocity - point.velocity).max() < speed_error
    assert np.abs(height - point.height_m[1:]).max() < height_error
    assert np.ptp(point.height_m) > 0.02


def test_drive_starts_in_equilibrium() -> None:
    """On a level road at constant speed nothing ever moves, to the last bit of the sum."""
    drive = Drive(20.0, (Segment(2.0),))
    points = {"right": TrackSetup((-2.9, -0.86, 0.282))}
    motion = drive_over(
        LOADED_VAN, flat_road(50.0), Course(), drive, 2.0, 16000.0, Setup(tracks=points)
    )
    point = motion.tracks["right"]
    assert np.all(point.vertical == G)
    assert point.range_m == pytest.approx(np.full(point.range_m.size, 0.282), abs=1e-15)


def test_braking_pitches_the_nose_down_and_cornering_rolls_outward() -> None:
    road, setup = flat_road(200.0), Setup(tracks={"left": TrackSetup((-2.9, 0.86, 0.282))})
    slowing = Drive(20.0, (Segment(0.5), Segment(5.0, -2.0)))
    braked = drive_over(LOADED_VAN, road, Course(), slowing, 5.5, 1000.0, setup)
    assert 0.2 < np.degrees(braked.pitch[-1]) < 1.0
    assert np.mean((braked.acceleration * np.sin(braked.pitch))[1000:]) < -0.01
    steady = Drive(20.0, (Segment(3.0),))
    left_turn = Course(curvature_per_m=0.005)
    turned = drive_over(LOADED_VAN, road, left_turn, steady, 3.0, 1000.0, setup)
    assert turned.roll[-1] > np.radians(0.5)


def test_a_parked_vehicle_and_a_stretch_of_a_drive_have_rows_of_one_layout():
    # Another layout would have the kernel compiled again.
    parked, driven = empty_rows(2, 90), (rows[..., :40] for rows in empty_rows(2, 90))
    assert [numba.typeof(rows) for rows in parked] == [numba.typeof(rows) for rows in driven]
