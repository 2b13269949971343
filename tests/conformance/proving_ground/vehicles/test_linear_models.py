"""Laws of the papers' models: their own equations, energy, delay, and what the channels tell."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.values.channels import STANDARD_GRAVITY as G
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.proving_ground.vehicles.linear_models import (
    IMINE_TRAILER,
    QUARTER_CAR,
    ZHU_HALF_CAR,
    ZHU_TABLE_1,
)
from floatref_conformance.proving_ground.vehicles.parameter_sets import LINEAR_MODELS
from floatref_conformance.proving_ground.vehicles.response import state_space
from floatref_conformance.proving_ground.vehicles.suspension import SuspensionMotion
from floatref_reference.imine import section_2_trailer as imine
from floatref_reference.zhu_2021 import section_2_vehicle as zhu

every_model = pytest.mark.parametrize("name", sorted(LINEAR_MODELS))
SMOOTH = Scenario(
    seed=2, road="sines", length_m=80.0, speed_kmh=54.0, sensors=0.0, rate_hz=8000.0,
    imu=False, gnss=False, tracks=("main",),
)  # fmt: skip
HEIGHTS = {
    "quarter-car": {"sprung", "unsprung"},
    "zhu-half-car": {"equipment", "sprung", "rear_unsprung", "unsprung"},
    "imine-trailer": {"sprung", "unsprung"},
}


def driven(name: str, **changes: object) -> tuple[Simulation, SuspensionMotion]:
    simulation = simulate(replace(SMOOTH, vehicle=name, **changes))
    assert simulation.motion.suspension is not None
    return simulation, simulation.motion.suspension


def read(simulation: Simulation, name: str, track: str | None = None) -> np.ndarray:
    return simulation.recording.channel(name, track).values


@pytest.mark.slow
@pytest.mark.parametrize("tracks", [("main",), ("left", "right")])
@every_model
def test_every_freedom_obeys_the_equation_of_motion(name: str, tracks: tuple[str, ...]) -> None:
    """M·q'' + C·q' + K·q = k·u + c·u', integrated over two intervals by Simpson's rule."""
    _, motion = driven(name, tracks=tracks)
    model = LINEAR_MODELS[name]
    q, v, u, h = motion.position, motion.velocity, motion.road, 1e-3

    def gained(x: np.ndarray) -> np.ndarray:
        return (x[:, 2:] - x[:, :-2])[:, 1:-1]

    def summed(x: np.ndarray) -> np.ndarray:
        return (h / 3 * (x[:, :-2] + 4 * x[:, 1:-1] + x[:, 2:]))[:, 1:-1]

    pushed = model.forcing()[:, :4] @ summed(u) + model.tyre_damping() @ gained(u)
    left = model.masses()[:, None] * gained(v) + model.damping() @ gained(q)
    left += model.stiffness() @ summed(q)
    size = np.abs(model.stiffness()) @ np.abs(summed(q)).max(axis=1)
    assert np.abs(pushed).max() > 1.0
    assert np.all(np.abs(left - pushed).max(axis=1) < 1e-4 * size)


@every_model
def test_recorded_heights_rates_and_forces_are_one_motion(name: str) -> None:
    simulation, _ = driven(name)
    for quantity in HEIGHTS[name]:
        height, rate = (read(simulation, f"{quantity}_{x}") for x in ("displacement", "velocity"))
        force = read(simulation, f"{quantity}_specific_force") - G
        mean = ((force[:-2] + 6 * force[1:-1] + force[2:]) / 8)[1:-1]
        twice = np.diff(height, 2)[1:-1] * 1e6
        slope = (height[2:] - height[:-2]) * 500.0
        assert np.abs(force).max() > 0.5
        tilted = (
            G * 0.5 * np.ptp(read(simulation, "pitch_angle")) ** 2 if name != "quarter-car" else 0
        )
        assert np.abs(twice - mean).max() < 5e-3 * np.abs(mean).max() + tilted
        assert np.abs(slope - rate[1:-1]).max() < 5e-3 * np.abs(rate).max()


@pytest.mark.parametrize("name", ["quarter-car", "zhu-half-car"])
def test_the_deflection_is_the_difference_of_heights(name: str) -> None:
    simulation, _ = driven(name)
    travel = read(simulation, "suspension_deflection")
    above = read(simulation, "sprung_displacement")
    if name == "zhu-half-car":
        behind = above + 3.19 * read(simulation, "pitch_angle")
        rear = behind - read(simulation, "rear_unsprung_displacement")
        assert read(simulation, "rear_suspension_deflection") == pytest.approx(rear, abs=1e-12)
        above = above - 6.19 * read(simulation, "pitch_angle")
    assert travel == pytest.approx(above - read(simulation, "unsprung_displacement"), abs=1e-12)
    assert np.abs(travel).max() > 1e-4


def test_a_quarter_car_obeys_its_springs_from_recorded_channels_alone() -> None:
    """m·(f − g) = −k·d − c·d', as an estimator would use it."""
    simulation, _ = driven("quarter-car")
    known = simulation.recording.setup.vehicle
    assert known is not None
    p = known.parameters
    travel = read(simulation, "suspension_deflection")[1:-1]
    rate = read(simulation, "sprung_velocity") - read(simulation, "unsprung_velocity")
    spring = p["suspension_n_per_m"] * travel + p["suspension_ns_per_m"] * rate[1:-1]
    felt = p["sprung_kg"] * (read(simulation, "sprung_specific_force") - G)[1:-1]
    assert np.abs(felt + spring).max() < 5e-3 * np.abs(felt).max()


def test_the_trailer_without_a_hitch_does_not_drift() -> None:
    """No spring, no damper and no tyre acts on z = p·φ: its momentum stays at zero."""
    _, motion = driven("imine-trailer", length_m=400.0, road="iso-C", tracks=("left", "right"))
    free = np.array([0.0, 0.0, 0.6, 0.0, -1.0])
    assert np.abs(IMINE_TRAILER.stiffness() @ free).max() < 1e-9
    assert np.abs(IMINE_TRAILER.damping() @ free).max() < 1e-9
    along = 600.0 * 0.6 * motion.position[2] - 500.0 * motion.position[4]
    assert np.abs(600.0 * 0.6 * motion.position[2]).max() > 1.0
    assert np.abs(along).max() < 1e-6


def test_a_trailer_on_one_road_does_not_roll() -> None:
    _, level = driven("imine-trailer")
    assert np.abs(level.position[3]).max() < 1e-12
    assert np.abs(level.position[2]).max() > 1e-3
    _, uneven = driven("imine-trailer", road="iso-C", tracks=("left", "right"))
    assert np.abs(uneven.position[3]).max() > 1e-3


@pytest.mark.slow
@pytest.mark.cites("(8) of Zhu")
@pytest.mark.parametrize("speed_kmh", [36.0, 90.0])
def test_the_rear_wheel_meets_the_front_wheels_road_later(speed_kmh: float) -> None:
    """(8) of Zhu: u₁(t) = u₂(t − (L₁ + L₂)/v)."""
    _, motion = driven("zhu-half-car", speed_kmh=speed_kmh)
    rear, front = motion.road[0], motion.road[1]
    times = motion.clock.times(front.size)
    delay = (3.19 + 6.19) / (speed_kmh / 3.6)
    late = np.interp(times - delay, times, front)
    assert np.abs(rear).max() > 1e-3
    assert rear[times > delay] == pytest.approx(late[times > delay], abs=1e-5)


@pytest.mark.cites("(2) to (7) of Zhu")
def test_zhus_matrices_are_the_references() -> None:
    """Each from the print alone; the recording's pitch is nose down, the paper's θ nose up."""
    theirs = zhu.structure_of_equations()
    for own, their in (
        (np.diag(ZHU_HALF_CAR.masses()), theirs.M),
        (ZHU_HALF_CAR.paper_damping, theirs.C),
        (ZHU_HALF_CAR.paper_stiffness, theirs.K),
    ):
        assert own == pytest.approx(np.asarray(their), rel=1e-12)


@pytest.mark.cites("(2) to (7) of Imine")
def test_imines_matrices_are_the_references() -> None:
    theirs = imine.motion()
    for own, their in (
        (np.diag(IMINE_TRAILER.masses()), theirs.M),
        (IMINE_TRAILER.paper_damping, theirs.B),
        (IMINE_TRAILER.paper_stiffness, theirs.K),
        (IMINE_TRAILER.forcing()[:, :2], theirs.C),
        (IMINE_TRAILER.tyre_damping()[:, :2], theirs.D),
    ):
        assert own == pytest.approx(np.asarray(their), rel=1e-12)


def test_a_quarter_car_is_a_cars_corner() -> None:
    poles = np.linalg.eigvals(state_space(QUARTER_CAR)[0])
    hertz = np.sort(np.abs(poles[poles.imag > 0])) / (2 * np.pi)
    assert hertz == pytest.approx([1.1, 11.9], rel=0.05)


@pytest.mark.parametrize("tracks", [("main",), ("left", "right")])
@every_model
def test_each_model_has_its_channels(name: str, tracks: tuple[str, ...]) -> None:
    simulation, _ = driven(name, tracks=tracks)
    paths = [None] if tracks == ("main",) else list(tracks)
    shared = {"sprung"} if name == "imine-trailer" else set()
    expected = set()
    for quantity in HEIGHTS[name]:
        for path in [None] if quantity in shared else paths:
            for kind in ("specific_force", "displacement", "velocity"):
                expected.add((f"{quantity}_{kind}", path))
    turning = {"quarter-car": (), "zhu-half-car": ("pitch",), "imine-trailer": ("pitch", "roll")}
    expected |= {(f"{t}_{k}", None) for t in turning[name] for k in ("angle", "acceleration")}
    expected |= {("suspension_deflection", path) for path in paths}
    if name == "zhu-half-car":
        expected |= {("rear_suspension_deflection", path) for path in paths}
    common = {("distance", None)}
    common |= {(n, path) for path in paths for n in ("vertical_specific_force", "height")}
    assert {tuple(c.id) for c in simulation.recording.channels} == expected | common


def test_the_trailers_wheel_paths_have_their_own_wheels() -> None:
    simulation, motion = driven("imine-trailer", road="iso-C", tracks=("right", "left"))
    for row, track in ((0, "left"), (1, "right")):
        height = read(simulation, "unsprung_displacement", track)
        assert np.array_equal(height, motion.position[row])


@pytest.mark.parametrize(("track", "half"), [("left", 0.75), ("right", -0.75)])
def test_a_trailers_deflection_is_its_own_corners(track: str, half: float) -> None:
    """Against the chassis above that wheel: 0.6 m behind the centre, half a track aside."""
    simulation, _ = driven("imine-trailer", road="iso-C", tracks=("left", "right"))
    above = read(simulation, "sprung_displacement") + 0.6 * read(simulation, "pitch_angle")
    above += half * read(simulation, "roll_angle")
    travel = above - read(simulation, "unsprung_displacement", track)
    assert np.abs(half * read(simulation, "roll_angle")).max() > 1e-3
    assert read(simulation, "suspension_deflection", track) == pytest.approx(travel, abs=1e-12)


def test_a_test_rig_is_noisy_as_the_suite_says() -> None:
    (_, true), (noisy, _) = driven("zhu-half-car"), driven("zhu-half-car", sensors=1.0)
    for name, row, sigma in (
        ("sprung_displacement", true.position[1], 0.05e-3),
        ("sprung_velocity", true.velocity[1], 1e-3),
        ("pitch_angle", true.position[4], 1e-5),
        ("pitch_acceleration", true.acceleration[4], 2e-3),
    ):
        assert np.std(read(noisy, name) - row) == pytest.approx(sigma, rel=0.05)


@every_model
def test_setup_has_the_models_own_name_and_parameters(name: str) -> None:
    exact, _ = driven(name)
    assert exact.recording.setup.vehicle == LINEAR_MODELS[name].make_setup()
    wrong, _ = driven(name, sensors=50.0)
    assert wrong.recording.setup.vehicle is not None
    installed = wrong.recording.setup.vehicle.parameters
    for parameter, value in LINEAR_MODELS[name].make_setup().parameters.items():
        assert (installed[parameter] > 0) == (value > 0)
    assert installed != exact.recording.setup.vehicle.parameters


@pytest.mark.cites("Table 1 of Zhu")
def test_table_1_is_the_papers() -> None:
    assert dict(ZHU_TABLE_1) == {
        "equipment_kg": zhu.TABLE_1.m_1, "body_kg": zhu.TABLE_1.m_2,
        "rear_wheel_kg": zhu.TABLE_1.m_3, "front_wheel_kg": zhu.TABLE_1.m_4,
        "pitch_kg_m2": zhu.TABLE_1.J_2, "equipment_n_per_m": zhu.TABLE_1.k_3,
        "suspension_n_per_m": zhu.TABLE_1.k_4, "tyre_n_per_m": zhu.TABLE_1.k_5,
        "equipment_ns_per_m": zhu.TABLE_1.c_3, "suspension_ns_per_m": zhu.TABLE_1.c_4,
        "rear_axle_m": zhu.TABLE_1.L_1, "front_axle_m": zhu.TABLE_1.L_2,
        "eccentricity_m": zhu.TABLE_1.e,
    }  # fmt: skip
