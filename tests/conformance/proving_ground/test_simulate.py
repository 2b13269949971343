"""Laws of whole simulations: known exactly where they can be, and the failure they exist for."""

from dataclasses import replace

import numpy as np
import pytest

import floatref
from floatref.errors import InputError
from floatref.measures import iri
from floatref.values.channels import STANDARD_GRAVITY as G
from floatref.values.clock import UniformClock
from floatref.values.recording import Recording
from floatref_conformance.proving_ground.roads.road import flat_road
from floatref_conformance.proving_ground.scenario import Scenario, scenario_of_run
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.simulate import Simulation, simulate, stationary, truth_of
from floatref_conformance.proving_ground.vehicles.motion import BodyMotion, TrackMotion

pytestmark = pytest.mark.slow

SHORT = Scenario(seed=1, length_m=70.0, event_at_m=30.0, rate_hz=2000.0)


def samples(recording: Recording) -> dict[str, np.ndarray]:
    return {str(channel.id): channel.values for channel in recording.channels}


@pytest.fixture(scope="module")
def stopped() -> Simulation:
    return simulate(scenario_of_run("sg_10.7s_0.20g"))


def test_same_scenario_gives_the_same_recording() -> None:
    first, second = samples(simulate(SHORT).recording), samples(simulate(SHORT).recording)
    assert first.keys() == second.keys()
    assert all(np.array_equal(first[name], second[name]) for name in first)


def test_another_seed_gives_another_road_and_other_errors() -> None:
    first, second = simulate(SHORT), simulate(replace(SHORT, seed=2))
    assert not np.allclose(first.truth.tracks[0].elevation, second.truth.tracks[0].elevation)
    assert first.errors["left"].bias[0] != second.errors["left"].bias[0]


def test_channels_left_out_leave_the_others_alone() -> None:
    whole = samples(simulate(SHORT).recording)
    nominal = samples(simulate(replace(SHORT, imu=False, gnss=False, response=False)).recording)
    assert {name.split(".")[-1] for name in nominal} == {
        "vertical_specific_force",
        "height",
        "distance",
    }
    assert all(np.array_equal(whole[name], nominal[name]) for name in nominal)
    assert {"pitch_rate", "gnss_height", "left.longitudinal_specific_force"} <= whole.keys()


def test_flat_road_at_constant_speed_with_a_bias_is_known_exactly() -> None:
    """Nothing moves: g plus the bias, the range at rest, the distance speed times time."""
    bias_only = replace(SensorSuite.ideal(), force_bias=0.005)
    scenario = replace(SHORT, road="flat", rate_hz=16000.0)
    simulation = simulate(scenario, suite=bias_only)
    recording = simulation.recording
    for track in ("left", "right"):
        bias = simulation.errors[track].bias
        assert 0.0025 <= abs(bias[0]) <= 0.0075
        assert np.all(bias == bias[0])
        force = recording.channel("vertical_specific_force", track).values
        assert force == pytest.approx(G + bias, abs=1e-13)
        assert recording.channel("height", track).values == pytest.approx(
            np.full(force.size, 0.282), abs=1e-15
        )
        assert np.all(simulation.truth.track(track).elevation == 0.0)
    distance = recording.channel("distance")
    assert distance.values == pytest.approx(20.0 * distance.times_s, abs=1e-12)


def test_truth_takes_the_first_sample_at_or_beyond_each_point() -> None:
    simulation = simulate(
        replace(SHORT, manoeuvre="stop", rate_hz=16000.0, speed_kmh=30.0, final_speed_kmh=20.0)
    )
    truth, motion = simulation.truth.track("right"), simulation.motion
    interval = simulation.truth.interval_m
    assert truth.elevation.size == int(motion.distance[-1] / interval) + 1
    for k in (1, 1000, truth.elevation.size - 1):
        first = int(np.argmax(motion.distance >= k * interval))
        assert truth.elevation[k] == motion.tracks["right"].road_m[first]


def test_truth_at_a_standstill_is_what_lay_under_the_laser_on_arrival() -> None:
    """Of samples at the same distance the first counts, though the footprint rocks on."""
    count = np.array([0, 0, 1, 2, 2, 2, 3])
    zero, index = np.zeros(7), np.arange(7.0)
    track = TrackMotion(zero, zero, zero, zero, zero, zero, zero, index)
    motion = BodyMotion(
        UniformClock.of(1000.0),
        0.25 * count,
        zero,
        zero,
        np.zeros((3, 7)),
        zero,
        zero,
        {"t": track},
    )
    assert list(truth_of(motion, 0.25).track("t").elevation) == [0.0, 2.0, 3.0, 6.0]


def test_truth_is_linear_in_distance_where_samples_are_far_apart() -> None:
    simulation = simulate(replace(SHORT, rate_hz=1000.0))
    motion = simulation.motion
    points = simulation.truth.distance_m
    expected = np.interp(points, motion.distance, motion.tracks["left"].road_m)
    assert simulation.truth.track("left").elevation == pytest.approx(expected, abs=1e-12)


def test_truth_is_the_road_behind_the_vehicle_point() -> None:
    """At constant speed the footprint trails by the accelerometers' place less the laser's."""
    simulation = simulate(replace(SHORT, sensors=0.0, rate_hz=16000.0, road="flat", bump_mm=20.0,
                                  bump_at_m=25.0))  # fmt: skip
    z = simulation.truth.track("left").elevation
    middle = simulation.truth.interval_m * float(np.average(np.arange(z.size), weights=z))
    assert z.max() == pytest.approx(0.020, abs=1e-5)
    assert middle == pytest.approx(25.0 + 2.91 - SHORT.laser_ahead_m, abs=0.02)


@pytest.mark.parametrize("rate_hz", [1000.0, 1600.0, 2700.0, 3000.0, 3900.0, 16000.0])
def test_acceleration_is_in_step_with_height_at_any_rate(rate_hz: float) -> None:
    """Its double integral is the height; a lag of half a model step leaves 3 µm."""
    scenario = replace(SHORT, length_m=350.0, rate_hz=rate_hz, sensors=0.0, imu=False, gnss=False)
    point = simulate(replace(scenario, vehicle="soft-van")).motion.tracks["left"]
    twice = point.acceleration
    for start in (point.velocity[0], point.height_m[0]):
        twice = start + np.concatenate([[0.0], np.cumsum(twice[1:] + twice[:-1]) / (2 * rate_hz)])
    time = np.linspace(-1.0, 1.0, twice.size)
    error = twice - point.height_m
    error -= np.polynomial.polynomial.polyval(
        time, np.polynomial.polynomial.polyfit(time, error, 3)
    )
    assert error.std() < 0.3e-6


def test_one_unnamed_wheel_path() -> None:
    recording = simulate(replace(SHORT, tracks=("main",))).recording
    assert recording.tracks == ("main",)
    assert all(channel.id.track is None for channel in recording.channels)


def test_own_road_has_to_fit_the_scenario() -> None:
    with pytest.raises(InputError, match="track right: the road has no such wheel path"):
        simulate(SHORT, flat_road(40.0, tracks=("left",)))
    with pytest.raises(InputError, match="the road ends at"):
        simulate(SHORT, flat_road(10.0))


def test_velocity_error_at_the_stop_is_tilt_bias_and_misalignment(stopped: Simulation) -> None:
    """All but a fifth is the integral of a_x·sin θ and bias; the axis' own tilt adds to θ."""
    motion, rate = stopped.motion, 16000.0
    stop = int(np.argmax(motion.speed == 0.0))
    for name, track in motion.tracks.items():
        errors = stopped.errors[name]
        read = stopped.recording.channel("vertical_specific_force", name).values
        entering = np.sum((read - G - track.acceleration)[:stop]) / rate
        tilted = motion.acceleration * np.sin(motion.pitch + errors.pitch_rad)
        assert entering == pytest.approx(np.sum((tilted + errors.bias)[:stop]) / rate, rel=0.2)


@pytest.mark.parametrize("kind", ["quiescent", "bounce"])
def test_the_artificial_encoder_counts_72_km_h_without_a_scale_error(kind: str) -> None:
    distance = stationary(kind, seed=3, rate_hz=2000.0).recording.channel("distance")
    assert np.abs(distance.values - 20.0 * distance.times_s).max() < 0.3e-3 + 1e-9


@pytest.mark.parametrize("kind", ["quiescent", "bounce"])
def test_ideal_sensors_see_the_parked_body_move(kind: str) -> None:
    """Twice integrated force follows the range, which shrinks by the plate where it lies."""
    scenario = Scenario(manoeuvre=kind, sensors=0.0)
    simulation = simulate(scenario)
    height = simulation.recording.channel("height", "left").values
    before = slice(0, 20 * 16000)
    travel = np.ptp(height[before])
    assert travel == pytest.approx(0.086 if kind == "bounce" else 20e-6, rel=0.1)
    motion = simulation.motion.tracks["left"]
    upright = np.cos(simulation.motion.pitch) * np.cos(simulation.motion.roll)
    fallen = motion.height_m - height * upright
    assert fallen == pytest.approx(motion.road_m, abs=1e-12)


@pytest.mark.parametrize(("kind", "limit"), [("quiescent", 0.047), ("bounce", 0.126)])
def test_stationary_tests_pass_the_standards_limits(kind: str, limit: float) -> None:
    """AASHTO R 57-14, with all sensor errors on, away from the plate."""
    profile = floatref.process(stationary(kind, seed=2).recording, "temporal-basic")
    for track in profile.tracks:
        part = slice(round(150.0 / profile.interval_m), round(400.0 / profile.interval_m))
        assert 0.0 < iri(track.elevation[part], profile.interval_m) < limit / 2


@pytest.mark.parametrize("kind", ["quiescent", "bounce"])
def test_parked_vehicle_stays_where_it_is(kind: str) -> None:
    """The encoder tells 640 m; the receiver's position drifts by centimetres."""
    recording = simulate(Scenario(seed=6, manoeuvre=kind, rate_hz=1000.0)).recording
    assert recording.channel("distance").values[-1] > 600.0
    for name in ("gnss_latitude", "gnss_longitude"):
        assert 0.0 < np.ptp(recording.channel(name).values) * 6371e3 < 0.2


def test_unknown_stationary_test_is_refused() -> None:
    with pytest.raises(InputError, match="stationary test 'jump': unknown"):
        stationary("jump")
