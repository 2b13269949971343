"""Checks of what a plug-in registers, made at registration, so that nothing fails later."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import pluggy

from floatref.builtin_pipelines.signal_flows import DEFAULTS, SIGNAL_FLOWS
from floatref.errors import FloatrefError, PluginError
from floatref.interfaces.markers import SCOPE
from floatref.interfaces.pipeline import Context, Pipeline
from floatref.interfaces.profile_format import ProfileDirectory
from floatref.interfaces.recording_format import RecordingFolder
from floatref.interfaces.stage_calls import StageCall
from floatref.stages.protocol import Stage
from floatref.values.profile import Profile


def check_pipeline(pipeline: Any) -> str:
    """Return the name of ``pipeline``; TypeError unless its architecture is known."""
    if not isinstance(pipeline, Pipeline):
        raise TypeError(f"{type(pipeline).__name__} is not a Pipeline")
    if pipeline.architecture not in SIGNAL_FLOWS:
        raise TypeError(f"pipeline {pipeline.name}: no architecture {pipeline.architecture!r}")
    for point, answer in pipeline.answers.items():
        if point not in DEFAULTS[pipeline.architecture]:
            raise TypeError(f"pipeline {pipeline.name}: no point {point!r} to answer")
        if not callable(answer) and not _are_calls(answer):
            raise TypeError(f"pipeline {pipeline.name}: {point}: give StageCalls, or a function")
    return _describe(pipeline)


def complete_pipeline(pipeline: Pipeline) -> Pipeline:
    """Return ``pipeline`` with its architecture's answer at every point it does not answer."""
    return replace(pipeline, answers={**DEFAULTS[pipeline.architecture], **pipeline.answers})


def _are_calls(answer: Any) -> bool:
    return isinstance(answer, Sequence) and all(isinstance(call, StageCall) for call in answer)


def check_adapter(adapter: Any) -> str:
    """Return the name of ``adapter``; TypeError if it cannot be one."""
    kind = type(adapter).__name__
    if not callable(getattr(adapter, "recognises", None)):
        raise TypeError(f"{kind} has no method recognises")
    if not any(callable(getattr(adapter, method, None)) for method in ("read", "streams")):
        raise TypeError(f"{kind} has neither a method read nor one called streams")
    return _describe(adapter)


def check_profile_format(form: Any) -> str:
    """Return the name of ``form``; TypeError if it cannot be a format of profile files."""
    return _check_format(form, ("recognises", "read", "write"))


def check_recording_format(form: Any) -> str:
    """Return the name of ``form``; TypeError if it cannot be a format of recording files."""
    return _check_format(form, ("write",))


def _check_format(form: Any, methods: Sequence[str]) -> str:
    kind = type(form).__name__
    for method in methods:
        if not callable(getattr(form, method, None)):
            raise TypeError(f"{kind} has no method {method}")
    suffix = getattr(form, "suffix", None)
    named = isinstance(suffix, str) and re.fullmatch(r"\.[a-z]+[0-9]?", suffix)
    if not (named or isinstance(form, ProfileDirectory | RecordingFolder)):
        raise TypeError(f"{kind}: suffix {suffix!r} is not a point and small letters, as in .erd")
    return _describe(form)


def check_stage(name: Any, stage: Any) -> str:
    """Return ``name``; TypeError unless it is text and ``stage`` makes one."""
    if not isinstance(name, str) or not callable(stage):
        raise TypeError(f"{name!r} is not the name of a stage class")
    return name


class Register:
    """The items that plug-ins registered through one hook, by name.

    Raises PluginError, with both names, when two register the same.
    """

    def __init__(self, check: Callable[..., str]) -> None:
        """Check every item with ``check``, which returns its name."""
        self.found: dict[str, Any] = {}
        self._check, self._owners = check, dict[str, str]()

    def of(self, plugin: str) -> Callable[..., None]:
        """Return the function with which the hook of ``plugin`` is called."""

        def register(*item: Any) -> None:
            name = self._check(*item)
            if name in self.found:
                both = f"{self._owners[name]} and {plugin}"
                raise PluginError(f"plug-ins {both} both register {name}; remove one")
            self.found[name], self._owners[name] = item[-1], plugin

        return register


def _describe(item: Any) -> str:
    name, summary = getattr(item, "name", None), getattr(item, "summary", None)
    if not (isinstance(name, str) and name and isinstance(summary, str)):
        raise TypeError(f"{type(item).__name__} needs a name and a summary")
    return name


REGISTERS = "floatref_register_"
"""Start of the name of every hook that registers and answers no point."""


def scope_of(implementation: pluggy.HookImpl) -> tuple[str, ...]:
    """Return the pipelines that an implementation of a point names; () for a built-in one."""
    return tuple(getattr(implementation.function, SCOPE, ()))


def check_scopes(manager: pluggy.PluginManager, plugin: str) -> None:
    """Raise PluginError if ``plugin`` answers a point and names no pipeline for it."""
    for point, implementation in _find_answers(manager):
        if implementation.plugin_name == plugin and not scope_of(implementation):
            raise PluginError(
                f"{point} names no pipeline that it answers; write "
                f'@floatref.answers("NAME OF A PIPELINE") in place of @hookimpl'
            )


def unknown_scopes(manager: pluggy.PluginManager, known: Mapping[str, Pipeline]) -> Iterator[str]:
    """Yield a line for each pipeline that a plug-in names and that has no such point."""
    for point, implementation in _find_answers(manager):
        for name in scope_of(implementation):
            who = f"plug-in {implementation.plugin_name}: {point} names pipeline {name}"
            if name not in known:
                yield f"{who}, which is unknown; it is answered nowhere"
            elif not point.startswith(f"{known[name].architecture}_"):
                yield f"{who}, which is {known[name].architecture} and has no such point"


def _find_answers(manager: pluggy.PluginManager) -> Iterator[tuple[str, pluggy.HookImpl]]:
    for point, caller in vars(manager.hook).items():
        if not point.startswith(("_", REGISTERS)):
            yield from ((point, found) for found in caller.get_hookimpls())


Classes = Mapping[str, Callable[..., Stage]]


def check_profile(answer: Any, who: str) -> Profile:
    """Return ``answer``; PluginError, naming ``who`` gave it, if it is not a profile."""
    if isinstance(answer, Profile):
        return answer
    raise PluginError(f"{who}: answered temporal_fall_back with {_kind(answer)}, not a profile")


def check_stages(
    answer: Any, who: str, context: Context, known: Callable[[], Classes]
) -> Sequence[Stage]:
    """Return the stages of ``answer``, its calls made; ``known`` returns the classes by name.

    Raises PluginError, naming ``who`` gave it, for any other answer and for a call that fails.
    """
    if not isinstance(answer, Sequence):
        raise PluginError(f"{who}: answered {context.point} with {_kind(answer)}, not stages")
    calls = any(isinstance(item, StageCall) for item in answer)
    classes = known() if calls else {}
    return [_stage(item, who, context, classes) for item in answer]


def _stage(item: Any, who: str, context: Context, classes: Classes) -> Stage:
    if isinstance(item, Stage):
        return item
    if not isinstance(item, StageCall):
        raise PluginError(f"{who}: answered {context.point} with {_kind(item)}, not stages")
    try:
        return item.make(classes, context.setting)
    except FloatrefError as error:
        raise PluginError(f"{who}: {context.point}: {error}") from error


def _kind(answer: Any) -> str:
    return type(answer).__name__
