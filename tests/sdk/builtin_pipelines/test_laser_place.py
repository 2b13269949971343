"""A laser beside its accelerometer costs next to nothing, and the profile says what was done."""

from dataclasses import replace

import numpy as np
import pytest

from floatref import AxleSetup, Setup, TrackSetup, pipelines
from floatref.engine.run import run
from floatref.measures import cross_correlation, high_pass, iri_trace
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate

LEVER_M = 0.3
NOMINAL = [name for name in pipelines() if name.startswith(("temporal", "spatial", "road-prior"))]
NOMINAL.remove("road-prior-smoother-imu")
MEASURED = [name for name in pipelines() if name.startswith("kalman-smoother")]
MEASURED.append("road-prior-smoother-imu")
PLAIN = {"slip_percent_per_g": 0.0, "rate_hz": 2000.0, "response": False}


def driven(manoeuvre: str, lever_m: float, **numbers: object) -> Simulation:
    more = {**PLAIN, **numbers}
    return simulate(Scenario(manoeuvre=manoeuvre, laser_ahead_m=lever_m, **more))  # type: ignore[arg-type]  # Numbers by name.


def correlation(made: Simulation, profile: Profile, begin_m: float, end_m: float) -> float:
    """Return the least cross correlation with the road after the IRI filter, within a stretch."""
    found, step = [], profile.interval_m
    inside = slice(round(begin_m / step), round(end_m / step))
    for track in profile.tracks:
        road = np.interp(profile.distance_m, made.truth.distance_m, _road(made, track.name))
        expected = iri_trace(high_pass(road, step), step)[inside]
        trace = iri_trace(np.nan_to_num(track.elevation), step)[inside]
        found.append(cross_correlation(expected, trace, step, 1.0).cross_correlation)
    return min(found)


def _road(made: Simulation, track: str) -> np.ndarray:
    return made.truth.track(track).elevation


@pytest.fixture(scope="module")
def constant() -> Simulation:
    return driven("constant", LEVER_M)


@pytest.fixture(scope="module")
def stop() -> Simulation:
    return driven("stop", LEVER_M)


@pytest.mark.slow
@pytest.mark.parametrize("name", MEASURED)
def test_a_measured_pitch_leaves_nothing_of_the_lever(stop: Simulation, name: str) -> None:
    """0.3 m ahead costs 0.005 of r or less; ignored it costs 0.05 and more."""
    result = run(stop.recording, name)
    assert correlation(stop, result.profile, 235.6, 396.4) >= 0.985
    assert result.profile.provenance["laser"]["left"]["pitch"] == "measured"


@pytest.mark.slow
@pytest.mark.parametrize("name", NOMINAL)
def test_a_modelled_pitch_leaves_little(constant: Simulation, name: str) -> None:
    """At constant speed: ignored it costs 0.02."""
    result = run(constant.recording, name)
    assert correlation(constant, result.profile, 150.0, 350.0) >= 0.994
    record = result.profile.provenance["laser"]["right"]
    assert (record["pitch"], record["axles"]) == ("modelled", "setup")


def setup(left_m: float, right_m: float, axles: AxleSetup | None = None) -> Setup:
    places = {"left": left_m, "right": right_m}
    tracks = {t: TrackSetup((-1.0, 0.0, 0.3), (x, 0.0, 0.0)) for t, x in places.items()}
    return Setup(0.05, tracks=tracks, axles=axles)


def recorded(constant: Simulation, own: Setup) -> Recording:
    return replace(constant.recording, setup=own)


@pytest.mark.slow
def test_without_a_lever_the_axles_change_nothing(constant: Simulation) -> None:
    plain, known = (
        run(recorded(constant, setup(0.0, 0.0, axles)), "temporal-basic").profile
        for axles in (None, AxleSetup(2.5, 1.0))
    )
    for one, other in zip(plain.tracks, known.tracks, strict=True):
        np.testing.assert_array_equal(one.elevation, other.elevation)
    assert plain.provenance["laser"]["left"] == {
        "ahead_m": -1.0, "shift_m": 0.0, "lever_m": 0.0, "pitch": "not needed"
    }  # fmt: skip


@pytest.mark.slow
def test_lasers_that_are_not_abeam_are_brought_onto_one_axis(constant: Simulation) -> None:
    """A wheel path whose laser is said to be 1 m ahead of the other one's lies 1 m farther."""
    ahead = TrackSetup((1.0, 0.0, 0.0))
    beside, far, unknown = (
        run(recorded(constant, Setup(0.05, tracks=places)), "temporal-basic").profile
        for places in ({}, {"left": TrackSetup(), "right": ahead}, {"right": ahead})
    )
    right, plain = far.track("right"), beside.track("right")
    np.testing.assert_array_equal(far.track("left").elevation, beside.track("left").elevation)
    np.testing.assert_array_equal(right.elevation[20:], plain.elevation[:-20])
    assert np.isnan(right.elevation[:20]).all()
    assert not right.valid[:20].any()
    assert far.provenance["laser"]["right"]["shift_m"] == 1.0
    np.testing.assert_array_equal(unknown.track("right").elevation, plain.elevation)
