"""The RoadLogger's pipeline: one of floatref's, with our stage before its first."""

from collections.abc import Sequence
from dataclasses import replace

from floatref.engine.question import Question

from acme_roadlogger.spikes import RemoveSpikes
from floatref.pipelines.chapter_5 import PIPELINES
from floatref.stages.protocol import Stage

NAME = "acme-roadlogger"
BASE = next(p for p in PIPELINES if p.name == "temporal-adaptive-hpf-spatial-backward")


def condition(question: Question) -> Sequence[Stage]:
    """Remove spikes first: a filter would spread them."""
    spikes = RemoveSpikes(question.setting("spike_m"))
    return (spikes, *BASE.answers["temporal_condition"](question))


PIPELINE = replace(
    BASE,
    name=NAME,
    summary="adaptive cut-off, after the spikes of our laser are removed",
    settings={**BASE.settings, "spike_m": 0.01},
    answers={**BASE.answers, "temporal_condition": condition},
)
