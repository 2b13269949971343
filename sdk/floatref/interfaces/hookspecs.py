"""Every hook of floatref. A hook registers, or answers one question of an architecture.

An answer is the sequence of new stages for that point of the signal flow, or None to leave it
to others. Hooks are called once per run, never per sample. The order of processing is the
architecture's; two plug-ins that answer the same question stop the run.
"""

from collections.abc import Callable, Sequence

import pluggy

from floatref.engine.fall_back import DropOut
from floatref.engine.question import Pipeline, Question
from floatref.interfaces.adapter import Adapter
from floatref.interfaces.profile_format import ProfileFormat
from floatref.stages.protocol import Stage
from floatref.values.profile import Profile

PROJECT = "floatref"
spec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)
Answer = Sequence[Stage] | None


@spec
def floatref_register_adapters(register: Callable[[Adapter], None]) -> None:
    """Call ``register(adapter)`` for every native format that the plug-in reads."""


@spec
def floatref_register_profile_formats(register: Callable[[ProfileFormat], None]) -> None:
    """Call ``register(format)`` for every kind of profile file that it writes and reads."""


@spec
def floatref_register_stages(register: Callable[[str, Callable[..., Stage]], None]) -> None:
    """Call ``register(name, stage_class)`` for every stage that the plug-in offers."""


@spec
def floatref_register_pipelines(register: Callable[[Pipeline], None]) -> None:
    """Call ``register(pipeline)`` for every pipeline that the plug-in offers."""


@spec
def temporal_condition(context: Question) -> Answer:
    """From raw channels in time to `vertical_acceleration` and `height`."""


@spec
def temporal_first_integration(context: Question) -> Answer:
    """From `vertical_acceleration` to `vertical_velocity`."""


@spec
def temporal_second_integration(context: Question) -> Answer:
    """From `vertical_velocity` to `floating_reference_height`."""


@spec
def temporal_estimate(context: Question) -> Answer:
    """In place of both integrations: an estimator of `floating_reference_height`."""


@spec
def temporal_combine(context: Question) -> Answer:
    """From `floating_reference_height` and `height` to `elevation`."""


@spec
def temporal_project(context: Question) -> Answer:
    """From the time axis to the distance axis."""


@spec
def temporal_finish(context: Question) -> Answer:
    """What is done to `elevation` over distance at the end of the run."""


@spec
def temporal_fall_back(context: DropOut) -> Profile | None:
    """Another profile of the recording, for where its height sensor dropped out."""


@spec
def spatial_condition(context: Question) -> Answer:
    """What happens to the analog signals, in time, before the encoder triggers."""


@spec
def spatial_trigger(context: Question) -> Answer:
    """One sample of every channel, with its `time`, per profile interval."""


@spec
def spatial_time_step(context: Question) -> Answer:
    """From `time` to `time_step`, the step of integration."""


@spec
def spatial_first_integration(context: Question) -> Answer:
    """From `vertical_acceleration` to `vertical_velocity`, over the triggers."""


@spec
def spatial_second_integration(context: Question) -> Answer:
    """From `vertical_velocity` to `floating_reference_height`, over the triggers."""


@spec
def spatial_estimate(context: Question) -> Answer:
    """In place of `time_step` and both integrations: as in time, from and to the triggers."""


@spec
def spatial_combine(context: Question) -> Answer:
    """From `floating_reference_height` and `height` to `elevation`."""


@spec
def response_condition(context: Question) -> Answer:
    """From raw channels in time to accelerations, speed and cut-off."""


@spec
def response_first_integration(context: Question) -> Answer:
    """From accelerations to velocities, where no displacement is measured."""


@spec
def response_second_integration(context: Question) -> Answer:
    """From velocities to displacements; what is measured is filtered as they are."""


@spec
def response_estimate(context: Question) -> Answer:
    """From readings to the road under every tyre, with its 1-σ, at a rate of its own."""


@spec
def response_project(context: Question) -> Answer:
    """From the time axis to the distance axis."""


@spec
def response_finish(context: Question) -> Answer:
    """From the roads under the tyres to `elevation` and `elevation_sigma` where a laser looks."""


@spec
def spatial_finish(context: Question) -> Answer:
    """What is done to `elevation` at the end of the run."""
