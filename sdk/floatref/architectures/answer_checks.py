"""What a plug-in may answer: stages or calls of stages at a point, a profile for a fall-back."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from floatref.architectures.pipeline import Context
from floatref.architectures.stage_calls import StageCall
from floatref.errors import FloatrefError, PluginError
from floatref.stages.protocol import Stage
from floatref.values.profile import Profile

Classes = Mapping[str, Callable[..., Stage]]


def check_profile(answer: Any, who: str) -> Profile:
    """Return ``answer``; PluginError, naming ``who`` gave it, if it is no profile."""
    if isinstance(answer, Profile):
        return answer
    raise PluginError(f"{who}: answered temporal_fall_back with {_kind(answer)}, no profile")


def check_stages(
    answer: Any, who: str, context: Context, known: Callable[[], Classes]
) -> Sequence[Stage]:
    """Return the stages of ``answer``, its calls made; ``known`` returns the classes by name.

    Raises PluginError, naming ``who`` gave it, for anything else and for a call that fails.
    """
    if not isinstance(answer, Sequence):
        raise PluginError(f"{who}: answered {context.point} with {_kind(answer)}, no stages")
    calls = any(isinstance(item, StageCall) for item in answer)
    classes = known() if calls else {}
    return [_stage(item, who, context, classes) for item in answer]


def _stage(item: Any, who: str, context: Context, classes: Classes) -> Stage:
    if isinstance(item, Stage):
        return item
    if not isinstance(item, StageCall):
        raise PluginError(f"{who}: answered {context.point} with {_kind(item)}, no stages")
    try:
        return item.make(classes, context.setting)
    except FloatrefError as error:
        raise PluginError(f"{who}: {context.point}: {error}") from error


def _kind(answer: Any) -> str:
    return type(answer).__name__
