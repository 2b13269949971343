"""The Kalman pipelines: their settings act, and what they need is asked for by name."""

import inspect
from collections.abc import Callable
from dataclasses import fields, replace
from functools import cache

import numpy as np
import pytest

import floatref
from floatref.builtin_pipelines.chapter_6 import KALMAN, NOISE, SETTINGS, noise_of
from floatref.engine.run import run
from floatref.errors import InputError
from floatref.estimators.kalman import Noise
from floatref.intake.blocks import Source
from floatref.interfaces.pipeline import Context, Pipeline
from floatref.screening.findings import Screening
from floatref.values.profile import Profile
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground import Scenario, simulate

pytestmark = pytest.mark.slow

PIPELINES = {pipeline.name: pipeline for pipeline in KALMAN}
GNSS_SIGMAS = {name for name in SETTINGS if name.startswith("gnss_")}
ATTITUDE_SIGMAS = {"gnss_pitch_sigma_rad", "gnss_roll_sigma_rad"}
WITHOUT_EFFECT: dict[str, set[str]] = {
    "kalman-filter": {"reflection_density", "height_noise_m", "distance_scale_sigma"},
    "kalman-smoother": {"reflection_density"},
    "kalman-smoother-reflection": set(),
    "kalman-smoother-constant-attitude": ATTITUDE_SIGMAS,
    "kalman-smoother-constant-height-attitude": GNSS_SIGMAS,
}
"""A filter has no sigma of its result; what is not observed has no noise that counts."""
every_pipeline = pytest.mark.parametrize("name", PIPELINES)


@cache
def driven() -> Recording:
    """A brake to a stop of 2 s, without GNSS for a second, without force for a twentieth.

    Behind it the encoder loses a tenth of a second.
    """
    scenario = Scenario(
        manoeuvre="stop",
        event_at_m=130.0,
        dwell_s=2.0,
        length_m=290.0,
        tracks=("left",),
        rate_hz=5000.0,
        profile_interval_m=0.05,
        curvature_per_km=10.0,
    )
    recording = simulate(scenario).recording
    lost = changed(recording, "vertical_specific_force", lambda x: nothing(x, 8000, 8200))
    lost = changed(lost, "distance", lambda x: losing(x, int(np.searchsorted(x, 200.0)), 500))
    return changed(lost, "gnss_quality", lambda x: np.where(np.arange(x.size) // 20 == 3, 1.0, x))


def nothing(values: np.ndarray, begin: int, end: int) -> np.ndarray:
    values[begin:end] = np.nan
    return values


def losing(values: np.ndarray, begin: int, count: int) -> np.ndarray:
    values[begin + count :] -= values[begin + count] - values[begin]
    values[begin : begin + count] = values[begin]
    return values


def changed(
    recording: Recording, name: str, change: Callable[[np.ndarray], np.ndarray]
) -> Recording:
    def of(channel: Channel) -> Channel:
        if channel.id.name != name:
            return channel
        return replace(channel, values=change(channel.values.copy()))

    return replace(recording, channels=tuple(of(channel) for channel in recording.channels))


def without(name: str) -> Recording:
    channels = tuple(c for c in driven().channels if c.id.name != name)
    return replace(driven(), channels=channels)


def profile(recording: Recording, name: str, **settings: float) -> Profile:
    return run(recording, name, settings).profile


@cache
def usual(name: str) -> Profile:
    return profile(driven(), name)


def same(one: Profile, other: Profile) -> bool:
    if one.interval_m != other.interval_m:
        return False
    (a,), (b,) = one.tracks, other.tracks
    arrays = ((a.elevation, b.elevation), (a.sigma, b.sigma), (a.valid, b.valid))
    return all(
        x is y or (x is not None and y is not None and np.array_equal(x, y, equal_nan=True))
        for x, y in arrays
    )


@every_pipeline
@pytest.mark.parametrize("setting", SETTINGS)
def test_every_setting_changes_the_profile_where_it_is_of_any_use(name: str, setting: str) -> None:
    value = PIPELINES[name].settings[setting] or 0.05
    other = profile(driven(), name, **{setting: 2.0 * value})
    assert same(other, usual(name)) == (setting in WITHOUT_EFFECT[name])
    assert other.settings[setting] == 2.0 * value


@every_pipeline
def test_every_field_of_the_noise_is_a_setting_and_has_its_value(name: str) -> None:
    pipeline = PIPELINES[name]
    assert sorted(NOISE.values()) == sorted(field.name for field in fields(Noise))
    given = {setting: 0.5 + k for k, setting in enumerate(NOISE)}
    source = Source(Screening.of(driven()), pipeline.channels)
    context = Context("temporal_estimate", pipeline, given, source.header, source.origin_m)
    noise = noise_of(context)
    for k, field in enumerate(NOISE.values()):
        assert getattr(noise, field) == 0.5 + k


OWN = {
    "kalman-filter": {"acceleration_walk", "lean_sigma_rad", "gnss_height_walk"},
    "kalman-smoother-constant-height-attitude": {
        *("acceleration_walk", "pitch_rate_walk"),
        *("constant_pitch_density", "constant_roll_density"),
    },
}


def test_defaults_are_those_of_the_noise_but_for_the_filter_alone_and_without_gnss() -> None:
    defaults = inspect.signature(Noise).parameters
    for name, pipeline in PIPELINES.items():
        differing = {s for s, f in NOISE.items() if pipeline.settings[s] != defaults[f].default}
        assert differing == OWN.get(name, set())


NEEDS = [
    (name, channel)
    for name, pipeline in PIPELINES.items()
    for channel in (*pipeline.channels, *pipeline.readings)
]


@pytest.mark.parametrize(("name", "channel"), NEEDS)
def test_a_channel_that_is_not_there_is_refused_by_name(name: str, channel: str) -> None:
    with pytest.raises(InputError, match=rf"^channel (left\.)?{channel}: missing"):
        profile(without(channel), name)


@pytest.mark.parametrize(
    ("name", "channels"),
    [
        ("kalman-smoother-constant-attitude", ("gnss_pitch", "gnss_roll")),
        (
            "kalman-smoother-constant-height-attitude",
            ("gnss_height", "gnss_vertical_velocity", "gnss_pitch", "gnss_roll", "gnss_quality"),
        ),
    ],
)
def test_what_is_not_read_may_be_missing(name: str, channels: tuple[str, ...]) -> None:
    for channel in channels:
        assert same(profile(without(channel), name), usual(name))


@every_pipeline
def test_capabilities_are_what_delivers_the_channels_it_needs(name: str) -> None:
    pipeline: Pipeline = PIPELINES[name]
    assert floatref.pipeline_capabilities(name) == pipeline.capabilities
    assert ("gnss" in pipeline.capabilities) == bool(pipeline.readings)
    assert ("imu" in pipeline.capabilities) == bool(pipeline.channels)


@every_pipeline
def test_smoothers_tell_their_sigma_and_the_filter_has_none(name: str) -> None:
    (track,) = usual(name).tracks
    if name == "kalman-filter":
        assert track.sigma is None
    else:
        assert track.sigma is not None
        assert (track.sigma > 0.0).all()
