"""The main job: a recording through a pipeline to a profile."""

import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from importlib.metadata import version
from typing import Any

from floatref import __version__
from floatref.engine import flow
from floatref.engine.collecting import Gathered, collected
from floatref.engine.fall_back import DropOut, bridged
from floatref.engine.plugins import Plugins, plugins
from floatref.engine.question import Pipeline, Question
from floatref.engine.registration import NEEDS, SIGNAL_FLOWS
from floatref.engine.validity_and_sigma import (
    Reach,
    add_axis_error,
    add_contact_error,
    valid_points,
)
from floatref.errors import InputError
from floatref.intake.blocks import Source
from floatref.screening.imu_and_gnss import check_kinematics
from floatref.screening.plausibility import examine
from floatref.stages.protocol import Stage
from floatref.stages.signals import SIGMA
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.needs import profiled_tracks
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording, check_interval

Progress = Callable[[float], None]


class FloatrefWarning(UserWarning):
    """Something in a recording or a plug-in that the result does not silently hide."""


@dataclass(frozen=True)
class Result:
    """A profile, and one line for each thing its user should know."""

    profile: Profile
    warnings: tuple[str, ...]


def process(
    recording: Recording,
    pipeline: str = "temporal-basic",
    settings: Mapping[str, Any] | None = None,
) -> Profile:
    """Return the profile of ``recording`` by ``pipeline``.

    ``settings`` replaces the pipeline's defaults by name. Warns with `FloatrefWarning`, raises
    InputError for a recording, pipeline or setting that cannot be used and PluginError if two
    plug-ins answer the same question.
    """
    result = run(recording, pipeline, settings)
    for line in result.warnings:
        warnings.warn(line, FloatrefWarning, stacklevel=2)
    return result.profile


def pipelines() -> tuple[str, ...]:
    """Return the names of the pipelines that `process` knows."""
    return tuple(plugins().pipelines())


def pipeline_capabilities(name: str) -> tuple[str, ...]:
    """Return what pipeline ``name`` needs beside nominal sensors, of "imu", "gnss", "response".

    Raises InputError for a name that `process` does not know.
    """
    return plugins().pipeline(name).capabilities


def resolved_settings(name: str, given: Mapping[str, Any]) -> dict[str, float | None]:
    """Return the settings of pipeline ``name`` with those ``given`` in place.

    Raises InputError for a pipeline or a setting that `process` does not know.
    """
    return plugins().pipeline(name).resolve(given)


def run(
    recording: Recording,
    pipeline: str,
    settings: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Result:
    """Return the profile and the warnings; ``progress`` is called with the fraction read."""
    loaded = plugins()
    chosen = loaded.pipeline(pipeline)
    resolved = chosen.resolve(settings or {})
    recording = _at_interval(recording, resolved)
    needs = NEEDS[chosen.architecture](recording)
    cautions = (*examine(recording, needs), *_kinematic_cautions(recording, chosen))
    source = Source(recording, chosen.channels, needs)
    stages = _stages(loaded, chosen, resolved, source)
    header, blocks = flow.run(stages, source.header, _counted(source, progress))
    room = int(source.distance_m / header.step) + 2 if header.axis is Axis.DISTANCE else 0
    profile = _collect(header, blocks, chosen, resolved, room)
    if learned := flow.learned(stages):
        profile = replace(profile, provenance={**profile.provenance, "learned": learned})
    told = (*cautions, *source.warnings, *flow.told(stages))
    if chosen.architecture == "temporal":
        profile, lines = _fallen_back(loaded, DropOut.of(recording, profile, source.gone))
        told = (*told, *lines)
    return Result(profile, (*told, *loaded.reports))


def _fallen_back(loaded: Plugins, asked: DropOut) -> tuple[Profile, tuple[str, ...]]:
    """Return the profile with the gaps of its heights bridged, if a plug-in can tell the road."""
    if not asked.gaps:
        return asked.profile, ()
    try:
        estimate = loaded.fall_back(asked)
    except InputError as error:
        return asked.profile, (f"the height's gaps are bridged by lines alone: {error}",)
    return (asked.profile, ()) if estimate is None else bridged(asked, estimate)


def _kinematic_cautions(recording: Recording, chosen: Pipeline) -> Iterator[str]:
    if not chosen.channels:
        return
    gnss, attitude = bool(chosen.readings), "gnss_pitch" in chosen.readings
    tracks = profiled_tracks(recording)
    lines = (line for t in tracks for line in check_kinematics(recording, t, gnss, attitude))
    yield from dict.fromkeys(lines)


def _at_interval(recording: Recording, resolved: dict[str, float | None]) -> Recording:
    """Settle the interval of a pipeline that has one: the setting's, else the setup's."""
    if "interval_m" not in resolved:
        return recording
    interval_m = resolved["interval_m"] or recording.setup.profile_interval_m
    check_interval(interval_m, "setting interval_m")
    resolved["interval_m"] = interval_m
    return replace(recording, setup=replace(recording.setup, profile_interval_m=interval_m))


def _stages(
    loaded: Plugins, chosen: Pipeline, resolved: Mapping[str, float | None], source: Source
) -> list[Stage]:
    question = partial(
        Question,
        pipeline=chosen,
        settings=resolved,
        header=source.header,
        origin_m=source.origin_m,
        fastest_mps=source.fastest_mps,
        ends_m=source.ends_m,
    )
    return SIGNAL_FLOWS[chosen.architecture](lambda point: loaded.ask(question(point=point)))


def _counted(source: Source, progress: Progress | None) -> Iterator[Block]:
    for block in source.blocks():
        yield block
        if progress is not None:
            progress((block.first + len(block)) / source.length)


def _collect(
    header: Header,
    blocks: Iterable[Block],
    chosen: Pipeline,
    resolved: Mapping[str, Any],
    room: int,
) -> Profile:
    if header.axis is not Axis.DISTANCE:
        raise InputError(f"pipeline {chosen.name} ends on the time axis; it needs a projection")
    known = all(ChannelId(SIGMA, track) in header.channels for track in header.tracks)
    found = collected(blocks, header.tracks, room, known)
    reach = Reach.of(resolved)
    tracks = tuple(
        _track(name, found.pop(name), header.step, reach, resolved) for name in header.tracks
    )
    return Profile(
        interval_m=header.step,
        tracks=tracks,
        start_m=header.origin,
        pipeline=chosen.name,
        settings=resolved,
        provenance={
            "architecture": chosen.architecture,
            "floatref": __version__,
            "numpy": version("numpy"),
        },
    )


def _track(
    name: str, found: Gathered, interval_m: float, reach: Reach, resolved: Mapping[str, Any]
) -> ProfileTrack:
    valid, sigma = valid_points(found.flags, interval_m, reach), found.sigma
    if sigma is not None:
        scale = resolved.get("distance_scale_sigma") or 0.0
        add_axis_error(sigma, found.elevation, interval_m, scale)
        if contact_m := resolved.get("contact_m"):
            add_contact_error(sigma, found.elevation, interval_m, contact_m)
    return ProfileTrack.of(name, found.elevation, valid, sigma)
