"""The spatial architecture: the encoder triggers one sample per profile interval.

Trigger → time step → first integration → second integration (or one estimator in place of these
three) → combine → finish. Before the trigger the signals exist in analog form only, which
`spatial_condition` stands for. The defaults are those of section 5.8.
"""

from floatref.interfaces.pipeline import Ask, Defaults
from floatref.pipelines import basic_steps
from floatref.stages.protocol import Stage

DEFAULTS: Defaults = {
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


def signal_flow(ask: Ask) -> list[Stage]:
    """Return all stages in order, from what ``ask`` answers at each point."""
    flow = [*ask("spatial_condition"), *ask("spatial_trigger")]
    estimator = ask("spatial_estimate")
    if estimator:
        flow += estimator
    else:
        for point in INTEGRATIONS:
            flow += ask(point)
    return [*flow, *ask("spatial_combine"), *ask("spatial_finish")]
