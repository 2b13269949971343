"""The main job: a recording through a pipeline to a profile.

`run` takes a recording through the steps in order: settle pipeline and settings, screen, prepare
blocks, ask the plug-ins for stages, run the stages, collect the profile. Then it fills the gaps
of the heights.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from floatref.builtin_pipelines.laser_place import bring_abeam, record_laser
from floatref.builtin_pipelines.signal_flows import NEEDS, SIGNAL_FLOWS
from floatref.engine import flow
from floatref.engine.axis_place import Place, first_point
from floatref.engine.collecting import collect_profile
from floatref.engine.fall_back import fill_gaps, gaps_of
from floatref.engine.height_skew import Aligned, align_heights
from floatref.engine.plugins import Plugins, plugins
from floatref.engine.road_distance import RoadDistance, correct_distance
from floatref.engine.steps_back import leave_out_steps_back
from floatref.engine.validity_and_sigma import Reach
from floatref.engine.withdrawing import withdraw
from floatref.errors import InputError
from floatref.intake.blocks import Source
from floatref.intake.kept_blocks import KeptBlocks
from floatref.interfaces.drop_out import DropOut
from floatref.interfaces.pipeline import Context, Pipeline
from floatref.measures.consistency import record_innovations
from floatref.screening.findings import Screening
from floatref.screening.imu_and_gnss import ImuUse
from floatref.stages.protocol import Stage
from floatref.values.block import Axis, Block
from floatref.values.encoder.plausible_distance import check_origins
from floatref.values.profile import Profile
from floatref.values.recording import Recording, check_interval

Progress = Callable[[float], None]


class FloatrefWarning(UserWarning):
    """A warning about a recording or a plug-in that the user of the result should know."""


@dataclass(frozen=True)
class Result:
    """A profile, its warnings of one line each, and the screening of the recording.

    ``innovations`` are those of the pipeline's filters, by wheel path and kind of reading, if kept.
    """

    profile: Profile
    warnings: tuple[str, ...]
    screening: Screening = field(repr=False, compare=False)
    innovations: flow.Kept = field(default_factory=dict, repr=False, compare=False)


def pipelines() -> tuple[str, ...]:
    """Return the names of the pipelines that `process` knows."""
    return tuple(plugins().pipelines())


def pipeline_capabilities(name: str) -> tuple[str, ...]:
    """Return the sensors that pipeline ``name`` needs in addition: "imu", "gnss", "response".

    Raises InputError for a name that `process` does not know.
    """
    return plugins().pipeline(name).capabilities


@dataclass(frozen=True)
class _Order:
    """An order: a recording, the interval of its profile, how to process it, what to keep."""

    plugins: Plugins
    recording: Recording
    pipeline: Pipeline
    settings: Mapping[str, float | None]
    diagnostics: bool = False
    place: Place | None = None

    def origin_of(self, distance_m: float) -> float:
        """Return where the points of the profile begin, of a stream that begins there, in m."""
        if self.place is None:
            return distance_m
        return first_point(distance_m, self.recording.setup.profile_interval_m)


def run(
    recording: Recording,
    pipeline: str,
    settings: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
    known: Screening | None = None,
    diagnostics: bool = False,
    place: Place | None = None,
) -> Result:
    """Return the profile and the warnings; ``progress`` is called with the fraction read.

    Results of ``known``, the screening of an earlier run, for the same channels are reused. With
    ``diagnostics`` the normalized innovations are kept, and summed up in the profile's record;
    InputError for a pipeline without any. ``place`` is where a part of a longer recording lies on
    its axis of distance.
    """
    order = _settle(plugins(), recording, pipeline, settings)
    order = replace(order, diagnostics=diagnostics, place=place)
    check_origins(order.recording.channels)
    forward = leave_out_steps_back(order.recording)
    along = correct_distance(forward.recording, order.settings.get("slip_per_g"))
    if place is not None:
        along = replace(along, recording=place.move(forward.recording, along.recording))
    aligned = align_heights(along.recording)
    order = replace(order, recording=aligned.recording)
    result, source = _make_profile(order, known, progress)
    if order.pipeline.architecture == "temporal":
        result = _bridge_gaps(order, result, source)
    profile = _record_preparation(result.profile, along, aligned)
    profile = withdraw(profile, order.recording, forward.doubts, Reach.of(order.settings).drift_m)
    lines = (*forward.lines, *aligned.warnings, *result.warnings, *order.plugins.reports)
    return replace(result, profile=profile, warnings=lines)


def _record_preparation(profile: Profile, along: RoadDistance, aligned: Aligned) -> Profile:
    """Return ``profile`` with what was done to distance and heights in its record."""
    laser = {
        track: {**own, "later_s": aligned.later_s[track]} if track in aligned.later_s else own
        for track, own in profile.provenance["laser"].items()
    }
    done = {"laser": laser, "distance": along.record}
    return replace(profile, provenance={**profile.provenance, **done})


def _make_profile(
    order: _Order, known: Screening | None = None, progress: Progress | None = None
) -> tuple[Result, Source]:
    """Process a recording into a profile whose gaps are bridged by straight lines."""
    screening = _screen(order, known)
    cautions = screening.cautions  # Raises if the recording cannot be processed.
    source = Source(screening, order.pipeline.channels)
    stages = _ask(order, source)
    if order.diagnostics:
        flow.keep_innovations(stages, order.pipeline.name)
    profile = _run_and_collect(order, source, stages, progress)
    reach_m = Reach.of(order.settings).drift_m
    profile = withdraw(profile, order.recording, screening.doubts, reach_m)
    lines = (*cautions, *source.warnings, *flow.collect_warnings(stages))
    return Result(profile, lines, screening, flow.collect_innovations(stages)), source


def _settle(
    loaded: Plugins, recording: Recording, pipeline: str, settings: Mapping[str, Any] | None
) -> _Order:
    """Settle pipeline, settings and interval, which is the setting's, else the setup's."""
    chosen = loaded.pipeline(pipeline)
    resolved = chosen.resolve(settings or {})
    if "interval_m" not in resolved:
        return _Order(loaded, recording, chosen, resolved)
    interval_m = resolved["interval_m"] or recording.setup.profile_interval_m
    check_interval(interval_m, "setting interval_m")
    setup = replace(recording.setup, profile_interval_m=interval_m)
    resolved["interval_m"] = interval_m
    return _Order(loaded, replace(recording, setup=setup), chosen, resolved)


def _screen(order: _Order, known: Screening | None) -> Screening:
    """Return the screening of the recording, for the channels that the pipeline reads."""
    chosen = order.pipeline
    needs = NEEDS[chosen.architecture](order.recording)
    imu = None
    if chosen.channels:
        imu = ImuUse(needs.tracks, bool(chosen.readings), "gnss_pitch" in chosen.readings)
    return Screening.of(order.recording, needs, imu, known)


def _ask(order: _Order, source: Source) -> list[Stage]:
    """Return the stages that the plug-ins answer at each point of the signal flow."""
    context = partial(
        Context,
        pipeline=order.pipeline,
        settings=order.settings,
        header=source.header,
        origin_m=order.origin_of(source.origin_m),
        fastest_mps=source.fastest_mps,
        ends_m=(order.origin_of(source.ends_m[0]), source.ends_m[1]),
    )
    flow_of = SIGNAL_FLOWS[order.pipeline.architecture]
    stages = flow_of(lambda point: order.plugins.ask(context(point=point)))
    return [*stages, *bring_abeam(source.header.setup, source.header.tracks)]


def _run_and_collect(
    order: _Order, source: Source, stages: list[Stage], progress: Progress | None
) -> Profile:
    """Pass the blocks through the stages and return the resulting profile."""
    read = _Reading(source, 1 + (order.place is None and stages[0].surveys), progress)
    if order.place is None:
        header, blocks = flow.run(stages, source.header, read)
    else:
        # A part of a longer run has a bounded length.
        header, blocks = flow.run(stages, source.header, iter(read), KeptBlocks)
    room = int(source.distance_m / header.step) + 2 if header.axis is Axis.DISTANCE else 0
    profile = collect_profile(header, blocks, order.pipeline, order.settings, room)
    laser = record_laser(header.setup, header.tracks, stages)
    profile = replace(profile, provenance={**profile.provenance, "laser": laser})
    if learned := flow.collect_estimates(stages):
        profile = replace(profile, provenance={**profile.provenance, "learned": learned})
    if order.diagnostics:
        found = record_innovations(flow.collect_innovations(stages))
        profile = replace(profile, provenance={**profile.provenance, "innovations": found})
    return profile


@dataclass
class _Reading:
    """The blocks of ``source``, read ``passes`` times; ``progress`` gets the fraction of it."""

    source: Source
    passes: int
    progress: Progress | None
    begun: int = 0

    def __iter__(self) -> Iterator[Block]:
        """Yield the blocks; each time is one more pass."""
        self.begun += 1
        for block in self.source.blocks():
            yield block
            if self.progress is not None:
                share = (block.first + len(block)) / self.source.length
                self.progress((self.begun - 1 + share) / self.passes)


def _bridge_gaps(order: _Order, result: Result, source: Source) -> Result:
    """Return the result with its height gaps filled, if a plug-in can estimate the road."""
    gaps = gaps_of(order.recording, result.profile, source.gone)
    if not gaps:
        return result

    def process(pipeline: str, settings: Mapping[str, Any] | None = None) -> Profile:
        other = _settle(order.plugins, order.recording, pipeline, settings)
        other = replace(other, place=order.place)
        return _make_profile(other, result.screening)[0].profile

    asked = DropOut(order.recording, result.profile, gaps, process)
    profile, lines = _ask_fall_back(order.plugins, asked)
    return replace(result, profile=profile, warnings=(*result.warnings, *lines))


def _ask_fall_back(loaded: Plugins, asked: DropOut) -> tuple[Profile, tuple[str, ...]]:
    """Return the filled profile and lines on it; the same profile if there is no estimate."""
    try:
        estimate = loaded.fall_back(asked)
    except InputError as error:
        return asked.profile, (
            f"the gaps of the height are bridged by straight lines only: {error}",
        )
    return (asked.profile, ()) if estimate is None else fill_gaps(asked, estimate)
