"""Laws of the response channels: what they see, how wrong they are, and whom they leave alone."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.channels import STANDARD_GRAVITY as G
from floatref.values.recording import Recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.sensors.gauging import as_installed
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.proving_ground.vehicles.full_car import Vehicle
from floatref_conformance.proving_ground.vehicles.parameter_sets import LOADED_VAN, TRAILER
from floatref_conformance.proving_ground.vehicles.suspension import SuspensionMotion

SHORT = Scenario(seed=1, length_m=70.0, event_at_m=30.0, rate_hz=2000.0, imu=False, gnss=False)
NAMES = ("unsprung_specific_force", "sprung_specific_force", "suspension_deflection")
IDEAL = SensorSuite.ideal()


def values(recording: Recording, name: str, track: str | None = "left") -> np.ndarray:
    return recording.channel(name, track).values


def freedoms(simulation: Simulation) -> SuspensionMotion:
    assert simulation.motion.suspension is not None
    return simulation.motion.suspension


@pytest.mark.slow
@settings(deadline=None, max_examples=5)
@given(
    seed=st.integers(0, 2**63 - 1),
    vehicle=st.sampled_from(["loaded-van", "pickup", "trailer"]),
    manoeuvre=st.sampled_from(["constant", "dead-start"]),
    curvature=st.floats(-5.0, 5.0),
    rate_hz=st.sampled_from([1000.0, 2700.0, 16000.0]),
    tracks=st.sampled_from([("left", "right"), ("main",)]),
)
def test_all_other_channels_are_the_same_bit_by_bit(
    seed: int,
    vehicle: str,
    manoeuvre: str,
    curvature: float,
    rate_hz: float,
    tracks: tuple[str, ...],
) -> None:
    scenario = Scenario(
        seed=seed, vehicle=vehicle, manoeuvre=manoeuvre, curvature_per_km=curvature,
        rate_hz=rate_hz, tracks=tracks, length_m=50.0, final_speed_kmh=20.0, dwell_s=1.0,
    )  # fmt: skip
    with_them, without = simulate(scenario), simulate(replace(scenario, response=False))
    bits = {c.id: c.values.tobytes() for c in with_them.recording.channels}
    kept = {c.id: c.values.tobytes() for c in without.recording.channels}
    assert {name for name, _ in bits.keys() - kept.keys()} == set(NAMES)
    assert all(bits[name] == kept[name] for name in kept)
    assert with_them.recording.setup == without.recording.setup
    for track, other in zip(with_them.truth.tracks, without.truth.tracks, strict=True):
        assert track.elevation.tobytes() == other.elevation.tobytes()


def test_channels_have_their_own_clock_from_start_to_end() -> None:
    simulation = simulate(SHORT)
    for track in SHORT.tracks:
        for name in NAMES:
            channel = simulation.recording.channel(name, track)
            assert channel.mean_rate_hz == 1000.0
            assert channel.span_s[0] == 0.0
            assert 0 <= simulation.motion.times_s[-1] - channel.span_s[1] < 1e-3


def test_a_parked_vehicle_has_none() -> None:
    recording = simulate(Scenario(manoeuvre="quiescent", rate_hz=1000.0)).recording
    assert not {name for name, _ in (c.id for c in recording.channels)} & set(NAMES)
    assert recording.setup.vehicle is None


def test_on_a_flat_road_at_constant_speed_nothing_moves() -> None:
    recording = simulate(replace(SHORT, road="flat", sensors=0.0)).recording
    for name, at_rest in zip(NAMES, (G, G, 0.0), strict=True):
        assert np.all(values(recording, name) == at_rest)


def test_ideal_channels_belong_together() -> None:
    """Twice the deflection's slope is the difference of both accelerometers, tilt aside."""
    recording = simulate(replace(SHORT, road="sines", sensors=0.0)).recording
    unsprung, sprung, travel = (values(recording, name) for name in NAMES)
    twice = np.diff(travel, 2) * 1000.0**2
    between = sprung - unsprung
    between = (between[:-2] + 6 * between[1:-1] + between[2:]) / 8
    assert np.abs(between).max() > 1.0
    assert np.abs(twice - between).max() < 5e-3 * np.abs(between).max()


@pytest.mark.parametrize(("vehicle", "first"), [(LOADED_VAN, 0), (TRAILER, 2)])
def test_tracks_are_measured_at_their_own_wheel_of_the_axle_that_has_sensors(
    vehicle: Vehicle, first: int
) -> None:
    """The front axle's, but a trailer's own: its front pair is the tow vehicle."""
    simulation = simulate(replace(SHORT, vehicle=vehicle.name, sensors=0.0))
    motion = freedoms(simulation)
    for wheel, track in enumerate(("left", "right"), first):
        read = values(simulation.recording, "unsprung_specific_force", track)
        assert read == pytest.approx(G + motion.acceleration[3 + wheel], abs=1e-9)
        x, y = vehicle.contacts()[wheel]
        heave, pitch, roll = motion.position[:3]
        travel = heave - x * pitch + y * roll - motion.position[3 + wheel]
        read = values(simulation.recording, "suspension_deflection", track)
        assert read == pytest.approx(travel, abs=1e-12)


@pytest.mark.slow
def test_a_body_accelerometer_feels_gravity_and_braking_through_its_tilt() -> None:
    """(2.17) at small angles, which the recording's own vertical accelerometer shows too."""
    scenario = replace(
        SHORT, sensors=0.0, road="flat", manoeuvre="braking", length_m=200.0, event_at_m=150.0
    )
    simulation = simulate(scenario)
    motion = freedoms(simulation)
    pitch, _ = motion.tilt()
    row = LOADED_VAN.gauges(0.86).forces["sprung_specific_force"]
    own = values(simulation.recording, "sprung_specific_force") - row @ motion.acceleration - G
    assert np.abs(motion.lane[0] * pitch).max() > 5e-3
    assert own == pytest.approx(motion.lane[0] * pitch - G * pitch**2 / 2, abs=2e-4)


@pytest.mark.slow
def test_a_brake_winds_the_wheel_carrier_up() -> None:
    """A tilt of w·b/g nose down under a deceleration b takes w·b²/g from the reading."""
    scenario = replace(
        SHORT, sensors=0.0, road="flat", manoeuvre="braking", length_m=200.0, event_at_m=150.0
    )
    wound = replace(IDEAL, carrier_windup=0.03)
    plain, tilted = (
        values(simulate(scenario, suite=suite).recording, "unsprung_specific_force")
        for suite in (IDEAL, wound)
    )
    along = freedoms(simulate(scenario)).lane[0]
    assert along.min() < -1.0
    tilt = -0.03 * along / G
    assert tilted - plain == pytest.approx(
        np.sin(tilt) * along - (1 - np.cos(tilt)) * plain, abs=1e-9
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "bias", "density", "step"),
    [
        ("unsprung_specific_force", 2e-3 * G, 6e-3 * G / 16000**0.5, 100 * G / 2**16),
        ("sprung_specific_force", 1e-3 * G, 6e-4 * G / 16000**0.5, 4 * G / 2**16),
    ],
)
def test_errors_are_as_large_as_the_suite_says(
    name: str, bias: float, density: float, step: float
) -> None:
    """Scale error and tilt of the axis add a few parts in ten thousand of g."""
    suite = replace(SensorSuite(), misalignment_rad=0.0, force_scale=0.0)
    scenario = replace(SHORT, road="flat", length_m=200.0)
    for seed in range(4):
        read = values(simulate(replace(scenario, seed=seed), suite=suite).recording, name)
        assert 0.4 * bias < abs(np.mean(read) - G) < 1.6 * bias
        wanted = np.hypot(density * 1000**0.5, step / 12**0.5)
        assert np.std(read) == pytest.approx(wanted, rel=0.1)
        assert read / step == pytest.approx(np.rint(read / step), abs=1e-6)


@pytest.mark.slow
def test_the_deflection_is_noisy_coarse_and_off_in_scale() -> None:
    scenario = replace(SHORT, road="iso-E", iri_m_per_km=0.0)
    true = values(simulate(scenario, suite=IDEAL).recording, "suspension_deflection")
    scales = []
    for seed in range(6):
        suite = replace(SensorSuite(), deflection_resolution_m=0.0)
        drawn = simulate(replace(scenario, seed=seed, road_seed=1), suite=suite).recording
        read = values(drawn, "suspension_deflection")
        scales.append(float(read @ true / (true @ true)) - 1.0)
        assert np.std(read - (1 + scales[-1]) * true) == pytest.approx(0.1e-3, rel=0.1)
    assert max(map(abs, scales)) < 5.5e-3
    assert np.ptp(scales) > 1e-3
    coarse = values(simulate(scenario).recording, "suspension_deflection") / 0.05e-3
    assert coarse == pytest.approx(np.rint(coarse), abs=1e-6)


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 2**63 - 1), error=st.floats(0.0, 0.2))
def test_an_installer_knows_each_parameter_but_for_an_error(seed: int, error: float) -> None:
    true, known = LOADED_VAN.make_setup(), as_installed(LOADED_VAN.make_setup(), error, seed)
    assert (known.model, known.x_m) == (true.model, true.x_m)
    off = [known.parameters[n] / v - 1 for n, v in true.parameters.items() if v]
    assert np.abs(off).max() <= error + 1e-12
    assert error < 1e-6 or np.ptp(off) > 0.05 * error
    assert known.parameters["tyre_ns_per_m"] == 0.0


def test_a_trailers_corner_is_of_its_own_axle() -> None:
    warnings, axle = TRAILER.make_setup(), TRAILER.rear
    assert warnings.x_m == axle.x_m
    assert warnings.parameters["unsprung_kg"] == axle.wheel_kg
    assert warnings.parameters["suspension_n_per_m"] == axle.spring
    share = 2 * warnings.parameters["sprung_kg"] / TRAILER.sprung_kg
    assert share == pytest.approx(TRAILER.front.x_m / TRAILER.wheelbase_m)


def test_the_vehicle_of_a_recording_is_a_front_corner() -> None:
    exact = simulate(replace(SHORT, sensors=0.0)).recording.setup.vehicle
    assert exact is not None
    assert exact == LOADED_VAN.make_setup()
    assert exact.x_m == LOADED_VAN.front.x_m
    shares = LOADED_VAN.load_shares()
    assert 2 * exact.parameters["sprung_kg"] == pytest.approx(shares[0] * LOADED_VAN.sprung_kg)
    first, second = (simulate(replace(SHORT, seed=s)).recording.setup.vehicle for s in (1, 2))
    assert first is not None
    assert first != second
    assert abs(first.parameters["tyre_n_per_m"] / 320e3 - 1) <= 0.03
