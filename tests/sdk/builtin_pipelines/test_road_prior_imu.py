"""With an inertial unit the tilt of the body is measured: the acceleration is the vertical one."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import floatref
from floatref.engine import flow
from floatref.estimators.kalman.inputs import IMU
from floatref.estimators.levelling import Level
from floatref.intake.blocks import Source
from floatref.measures import high_pass
from floatref.screening.findings import Screening
from floatref.values.block import join_blocks
from floatref.values.channels import ChannelId
from floatref.values.recording import Recording
from floatref_conformance.proving_ground import Scenario, SensorSuite, Simulation, simulate

PIPELINE, NOMINAL = "road-prior-smoother-imu", "road-prior-smoother"
WINDOW = 500


SCENARIO = Scenario(
    manoeuvre="stop",
    deceleration_g=0.35,
    dwell_s=2.0,
    seed=5,
    slip_percent_per_g=0.3,
    laser_ahead_m=0.0,
    event_at_m=150.0,
    length_m=310.0,
    tracks=("left",),
    rate_hz=5000.0,
    profile_interval_m=0.02,
    imu=True,
    gnss=False,
)


@cache
def driven(manoeuvre: str = "stop", **numbers: float) -> Simulation:
    """Return a drive on a hill whose accelerometers have all errors but a lean."""
    suite = replace(SensorSuite(), misalignment_rad=0.0)
    return simulate(replace(SCENARIO, **numbers), suite=suite)


def levelled(recording: Recording) -> np.ndarray:
    source, stage = Source(Screening.of(recording), IMU), Level()
    _, blocks = flow.run([stage], source.header, source.blocks())
    return join_blocks(list(blocks))[ChannelId("vertical_acceleration", "left")]


def slow(values: np.ndarray) -> np.ndarray:
    """Return means over tenths of a second, less their median."""
    means = values[: values.size // WINDOW * WINDOW].reshape(-1, WINDOW).mean(axis=1)
    return np.asarray(means - np.median(means))


@pytest.mark.parametrize("manoeuvre", ["stop", "braking"])
def test_acceleration_is_the_vertical_one_while_the_body_pitches(manoeuvre: str) -> None:
    """What is left is a milliradian of inclination: the bias of the horizontal accelerometer."""
    simulation = driven(manoeuvre)
    true = simulation.motion.tracks["left"].acceleration
    found = levelled(simulation.recording)
    plain = simulation.recording.channel("vertical_specific_force", "left").values - 9.80665
    error, untouched = (slow(each - true[: each.size]) for each in (found, plain))
    braking = np.abs(simulation.motion.acceleration).max()
    assert np.abs(error).max() < 0.003 * braking
    assert np.abs(untouched).max() > 5.0 * np.abs(error).max()


@pytest.mark.slow
def test_elevations_at_stops_are_nearer_to_the_truth_than_without() -> None:
    """The accelerometers lean, too: that is learned, as without an inertial unit."""
    squares = {PIPELINE: 0.0, NOMINAL: 0.0}
    for seed in range(3):
        scenario = replace(SCENARIO, seed=seed, deceleration_g=0.2 + 0.03 * seed)
        simulation = simulate(scenario)
        truth = simulation.truth.track("left").elevation
        for name in squares:
            profile = floatref.process(simulation.recording, name)
            found = profile.track("left").elevation[: truth.size]
            true = high_pass(truth[: found.size], profile.interval_m)
            near = slice(round(70.0 / profile.interval_m), round(230.0 / profile.interval_m))
            squares[name] += (found - true)[near].var() / 3
    assert squares[PIPELINE] < min(1e-3**2, squares[NOMINAL])


@pytest.mark.slow
def test_gnss_makes_no_difference() -> None:
    """It is not read."""
    simulation = driven()
    with_gnss = driven(gnss=True)
    one, two = (floatref.process(s.recording, PIPELINE) for s in (simulation, with_gnss))
    np.testing.assert_array_equal(one.track("left").elevation, two.track("left").elevation)
    assert floatref.pipeline_capabilities(PIPELINE) == ("imu",)


def test_one_sigma_at_the_stop_is_not_too_small() -> None:
    """The RMS error is less than twice as large."""
    simulation = driven()
    ours = floatref.process(simulation.recording, PIPELINE)
    near = slice(round(120.0 / ours.interval_m), round(180.0 / ours.interval_m))
    sigma, truth = ours.track("left").sigma, simulation.truth.track("left").elevation
    assert sigma is not None
    error = ours.track("left").elevation[near] - high_pass(truth, ours.interval_m)[near]
    assert np.mean(np.square(error / sigma[near])) < 2.0**2
