"""The marks on the functions of a plug-in: `hookimpl` registers, `answers` fills a point."""

from collections.abc import Callable
from typing import TypeVar

import pluggy

F = TypeVar("F", bound=Callable[..., object])
PROJECT = "floatref"
"""Name of the entry-point group and of the pluggy project."""
SCOPE = "floatref_pipelines"
"""Attribute of a function that holds the pipelines it answers."""

hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)


def answers(*pipelines: str) -> Callable[[F], F]:
    """Mark a function as the answer to the point of its name, in ``pipelines`` and no others.

    It takes the place of `hookimpl`. Raises TypeError unless every pipeline is named by text.
    """
    if not pipelines or not all(isinstance(name, str) for name in pipelines):
        raise TypeError('answers needs the names of pipelines: write @answers("temporal-basic")')

    def mark(function: F) -> F:
        setattr(function, SCOPE, pipelines)
        return hookimpl(function)

    return mark
