"""The road prior from triggered samples: as from all samples, where triggers tell as much."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from floatref.builtin_pipelines.road_prior import ROAD_PRIOR_SPATIAL
from floatref.engine.run import run
from floatref.measures import agreement, high_pass, iri
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.proving_ground import Scenario, Simulation, simulate

pytestmark = pytest.mark.slow

(PIPELINE,) = ROAD_PRIOR_SPATIAL
IN_TIME = "road-prior-smoother"
STOP_M = 150.0


@cache
def driven(manoeuvre: str = "stop", dwell_s: float = 2.0, **numbers: float) -> Simulation:
    scenario = Scenario(
        manoeuvre=manoeuvre,
        dwell_s=dwell_s,
        seed=7,
        slip_percent_per_g=0.3,
        laser_ahead_m=0.0,
        event_at_m=STOP_M,
        length_m=310.0,
        tracks=("left",),
        rate_hz=5000.0,
        profile_interval_m=0.02,
        imu=False,
        gnss=False,
    )
    return simulate(replace(scenario, **numbers))


def without_counts(recording: Recording, begin: int, size: int) -> tuple[Recording, float]:
    """Return ``recording`` without the encoder's counts of some samples, and the way lost in m."""
    channels = []
    lost_m = 0.0
    for channel in recording.channels:
        values = channel.values.copy()
        if channel.id.name == "distance":
            lost_m = values[begin + size] - values[begin]
            values[begin + size :] -= lost_m
            values[begin : begin + size] = values[begin]
        channels.append(replace(channel, values=values))
    return replace(recording, channels=tuple(channels)), lost_m


@cache
def damaged() -> Recording:
    """A stop, lost counts behind it, and before it a twentieth of a second without force."""
    whole = driven().recording
    distance, channels = whole.channel("distance", "left").values, []
    recording, _ = without_counts(whole, int(np.searchsorted(distance, 220.0)), 500)
    for channel in recording.channels:
        values = channel.values.copy()
        if channel.id.name == "vertical_specific_force":
            values[20000:20250] = np.nan
        channels.append(replace(channel, values=values))
    return replace(recording, channels=tuple(channels))


def profile(recording: Recording, pipeline: str = PIPELINE.name, **settings: float) -> Profile:
    # So short a run is unsure all the way; what else makes it invalid shall be seen.
    lenient = {"most_sigma_share": 2.0} if pipeline.startswith("road-prior") else {}
    return run(recording, pipeline, {**lenient, **settings}).profile


@cache
def usual() -> Profile:
    return profile(damaged())


@pytest.mark.parametrize("setting", PIPELINE.settings)
def test_every_setting_changes_the_profile(setting: str, assert_other) -> None:
    # What is vouched for is set above; there is less of it with less.
    factor = 0.1 if setting == "most_sigma_share" else 2.0
    other = profile(damaged(), **{setting: factor * (PIPELINE.settings[setting] or 0.02)})
    assert_other(other, usual())


def test_all_points_have_elevation_and_sigma_whatever_is_missing(assert_all_known) -> None:
    (track,) = assert_all_known(usual())
    (beside,) = profile(damaged(), IN_TIME).tracks
    # Flags of the accelerometer come some milliseconds earlier, as its filter's delay is taken off.
    assert np.count_nonzero(track.valid != beside.valid) <= 5


@pytest.mark.parametrize("speed_kmh", [30.0, 90.0])
def test_at_a_constant_speed_it_is_the_profile_from_all_samples(speed_kmh: float) -> None:
    """Triggers come every 0.8 to 2.4 ms; tenths of a millimetre of the road's centimetres."""
    recording = driven("constant", speed_kmh=speed_kmh).recording
    (ours,), (all_samples,) = (profile(recording, name).tracks for name in (PIPELINE.name, IN_TIME))
    inside = slice(2500, -2500)
    apart = np.abs(ours.elevation - all_samples.elevation)[inside]
    assert np.abs(all_samples.elevation).max() > 5e-3
    assert apart.max() < 3e-4
    assert iri(ours.elevation[inside], 0.02) == pytest.approx(
        iri(all_samples.elevation[inside], 0.02), rel=2e-3
    )


@pytest.mark.parametrize("dwell_s", [0.0, 0.5, 3.0, 45.0])
def test_the_elevation_goes_on_whatever_the_stop_lasts(dwell_s: float) -> None:
    simulation = driven(dwell_s=dwell_s)
    (track,) = profile(simulation.recording).tracks
    true = simulation.truth.track("left").elevation
    size = min(true.size, track.elevation.size)
    expected, ours = high_pass(true, 0.02)[:size], track.elevation[:size]
    around = slice(round((STOP_M - 2.0) / 0.02), round((STOP_M + 2.0) / 0.02))
    steps = np.diff(ours[around]) - np.diff(expected[around])
    assert np.abs(steps).max() < 1e-3
    inside = slice(round(60.0 / 0.02), round(250.0 / 0.02))
    alike = agreement(expected[inside], ours[inside], 0.02).cross_correlation
    assert alike > 0.97
    assert iri(ours[inside], 0.02) == pytest.approx(iri(expected[inside], 0.02), rel=0.02)
    assert track.sigma is not None
    assert np.mean(np.abs(ours - expected)[inside] < 2.0 * track.sigma[inside]) > 0.9


def test_a_stop_makes_less_known_around_it_and_so_does_creeping() -> None:
    (stopped,) = profile(driven(dwell_s=3.0).recording).tracks
    (passing,) = profile(driven("constant").recording).tracks
    (creeping,) = profile(
        driven("creeping", speed_kmh=1.0, event_speed_kmh=4.0, length_m=60.0).recording
    ).tracks
    assert stopped.sigma is not None
    assert passing.sigma is not None
    assert creeping.sigma is not None
    at = round(STOP_M / 0.02)
    assert stopped.sigma[at - 100 : at + 100].min() > 2.0 * np.median(passing.sigma)
    assert np.median(creeping.sigma) > 2.0 * np.median(passing.sigma)


def test_a_point_for_each_trigger() -> None:
    recording = driven().recording
    ours, beside = profile(recording), profile(recording, "spatial-basic")
    assert (ours.start_m, ours.interval_m) == (beside.start_m, beside.interval_m)
    assert ours.tracks[0].elevation.size == beside.tracks[0].elevation.size
    assert ours.provenance["architecture"] == "spatial"


def errors(simulation: Simulation, recording: Recording, lost_at: int, lost_m: float) -> np.ndarray:
    """Return the errors at valid points, but for the ends of the run.

    Points from ``lost_at`` on lie ``lost_m`` further on the road.
    """
    (track,) = profile(recording).tracks
    true = high_pass(simulation.truth.track("left").elevation, 0.02)
    at = np.arange(track.elevation.size)
    place = np.round(at + (at >= lost_at) * lost_m / 0.02).astype(int)
    inside = (at > 1500) & (place < true.size - 1500)
    assert track.valid is not None
    checked = inside & track.valid
    assert checked.sum() > 0.6 * inside.sum()
    return track.elevation[checked] - true[place[checked]]


@pytest.mark.parametrize("lost_s", [0.02, 0.1])
def test_lost_counts_seconds_before_a_brake_do_not_spoil_the_stop(lost_s: float) -> None:
    """A brake that is none, of some 100 m/s², would be learned as lean and tilt."""
    simulation = driven()
    whole = simulation.recording
    distance = whole.channel("distance", "left").values
    begin = int(np.searchsorted(distance, 60.0))
    damaged, lost_m = without_counts(whole, begin, round(lost_s * 5000.0))
    usual = np.abs(errors(simulation, whole, 0, 0.0)).max()
    found = np.abs(errors(simulation, damaged, round(60.0 / 0.02), lost_m)).max()
    assert found < 2.0 * usual


def test_the_elevation_goes_on_where_counts_were_lost() -> None:
    """Both sides of the place are next to each other: no step that the road has not elsewhere."""
    whole = driven().recording
    distance = whole.channel("distance", "left").values
    damaged, _ = without_counts(whole, int(np.searchsorted(distance, 220.0)), 500)
    (usual,), (found,) = (profile(recording).tracks for recording in (whole, damaged))
    near = slice(round(219.5 / 0.02), round(220.5 / 0.02))
    around = slice(round(210.0 / 0.02), round(230.0 / 0.02))
    steps = np.abs(np.diff(usual.elevation[around])).max()
    assert np.abs(np.diff(found.elevation[near])).max() < 1.5 * steps
