"""The RoadLogger's pipeline: one of floatref's, with our stage before its first."""

from collections.abc import Sequence

import floatref
from floatref import Context, Setting, Stage, StageCall

NAME = "acme-roadlogger"
BASE = floatref.pipeline("temporal-adaptive-hpf-spatial-backward")


def condition(context: Context) -> Sequence[Stage | StageCall]:
    """Remove spikes first: a filter would spread them."""
    spikes = StageCall("RemoveSpikes", Setting("spike_m"))
    return (spikes, *BASE.stages_at(context))


PIPELINE = BASE.with_answers(
    name=NAME,
    summary="adaptive cut-off, after the spikes of our laser are removed",
    settings={"spike_m": 0.01},
    temporal_condition=condition,
)
