"""A stage by its registered name, with its arguments: one call makes a new stage for each run."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from inspect import signature
from typing import Any

from floatref.errors import FloatrefError, InputError, PluginError
from floatref.stages.protocol import Stage
from floatref.values.display.similar_names import suggest


@dataclass(frozen=True)
class Setting:
    """An argument of a `StageCall`: the value of a setting of the pipeline that runs."""

    name: str


@dataclass(frozen=True, init=False)
class StageCall:
    """A registered stage and its arguments, such as ``StageCall("FromFirst", "height")``.

    An argument may be a `Setting`. A call may be used wherever a point is answered with a stage.
    """

    name: str
    arguments: tuple[Any, ...]
    keywords: Mapping[str, Any]

    def __init__(self, name: str, /, *arguments: Any, **keywords: Any) -> None:
        """Call stage ``name`` with these arguments, by position or by keyword."""
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "arguments", arguments)
        object.__setattr__(self, "keywords", keywords)

    def make(
        self, known: Mapping[str, Callable[..., Stage]], setting: Callable[[str], float]
    ) -> Stage:
        """Return a new stage; ``known`` are the classes by name, ``setting`` returns a number.

        Raises InputError for an unknown name, a missing setting or arguments that do not fit.
        """
        if self.name not in known:
            raise InputError(f"stage {self.name}: unknown; {suggest(self.name, sorted(known))}")
        arguments = [_resolve(value, setting) for value in self.arguments]
        keywords = {name: _resolve(value, setting) for name, value in self.keywords.items()}
        return _make(self.name, known[self.name], arguments, keywords)


def _resolve(value: Any, setting: Callable[[str], float]) -> Any:
    return setting(value.name) if isinstance(value, Setting) else value


def _make(
    name: str, kind: Callable[..., Stage], arguments: list[Any], keywords: dict[str, Any]
) -> Stage:
    try:
        signature(kind).bind(*arguments, **keywords)
    except TypeError as error:
        raise InputError(f"stage {name}: {error}; it takes {signature(kind)}") from error
    try:
        stage = kind(*arguments, **keywords)
    except (FloatrefError, KeyboardInterrupt):
        raise
    except BaseException as error:
        raise PluginError(f"stage {name}: {type(error).__name__}: {error}") from error
    if not isinstance(stage, Stage):
        raise PluginError(f"stage {name}: made {type(stage).__name__}, which is not a Stage")
    return stage
