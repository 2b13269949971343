"""The scope of an answer: which pipelines a plug-in may change, as its functions declare."""

from collections.abc import Iterator, Mapping

import pluggy

from floatref.architectures.markers import SCOPE
from floatref.architectures.pipeline import Pipeline
from floatref.errors import PluginError

REGISTERS = "floatref_register_"
"""Begin of the name of every hook that registers, and answers no point."""


def scope_of(implementation: pluggy.HookImpl) -> tuple[str, ...]:
    """Return the pipelines that an implementation of a point names; none of a built-in one."""
    return tuple(getattr(implementation.function, SCOPE, ()))


def check_scopes(manager: pluggy.PluginManager, plugin: str) -> None:
    """Raise PluginError if ``plugin`` answers a point and names no pipeline for it."""
    for point, implementation in _answering(manager):
        if implementation.plugin_name == plugin and not scope_of(implementation):
            raise PluginError(
                f"{point} names no pipeline that it answers; write "
                f'@floatref.answers("NAME OF A PIPELINE") in place of @hookimpl'
            )


def unknown_scopes(manager: pluggy.PluginManager, known: Mapping[str, Pipeline]) -> Iterator[str]:
    """Yield a line for each pipeline that a plug-in names and that has no such point."""
    for point, implementation in _answering(manager):
        for name in scope_of(implementation):
            who = f"plug-in {implementation.plugin_name}: {point} names pipeline {name}"
            if name not in known:
                yield f"{who}, which is unknown; it is answered nowhere"
            elif not point.startswith(f"{known[name].architecture}_"):
                yield f"{who}, which is {known[name].architecture} and has no such point"


def _answering(manager: pluggy.PluginManager) -> Iterator[tuple[str, pluggy.HookImpl]]:
    for point, caller in vars(manager.hook).items():
        if not point.startswith(("_", REGISTERS)):
            yield from ((point, found) for found in caller.get_hookimpls())
