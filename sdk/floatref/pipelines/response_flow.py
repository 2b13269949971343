"""The response architecture: the road from how the vehicle answers it, without a height sensor.

Condition → first integration → second integration → estimate → project to distance → finish.
The integrations make displacements where none is measured; an estimator of unknown inputs turns
the readings into the road under every tyre. The defaults are those of
`response-joint-input-state`.
"""

from floatref.interfaces.pipeline import Ask, Defaults
from floatref.pipelines import response as steps
from floatref.stages.protocol import Stage

DEFAULTS: Defaults = {
    "response_condition": steps.condition,
    "response_first_integration": steps.first_integration,
    "response_second_integration": steps.second_integration,
    "response_estimate": steps.estimate_jointly,
    "response_project": steps.project,
    "response_finish": steps.finish,
}


def signal_flow(ask: Ask) -> list[Stage]:
    """Return all stages in order, from what ``ask`` answers at each point."""
    return [stage for point in DEFAULTS for stage in ask(point)]
