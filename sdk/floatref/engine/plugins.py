"""Loading plug-ins, and calling their hooks, one plug-in at a time."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from importlib.metadata import EntryPoint, entry_points
from threading import RLock
from typing import Any, TypeVar

import pluggy

from floatref.builtin_pipelines.plugin import Defaults
from floatref.engine.registration import (
    Register,
    check_adapter,
    check_pipeline,
    check_profile,
    check_profile_format,
    check_recording_format,
    check_scopes,
    check_stage,
    check_stages,
    complete_pipeline,
    scope_of,
    unknown_scopes,
)
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.interfaces import hookspecs
from floatref.interfaces.adapter import Adapter
from floatref.interfaces.drop_out import DropOut
from floatref.interfaces.hook_trace import list_names, trace_hook
from floatref.interfaces.markers import PROJECT
from floatref.interfaces.pipeline import Context, Pipeline
from floatref.interfaces.profile_format import ProfileFormat
from floatref.interfaces.recording_format import RecordingFormat
from floatref.stages.protocol import Stage
from floatref.values.display.similar_names import suggest
from floatref.values.profile import Profile

T = TypeVar("T")
BUILT_IN = "floatref"
"""Name of the plug-in that holds the defaults."""


@dataclass(frozen=True)
class _Caller:
    """One plug-in's implementation of a hook; an empty scope means all pipelines."""

    plugin: str
    scope: tuple[str, ...]
    call: Callable[..., Any]


class Plugins:
    """All plug-ins of a process, and what they registered.

    Whatever a plug-in raises is its own failure, SystemExit included, and ends no command; Ctrl-C
    alone does.

    ``reports`` has one line for each plug-in that failed and was skipped.
    """

    def __init__(self) -> None:
        """Load the defaults; `load` adds others."""
        self.reports: list[str] = []
        self._lock = RLock()
        self._loading = False
        self._registering: dict[str, Register] = {}
        self._manager = pluggy.PluginManager(PROJECT)
        self._manager.add_hookspecs(hookspecs)
        self.add(Defaults(), BUILT_IN)

    def add(self, plugin: object, name: str) -> None:
        """Add ``plugin`` under ``name``; one that does not fit the hooks is reported."""
        if self._manager.has_plugin(name):
            self._skip(name, ValueError("another plug-in has this name"))
            return
        try:
            self._manager.register(plugin, name)
            self._manager.check_pending()
            if name != BUILT_IN:
                check_scopes(self._manager, name)
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            self._skip(name, error)
            if self._manager.has_plugin(name):
                self._manager.unregister(name=name)

    def load(self, points: Sequence[EntryPoint]) -> None:
        """Load each entry point; one that fails is reported and skipped."""
        self._loading = True
        for point in points:
            try:
                plugin = point.load()
            except KeyboardInterrupt:
                raise
            except BaseException as error:
                self._skip(point.name, error)
            else:
                self.add(plugin, point.name)
        self._loading = False

    def collect(self, hook: str, check: Callable[..., str]) -> dict[str, Any]:
        """Return what all plug-ins registered through ``hook``, by name.

        A plug-in that calls this while it registers gets the items registered before. Raises
        PluginError if two plug-ins registered the same name.
        """
        with self._lock:
            if hook in self._registering:
                return dict(self._registering[hook].found)
            with self._register(hook, check) as register:
                for caller in self._callers(hook):
                    self._fill(register, hook, caller)
            return register.found

    def pipelines(self) -> dict[str, Pipeline]:
        """Return every pipeline by name, each with an answer for every point."""
        found = self.collect("floatref_register_pipelines", check_pipeline)
        return {name: complete_pipeline(pipeline) for name, pipeline in found.items()}

    def stages(self) -> dict[str, Callable[..., Stage]]:
        """Return every stage's class by name."""
        return self.collect("floatref_register_stages", check_stage)

    def adapters(self) -> dict[str, Adapter]:
        """Return every adapter by name."""
        return self.collect("floatref_register_adapters", check_adapter)

    def profile_formats(self) -> dict[str, ProfileFormat]:
        """Return every format of profile files by name."""
        return self.collect("floatref_register_profile_formats", check_profile_format)

    def recording_formats(self) -> dict[str, RecordingFormat]:
        """Return every format that recordings are written in, by name."""
        return self.collect("floatref_register_recording_formats", check_recording_format)

    def pipeline(self, name: str) -> Pipeline:
        """Return the pipeline called ``name``; InputError if it is unknown."""
        known = self.pipelines()
        if not (self._loading or self._registering):
            for line in unknown_scopes(self._manager, known):
                self._report(line)
        if name not in known:
            raise InputError(f"pipeline {name}: unknown; {suggest(name, known)}")
        return known[name]

    def ask(self, context: Context) -> Sequence[Stage]:
        """Return the stages for ``context``.

        A third party that names the pipeline has priority over the pipeline's own answer, and that
        over the architecture's. Raises PluginError, with both names, if two third parties answer.
        """
        checked = partial(check_stages, context=context, known=self.stages)
        answer = self._answer(context.point, context.pipeline.name, context, checked)
        return () if answer is None else answer

    def fall_back(self, asked: DropOut) -> Profile | None:
        """Return another profile of a recording whose heights have gaps, or None; as `ask`."""
        return self._answer("temporal_fall_back", asked.profile.pipeline, asked, check_profile)

    def _answer(
        self, hook: str, pipeline: str, context: object, checked: Callable[[Any, str], T]
    ) -> T | None:
        answers: dict[str, T] = {}
        # The built-in is asked last, and only if no third party has answered.
        for caller in sorted(self._callers(hook), key=lambda c: c.plugin == BUILT_IN):
            if caller.plugin == BUILT_IN and answers:
                break
            where = f"{hook} of {pipeline}"
            if caller.scope and pipeline not in caller.scope:
                trace_hook(caller.plugin, where, f"not asked, it names {list_names(caller.scope)}")
                continue
            found = self._guard(caller.plugin, partial(caller.call, context=context))
            if found:
                answers[caller.plugin] = checked(found[0], _who(caller.plugin, pipeline))
            trace_hook(caller.plugin, where, _describe(answers.get(caller.plugin)))
        if len(answers) > 1:
            both = " and ".join(answers)
            raise PluginError(f"plug-ins {both} both answer {hook} of {pipeline}; remove one")
        return next(iter(answers.values()), None)

    def _callers(self, hook: str) -> list[_Caller]:
        """Return the implementations of ``hook``, the built-in plug-in first."""
        everyone = dict(self._manager.list_name_plugin())
        found = []
        for implementation in getattr(self._manager.hook, hook).get_hookimpls():
            name = implementation.plugin_name
            others = [p for n, p in everyone.items() if n != name and p is not None]
            call = self._manager.subset_hook_caller(hook, others)
            found.append(_Caller(name, scope_of(implementation), call))
        return sorted(found, key=lambda caller: caller.plugin != BUILT_IN)

    @contextmanager
    def _register(self, hook: str, check: Callable[..., str]) -> Iterator[Register]:
        self._registering[hook] = Register(check)
        try:
            yield self._registering[hook]
        finally:
            del self._registering[hook]

    def _fill(self, register: Register, hook: str, caller: _Caller) -> None:
        before = set(register.found)
        call = partial(caller.call, register=register.of(caller.plugin))
        try:
            self._guard(caller.plugin, call)
        except InputError as error:
            self._skip(caller.plugin, error)
        new = [name for name in register.found if name not in before]
        trace_hook(caller.plugin, hook, f"registered {list_names(new)}")

    def _guard(self, plugin: str, call: Callable[[], Any]) -> Any:
        try:
            return call()
        except (FloatrefError, KeyboardInterrupt):
            raise
        except BaseException as error:
            self._skip(plugin, error)
            return None

    def _skip(self, name: str, error: BaseException) -> None:
        reason = " ".join(str(error).split())
        self._report(f"plug-in {name} skipped: {type(error).__name__}: {reason}")

    def _report(self, line: str) -> None:
        if line not in self.reports:
            self.reports.append(line)


def _who(plugin: str, pipeline: str) -> str:
    return f"pipeline {pipeline}" if plugin == BUILT_IN else f"plug-in {plugin}"


def _describe(answer: object) -> str:
    if answer is None:
        return "no answer"
    return (
        list_names(stage.name for stage in answer) if isinstance(answer, Sequence) else "a profile"
    )


_LOCK = RLock()
_loaded: list[Plugins] = []


def plugins() -> Plugins:
    """Return the plug-ins of this process, loaded once from their entry points.

    A plug-in that calls this while it is loaded gets the plug-ins loaded before it.
    """
    with _LOCK:
        if not _loaded:
            _loaded.append(Plugins())
            _loaded[0].load(tuple(entry_points(group=PROJECT)))
        return _loaded[0]
