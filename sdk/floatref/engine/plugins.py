"""Loading plug-ins one at a time, and asking them one at a time."""

from collections.abc import Callable, Sequence
from functools import cache, partial
from importlib.metadata import EntryPoint, entry_points
from typing import Any, TypeVar

import pluggy

from floatref.engine.fall_back import DropOut
from floatref.engine.question import Pipeline, Question
from floatref.engine.registration import (
    Register,
    check_adapter,
    check_pipeline,
    check_profile_format,
    check_stage,
)
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.interfaces import hookspecs
from floatref.interfaces.adapter import Adapter
from floatref.interfaces.profile_format import ProfileFormat
from floatref.stages.protocol import Stage
from floatref.values.profile import Profile

T = TypeVar("T")
BUILT_IN = "floatref"
"""Name of the plug-in that holds the defaults."""


class Plugins:
    """All plug-ins of a process, and what they registered.

    ``reports`` lists in one line each what was broken and skipped.
    """

    def __init__(self) -> None:
        """Load the defaults; `load` adds others."""
        from floatref.pipelines import builtin

        self.reports: list[str] = []
        self._manager = pluggy.PluginManager(hookspecs.PROJECT)
        self._manager.add_hookspecs(hookspecs)
        self.add(builtin.Defaults(), BUILT_IN)

    def add(self, plugin: object, name: str) -> None:
        """Add ``plugin`` under ``name``; one that does not fit the hooks is reported."""
        if self._manager.has_plugin(name):
            self._skip(name, ValueError("another plug-in has this name"))
            return
        try:
            self._manager.register(plugin, name)
            self._manager.check_pending()
        except Exception as error:
            self._skip(name, error)
            if self._manager.has_plugin(name):
                self._manager.unregister(name=name)

    def load(self, points: Sequence[EntryPoint]) -> None:
        """Load each entry point; one that fails is reported and skipped."""
        for point in points:
            try:
                plugin = point.load()
            except (Exception, SystemExit) as error:
                self._skip(point.name, error)
            else:
                self.add(plugin, point.name)

    def registered(self, hook: str, check: Callable[..., str]) -> dict[str, Any]:
        """Return what all plug-ins registered through ``hook``, by name.

        Raises PluginError if two plug-ins registered the same name.
        """
        register = Register(check)
        for plugin, call in self._callers(hook):
            self._guarded(plugin, partial(call, register=register.of(plugin)))
        return register.found

    def pipelines(self) -> dict[str, Pipeline]:
        """Return every pipeline by name."""
        return self.registered("floatref_register_pipelines", check_pipeline)

    def stages(self) -> dict[str, Callable[..., Stage]]:
        """Return every stage's class by name."""
        return self.registered("floatref_register_stages", check_stage)

    def adapters(self) -> dict[str, Adapter]:
        """Return every adapter by name."""
        return self.registered("floatref_register_adapters", check_adapter)

    def profile_formats(self) -> dict[str, ProfileFormat]:
        """Return every format of profile files by name."""
        return self.registered("floatref_register_profile_formats", check_profile_format)

    def pipeline(self, name: str) -> Pipeline:
        """Return the pipeline called ``name``; InputError if there is none."""
        known = self.pipelines()
        if name not in known:
            raise InputError(f"pipeline {name}: unknown; there are {', '.join(known)}")
        return known[name]

    def ask(self, question: Question) -> Sequence[Stage]:
        """Return the stages for ``question``: a third party's if one answers, else the default.

        Raises PluginError, with both names, if two third parties answer.
        """
        answer = self._answer(question.point, question, partial(_stages, question=question))
        return () if answer is None else answer

    def fall_back(self, asked: DropOut) -> Profile | None:
        """Return another profile of a recording whose heights have gaps, or None; as `ask`."""
        return self._answer("temporal_fall_back", asked, _profile)

    def _answer(self, hook: str, context: object, checked: Callable[[Any, str], T]) -> T | None:
        answers: dict[str, T] = {}
        # The built-in comes last, and only where no third party has answered.
        for plugin, call in sorted(self._callers(hook), key=lambda c: c[0] == BUILT_IN):
            if plugin == BUILT_IN and answers:
                break
            answer = self._guarded(plugin, partial(call, context=context))
            if answer:
                answers[plugin] = checked(answer[0], plugin)
        if len(answers) > 1:
            both = " and ".join(answers)
            raise PluginError(f"plug-ins {both} both answer {hook}; remove one")
        return next(iter(answers.values()), None)

    def _callers(self, hook: str) -> list[tuple[str, pluggy.HookCaller]]:
        everyone = dict(self._manager.list_name_plugin())
        names = [impl.plugin_name for impl in getattr(self._manager.hook, hook).get_hookimpls()]
        return [
            (
                name,
                self._manager.subset_hook_caller(
                    hook, [p for n, p in everyone.items() if n != name and p is not None]
                ),
            )
            for name in names
        ]

    def _guarded(self, plugin: str, call: Callable[[], Any]) -> Any:
        try:
            return call()
        except FloatrefError:
            raise
        except Exception as error:
            self._skip(plugin, error)
            return None

    def _skip(self, name: str, error: BaseException) -> None:
        line = f"plug-in {name} skipped: {type(error).__name__}: {' '.join(str(error).split())}"
        if line not in self.reports:
            self.reports.append(line)


def _profile(answer: Any, plugin: str) -> Profile:
    if isinstance(answer, Profile):
        return answer
    kind = type(answer).__name__
    raise PluginError(f"plug-in {plugin}: answered temporal_fall_back with {kind}, no profile")


def _stages(answer: Any, plugin: str, question: Question) -> Sequence[Stage]:
    if isinstance(answer, Sequence) and all(isinstance(stage, Stage) for stage in answer):
        return answer
    who = f"pipeline {question.pipeline.name}" if plugin == BUILT_IN else f"plug-in {plugin}"
    raise PluginError(f"{who}: answered {question.point} with {type(answer).__name__}, no stages")


@cache
def plugins() -> Plugins:
    """Return the plug-ins of this process, loaded once from their entry points."""
    loaded = Plugins()
    loaded.load(tuple(entry_points(group=hookspecs.PROJECT)))
    return loaded
