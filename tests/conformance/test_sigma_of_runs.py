"""The truth of simulated runs lies within two sigma of a smoother's profile, as often as it should.

Errors of an encoder and of slow walks are one draw for a whole run, so that points of one run are
no sample: those of several drawn runs are looked at together. The wheel hardly slips and the laser
is at its accelerometer, as in edition 2026.1: sigma has no share for more.
"""

import warnings
from functools import cache

import numpy as np
import pytest

import floatref
from floatref.measures import high_pass
from floatref_conformance.proving_ground.scenario import FIRST_DEFAULTS, scenario_of_run
from floatref_conformance.proving_ground.simulate import Simulation, simulate

pytestmark = pytest.mark.slow

RATE_HZ = 4000.0
RUN_IN_M = 53.0
SEEDS = range(4)
NO_SCALE = 1e-12
REFLECTION = "kalman-smoother-reflection"
OTHERS = (
    *("kalman-smoother", "kalman-smoother-constant-attitude"),
    "kalman-smoother-constant-height-attitude",
)
every_run = pytest.mark.parametrize("run", ["sg_2.1s_0.33g", "brk_72-29_0.39g", "ref_72"])


@cache
def simulated(run: str, seed: int) -> Simulation:
    return simulate(
        scenario_of_run(run, seed, imu=True, gnss=True, rate_hz=RATE_HZ, **FIRST_DEFAULTS)
    )


def ratios(
    simulation: Simulation, pipeline: str, axis: np.ndarray, **settings: float
) -> np.ndarray:
    """Return error over sigma of all tracks, where the filter over distance has run in."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floatref.FloatrefWarning)
        profile = floatref.process(simulation.recording, pipeline, settings)
    interval_m, found = profile.interval_m, []
    inside = slice(round(RUN_IN_M / interval_m), -round(RUN_IN_M / interval_m))
    for track in profile.tracks:
        points = interval_m * np.arange(track.elevation.size)
        road = np.interp(points, axis, simulation.motion.tracks[track.name].road_m)
        error = track.elevation - high_pass(road, interval_m)
        assert track.sigma is not None
        found.append((error / track.sigma)[inside])
    return np.concatenate(found)


def covered(found: list[np.ndarray], factor: float = 1.0) -> bool:
    """Whether it is 85 to 99.5 percent, were sigma ``factor`` times what it is."""
    share = np.mean(np.abs(np.concatenate(found)) <= 2.0 * factor)
    return bool(0.85 <= share <= 0.995)


def assert_right(found: list[np.ndarray]) -> None:
    assert covered(found)
    assert not covered(found, 0.5)
    assert not covered(found, 2.0)


def along_encoder(run: str, pipeline: str) -> list[np.ndarray]:
    """There the encoder's error is that of the axis: its part of sigma is left out."""
    found = []
    for seed in SEEDS:
        simulation = simulated(run, seed)
        encoder = simulation.recording.channel("distance")
        encoder_m = np.interp(simulation.motion.times_s, encoder.times_s, encoder.values)
        found.append(ratios(simulation, pipeline, encoder_m, distance_scale_sigma=NO_SCALE))
    return found


@every_run
def test_the_truth_along_the_encoders_distance(run: str) -> None:
    assert_right(along_encoder(run, REFLECTION))


@every_run
def test_the_truth_along_the_true_distance(run: str) -> None:
    """All errors, and all of sigma."""
    simulations = [simulated(run, seed) for seed in SEEDS]
    assert_right([ratios(s, REFLECTION, s.motion.distance) for s in simulations])


@every_run
@pytest.mark.parametrize("pipeline", OTHERS)
def test_constants_in_place_of_readings_are_told_to_be_no_better_than_they_are(
    run: str, pipeline: str
) -> None:
    """Where they hold they are better: a share above 99.5 percent is none to complain of."""
    ratio = np.abs(np.concatenate(along_encoder(run, pipeline)))
    assert np.mean(ratio <= 2.0) >= 0.85
    assert np.mean(ratio <= 0.5) < 0.85
