"""The main job on simulated sensors: adequate at speed, and the failure at a stop."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import floatref
from floatref.engine import flow
from floatref.intake.blocks import Source
from floatref.measures import agreement, high_pass, iri, short_interval_roughness
from floatref.screening.findings import Screening
from floatref.stages.conditioning import RemoveGravity
from floatref.stages.integration import Integrate
from floatref.values.channels import ChannelId
from floatref_conformance.proving_ground.scenario import Scenario, scenario_of_run
from floatref_conformance.proving_ground.simulate import simulate

pytestmark = pytest.mark.slow

PIPELINES = ("temporal-basic", "spatial-basic")
SECTION_M, PEAK_M = (220.0, 380.9), (280.0, 328.0)


@pytest.fixture(scope="module")
def synthetic():
    """Return a function from the laser's offset to the reference run over a synthetic road."""
    run = scenario_of_run("ref_72", 3)
    return cache(lambda ahead_m: simulate(replace(run, laser_ahead_m=ahead_m)))


@pytest.fixture(scope="module")
def measured():
    """The same at 72 km/h over a measured road as it is."""
    run = Scenario(seed=4, road="measured", iri_m_per_km=0.0, length_m=480.0)
    return cache(lambda ahead_m: simulate(replace(run, laser_ahead_m=ahead_m)))


@pytest.fixture(scope="module")
def stop():
    """The run with the 10.7-s stop."""
    return simulate(scenario_of_run("sg_10.7s_0.20g", 0))


@pytest.fixture(scope="module", params=[1, 2, 5])
def other_stop(request):
    """The same run with the road and the errors of another seed."""
    return simulate(scenario_of_run("sg_10.7s_0.20g", request.param))


def within(profile, z, limits):
    low, high = ((limit - profile.start_m) / profile.interval_m for limit in limits)
    return z[round(low) : round(high)]


def judged(simulation, pipeline, track):
    """Cross correlation, IRI and IRI of the truth over the section, filtered alike."""
    profile, truth = floatref.process(simulation.recording, pipeline), simulation.truth
    interval = profile.interval_m
    filtered = high_pass(truth.track(track).elevation, interval)
    p = within(truth, filtered, SECTION_M)
    q = within(profile, profile.track(track).elevation, SECTION_M)
    return agreement(p, q, interval).cross_correlation, iri(q, interval), iri(p, interval)


@pytest.mark.parametrize("pipeline", PIPELINES)
@pytest.mark.parametrize("track", ["left", "right"])
@pytest.mark.parametrize("road", ["synthetic", "measured"])
@pytest.mark.parametrize(("ahead_m", "least", "off"), [(0.0, 0.995, 0.005), (0.105, 0.98, 0.015)])
def test_at_speed_the_truth_comes_back(request, road, pipeline, track, ahead_m, least, off):
    # A laser ahead of its accelerometer also measures how the body pitches between both.
    correlation, found, expected = judged(request.getfixturevalue(road)(ahead_m), pipeline, track)
    assert correlation >= least
    assert found == pytest.approx(expected, rel=off)
    if road == "synthetic":
        assert 1.5 <= expected <= 2.0


def peak(simulation, pipeline, track):
    """Peak of the short-interval roughness profile around the stop, in m/km."""
    profile = floatref.process(simulation.recording, pipeline)
    roughness = short_interval_roughness(profile.track(track).elevation, profile.interval_m)
    return within(profile, roughness, PEAK_M).max()


@pytest.mark.parametrize("pipeline", PIPELINES)
@pytest.mark.parametrize("track", ["left", "right"])
def test_at_a_stop_the_basic_algorithms_fail(stop, pipeline, track):
    correlation, *_ = judged(stop, pipeline, track)
    assert correlation < 0.2
    assert peak(stop, pipeline, track) > 200.0


@pytest.mark.parametrize("pipeline", PIPELINES)
def test_they_fail_with_the_errors_of_other_seeds_too(other_stop, pipeline):
    for track in ("left", "right"):
        assert judged(other_stop, pipeline, track)[0] < 0.2
    # On one of the wheel paths bias and tilt may happen to cancel.
    assert max(peak(other_stop, pipeline, track) for track in ("left", "right")) > 200.0


def velocity_error(simulation, track, at):
    """Error of the SDK's integrated velocity at sample ``at``, in m/s."""
    source = Source(Screening.of(simulation.recording))
    stages = [RemoveGravity(), Integrate("vertical_acceleration", "vertical_velocity")]
    _, blocks = flow.run(stages, source.header, source.blocks())
    channel = ChannelId("vertical_velocity", track)
    velocity = np.concatenate([block[channel] for block in blocks])
    true = simulation.motion.tracks[track].velocity
    return velocity[at] - (true[at] - true[0])


def tilt_and_bias(simulation, track, at):
    """Integral of a_x·sin θ and the bias of the truth up to sample ``at``, in m/s."""
    motion, error = simulation.motion, simulation.errors[track]
    tilt = motion.acceleration * np.sin(motion.pitch + error.pitch_rad)
    return np.sum((tilt + error.bias)[:at]) / float(motion.clock.rate)


def stands(simulation):
    return int(np.flatnonzero(simulation.motion.speed < 1e-6)[0])


@pytest.mark.parametrize("track", ["left", "right"])
def test_the_velocity_error_at_the_stop_is_tilt_and_bias_integrated(stop, track):
    expected = tilt_and_bias(stop, track, stands(stop))
    assert abs(expected) > 0.05
    assert 0.5 <= velocity_error(stop, track, stands(stop)) / expected <= 2.0


@pytest.mark.parametrize("track", ["left", "right"])
def test_what_tilt_and_bias_leave_unexplained_is_small(other_stop, track):
    at = stands(other_stop)
    found = velocity_error(other_stop, track, at)
    assert found == pytest.approx(tilt_and_bias(other_stop, track, at), abs=0.05)
