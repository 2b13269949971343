"""The three architectures: each is a signal flow with named points, and a default answer for each.

`temporal` processes in time until the profile is projected to distance: laser → condition → first
integration → second integration (or one estimator in place of both) → combine with height →
project → finish. Its defaults are those of section 5.3.

`spatial` takes one sample per profile interval, which the encoder triggers: laser → trigger → time
step → first integration → second integration (or one estimator in place of these three) → combine →
finish. Before the trigger the signals are analog; `spatial_condition` models this part. Its
defaults are those of section 5.8.

`response` uses the vehicle's response in place of a height sensor: condition → first integration →
second integration → estimate → project → finish. The integrations give the displacements that are
not measured; an estimator of unknown inputs turns the readings into the road under every tyre. Its
defaults are those of `response-joint-input-state`.
"""

from floatref.builtin_pipelines import basic_steps, response
from floatref.builtin_pipelines.laser_place import carry_height
from floatref.interfaces.pipeline import Ask, Defaults
from floatref.stages.protocol import Stage
from floatref.values.needs import nominal_needs
from floatref.vehicle_response.needs import response_needs

TEMPORAL: Defaults = {
    "temporal_laser": carry_height,
    "temporal_condition": basic_steps.condition,
    "temporal_first_integration": basic_steps.first_integration,
    "temporal_second_integration": basic_steps.second_integration,
    "temporal_estimate": (),
    "temporal_combine": basic_steps.combine,
    "temporal_project": basic_steps.project,
    "temporal_finish": basic_steps.finish,
}
SPATIAL: Defaults = {
    "spatial_laser": carry_height,
    "spatial_condition": basic_steps.condition,
    "spatial_trigger": basic_steps.trigger,
    "spatial_time_step": basic_steps.time_step,
    "spatial_first_integration": basic_steps.first_integration,
    "spatial_second_integration": basic_steps.second_integration,
    "spatial_estimate": (),
    "spatial_combine": basic_steps.combine,
    "spatial_finish": basic_steps.finish,
}
INTEGRATIONS = "spatial_time_step", "spatial_first_integration", "spatial_second_integration"
RESPONSE: Defaults = {
    "response_condition": response.condition,
    "response_first_integration": response.first_integration,
    "response_second_integration": response.second_integration,
    "response_estimate": response.estimate_jointly,
    "response_project": response.project,
    "response_finish": response.finish,
}


def flow_in_time(ask: Ask) -> list[Stage]:
    """Return all stages in order, from the answers of ``ask`` at each point of `temporal`."""
    flow = [*ask("temporal_laser"), *ask("temporal_condition")]
    estimator = ask("temporal_estimate")
    if estimator:
        flow += estimator
    else:
        flow += ask("temporal_first_integration")
        flow += ask("temporal_second_integration")
    for point in ("temporal_combine", "temporal_project", "temporal_finish"):
        flow += ask(point)
    return flow


def flow_over_distance(ask: Ask) -> list[Stage]:
    """Return all stages in order, from the answers of ``ask`` at each point of `spatial`."""
    flow = [*ask("spatial_laser"), *ask("spatial_condition"), *ask("spatial_trigger")]
    estimator = ask("spatial_estimate")
    if estimator:
        flow += estimator
    else:
        for point in INTEGRATIONS:
            flow += ask(point)
    return [*flow, *ask("spatial_combine"), *ask("spatial_finish")]


def flow_from_response(ask: Ask) -> list[Stage]:
    """Return all stages in order, from the answers of ``ask`` at each point of `response`."""
    return [stage for point in RESPONSE for stage in ask(point)]


SIGNAL_FLOWS = {
    "temporal": flow_in_time,
    "spatial": flow_over_distance,
    "response": flow_from_response,
}
DEFAULTS = {"temporal": TEMPORAL, "spatial": SPATIAL, "response": RESPONSE}
NEEDS = {"temporal": nominal_needs, "spatial": nominal_needs, "response": response_needs}
