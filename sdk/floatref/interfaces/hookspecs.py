"""Every hook of floatref. A hook registers, or answers one point of an architecture.

An answer is the sequence of new stages for that point of the signal flow, or None for no answer. It
applies only to the pipelines that its function names by `answers`, and replaces their own stages.
Hooks are called once per run, never per sample. The architecture sets the order of processing; two
plug-ins that answer the same point of a pipeline stop the run.
"""

from collections.abc import Callable, Sequence
from typing import Any

from floatref.interfaces.adapter import Adapter
from floatref.interfaces.drop_out import DropOut
from floatref.interfaces.markers import hookspec
from floatref.interfaces.pipeline import Context, Pipeline
from floatref.interfaces.profile_format import ProfileFormat
from floatref.interfaces.recording_format import RecordingFormat
from floatref.interfaces.stage_calls import StageCall
from floatref.stages.protocol import Stage
from floatref.values.profile import Profile

Answer = Sequence[Stage | StageCall] | None


@hookspec
def floatref_register_adapters(register: Callable[[Adapter], None]) -> None:
    """Call ``register(adapter)`` for every native format that the plug-in reads."""


@hookspec
def floatref_register_profile_formats(register: Callable[[ProfileFormat], None]) -> None:
    """Call ``register(format)`` for every kind of profile file of the plug-in."""


@hookspec
def floatref_register_recording_formats(register: Callable[[RecordingFormat], None]) -> None:
    """Call ``register(format)`` for every kind of recording file that the plug-in writes."""


@hookspec
def floatref_register_stages(register: Callable[[str, Callable[..., Stage]], None]) -> None:
    """Call ``register(name, stage_class)`` for every stage that the plug-in offers."""


@hookspec
def floatref_register_pipelines(register: Callable[[Pipeline], None]) -> None:
    """Call ``register(pipeline)`` for every pipeline that the plug-in offers."""


@hookspec
def floatref_register_views(register: Callable[[str, Callable[[Any], Any]], None]) -> None:
    """Call ``register(name, view)`` for every table of another library that the plug-in makes.

    ``profile_to_pandas`` and ``profile_to_xarray`` are called with a `Profile`,
    ``recording_to_pandas`` and ``recording_to_xarray`` with a `Recording`.
    """


@hookspec
def temporal_laser(context: Context) -> Answer:
    """From the `height` under the laser to that in its accelerometer's place; both are raw."""


@hookspec
def temporal_condition(context: Context) -> Answer:
    """From raw channels in time to `vertical_acceleration` and `height`."""


@hookspec
def temporal_first_integration(context: Context) -> Answer:
    """From `vertical_acceleration` to `vertical_velocity`."""


@hookspec
def temporal_second_integration(context: Context) -> Answer:
    """From `vertical_velocity` to `floating_reference_height`."""


@hookspec
def temporal_estimate(context: Context) -> Answer:
    """In place of both integrations: an estimator of `floating_reference_height`."""


@hookspec
def temporal_combine(context: Context) -> Answer:
    """From `floating_reference_height` and `height` to `elevation`."""


@hookspec
def temporal_project(context: Context) -> Answer:
    """From the time axis to the distance axis."""


@hookspec
def temporal_finish(context: Context) -> Answer:
    """Processing of `elevation` over distance at the end of the run."""


@hookspec
def temporal_fall_back(context: DropOut) -> Profile | None:
    """Another profile of the recording, for where its height sensor dropped out."""


@hookspec
def spatial_laser(context: Context) -> Answer:
    """As `temporal_laser`, in time, before the analog signals are processed."""


@hookspec
def spatial_condition(context: Context) -> Answer:
    """Processing of the analog signals, in time, before the encoder triggers."""


@hookspec
def spatial_trigger(context: Context) -> Answer:
    """One sample of every channel, with its `time`, per profile interval."""


@hookspec
def spatial_time_step(context: Context) -> Answer:
    """From `time` to `time_step`, the step of integration."""


@hookspec
def spatial_first_integration(context: Context) -> Answer:
    """From `vertical_acceleration` to `vertical_velocity`, over the triggers."""


@hookspec
def spatial_second_integration(context: Context) -> Answer:
    """From `vertical_velocity` to `floating_reference_height`, over the triggers."""


@hookspec
def spatial_estimate(context: Context) -> Answer:
    """In place of `time_step` and both integrations: an estimator as in time, on the triggers."""


@hookspec
def spatial_combine(context: Context) -> Answer:
    """From `floating_reference_height` and `height` to `elevation`."""


@hookspec
def response_condition(context: Context) -> Answer:
    """From raw channels in time to accelerations, speed and cut-off."""


@hookspec
def response_first_integration(context: Context) -> Answer:
    """From accelerations to velocities, where no displacement is measured."""


@hookspec
def response_second_integration(context: Context) -> Answer:
    """From velocities to displacements; measured displacements get the same filters."""


@hookspec
def response_estimate(context: Context) -> Answer:
    """From readings to the road under every tyre, with its 1-σ, at a rate of its own."""


@hookspec
def response_project(context: Context) -> Answer:
    """From the time axis to the distance axis."""


@hookspec
def response_finish(context: Context) -> Answer:
    """From the roads under the tyres to `elevation` and `elevation_sigma` under a laser."""


@hookspec
def spatial_finish(context: Context) -> Answer:
    """Processing of `elevation` at the end of the run."""
