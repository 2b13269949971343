"""Look-up by name for plug-ins: pipelines to derive new ones from, and registered stages."""

from functools import cache
from typing import Any, NoReturn

from floatref.engine.plugins import Plugins, plugins
from floatref.errors import InputError
from floatref.interfaces.pipeline import Pipeline
from floatref.interfaces.stage_calls import StageCall
from floatref.stages.protocol import Stage


def pipeline(name: str) -> Pipeline:
    """Return the pipeline called ``name``, with an answer for every point of its architecture.

    A plug-in may look up a built-in pipeline at any time, also at import; a pipeline of another
    plug-in is known once that plug-in is loaded. Raises InputError for an unknown name.
    """
    # Loading the plug-ins here would import the calling module a second time.
    built_in = _built_in()
    return built_in[name] if name in built_in else plugins().pipeline(name)


@cache
def _built_in() -> dict[str, Pipeline]:
    return Plugins().pipelines()


def stage_names() -> tuple[str, ...]:
    """Return the names of all registered stages."""
    return tuple(plugins().stages())


def make_stage(name: str, /, *arguments: Any, **keywords: Any) -> Stage:
    """Return a new stage by its registered name, made from these arguments.

    Raises InputError for a name that is not known or arguments that do not fit.
    """
    return StageCall(name, *arguments, **keywords).make(plugins().stages(), _no_setting)


def _no_setting(name: str) -> NoReturn:
    raise InputError(f"setting {name}: no pipeline runs; give the number, or use a StageCall")
