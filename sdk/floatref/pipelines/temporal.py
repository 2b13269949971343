"""The temporal architecture: all in time until the profile is projected to distance.

Condition → first integration → second integration (or one estimator in place of both) →
combine with height → project to distance → finish. The defaults are those of section 5.3.
"""

from floatref.interfaces.pipeline import Ask, Defaults
from floatref.pipelines import basic_steps
from floatref.stages.protocol import Stage

DEFAULTS: Defaults = {
    "temporal_condition": basic_steps.condition,
    "temporal_first_integration": basic_steps.first_integration,
    "temporal_second_integration": basic_steps.second_integration,
    "temporal_estimate": (),
    "temporal_combine": basic_steps.combine,
    "temporal_project": basic_steps.project,
    "temporal_finish": basic_steps.finish,
}


def signal_flow(ask: Ask) -> list[Stage]:
    """Return all stages in order, from what ``ask`` answers at each point."""
    flow = list(ask("temporal_condition"))
    estimator = ask("temporal_estimate")
    if estimator:
        flow += estimator
    else:
        flow += ask("temporal_first_integration")
        flow += ask("temporal_second_integration")
    for point in ("temporal_combine", "temporal_project", "temporal_finish"):
        flow += ask(point)
    return flow
