"""The built-in plug-in: floatref's adapter, stages and pipelines, and the default answers."""

from collections.abc import Callable, Sequence

from floatref.builtin_pipelines.chapter_5 import PIPELINES as PIPELINES
from floatref.builtin_pipelines.chapter_6 import KALMAN
from floatref.builtin_pipelines.registered_stages import STAGES
from floatref.builtin_pipelines.response import RESPONSE
from floatref.builtin_pipelines.road_prior import ROAD_PRIOR, ROAD_PRIOR_IMU, ROAD_PRIOR_SPATIAL
from floatref.builtin_pipelines.signal_flows import DEFAULTS
from floatref.errors import FloatrefError, PluginError
from floatref.interfaces.adapter import Adapter, RecordingDirectory
from floatref.interfaces.drop_out import DropOut
from floatref.interfaces.markers import hookimpl
from floatref.interfaces.pipeline import Answer, Context, Pipeline, stages_of
from floatref.interfaces.profile_format import ProfileDirectory, ProfileFormat, ProfileTable
from floatref.interfaces.recording_format import RecordingFolder, RecordingFormat
from floatref.interfaces.stage_calls import StageCall
from floatref.stages.protocol import Stage
from floatref.values.profile import Profile
from floatref.vehicle_response.needs import FORCE

PIPELINE = "response-joint-input-state"


def road_from_response(asked: DropOut) -> Profile | None:
    """Return the profile of the recording by `PIPELINE`; None without a wheel accelerometer.

    Raises InputError as the pipeline does, for a setup without a vehicle among others.
    """
    if not any(asked.recording.find(FORCE, track) for track in asked.gaps):
        return None
    return asked.process(PIPELINE, {"interval_m": asked.profile.interval_m})


class Defaults:
    """Registers everything built in, and answers every point of all architectures."""

    def __init__(self) -> None:
        """Answer each point with the pipeline's own stages, else the architecture's."""
        for points in DEFAULTS.values():
            for point, answer in points.items():
                setattr(self, point, _wrap_answer(point, answer))

    @hookimpl
    def temporal_fall_back(self, context: DropOut) -> Profile | None:
        """Estimate the road from the vehicle's response, if it was recorded."""
        return road_from_response(context)

    @hookimpl
    def floatref_register_adapters(self, register: Callable[[Adapter], None]) -> None:
        """Register the adapter of the recording directory."""
        register(RecordingDirectory())

    @hookimpl
    def floatref_register_profile_formats(self, register: Callable[[ProfileFormat], None]) -> None:
        """Register the profile directory and the CSV table."""
        register(ProfileDirectory())
        register(ProfileTable())

    @hookimpl
    def floatref_register_recording_formats(
        self, register: Callable[[RecordingFormat], None]
    ) -> None:
        """Register the recording directory."""
        register(RecordingFolder())

    @hookimpl
    def floatref_register_stages(
        self, register: Callable[[str, Callable[..., Stage]], None]
    ) -> None:
        """Register the stages by their class names."""
        for stage in STAGES:
            register(stage.__name__, stage)

    @hookimpl
    def floatref_register_pipelines(self, register: Callable[[Pipeline], None]) -> None:
        """Register the pipelines."""
        road_prior = *ROAD_PRIOR, *ROAD_PRIOR_IMU, *ROAD_PRIOR_SPATIAL
        for pipeline in (*PIPELINES, *KALMAN, *road_prior, *RESPONSE):
            register(pipeline)


def _wrap_answer(point: str, default: Answer) -> Answer:
    def answer(context: Context) -> Sequence[Stage | StageCall]:
        try:
            return stages_of(context.pipeline.answers.get(point, default), context)
        except (FloatrefError, KeyboardInterrupt):
            raise
        except BaseException as error:
            reason = f"{type(error).__name__}: {error}"
            raise PluginError(f"pipeline {context.pipeline.name}: {point}: {reason}") from error

    return hookimpl(answer)
