"""What a plug-in may register: checked when it does, so that nothing breaks later."""

import re
from collections.abc import Callable
from typing import Any

from floatref.engine.question import Pipeline
from floatref.errors import PluginError
from floatref.interfaces.profile_format import ProfileDirectory
from floatref.pipelines import response_flow, spatial, temporal
from floatref.values.needs import nominal_needs
from floatref.vehicle_response.needs import response_needs

SIGNAL_FLOWS = {
    "temporal": temporal.signal_flow,
    "spatial": spatial.signal_flow,
    "response": response_flow.signal_flow,
}
POINTS = {**temporal.DEFAULTS, **spatial.DEFAULTS, **response_flow.DEFAULTS}
NEEDS = {"temporal": nominal_needs, "spatial": nominal_needs, "response": response_needs}


def check_pipeline(pipeline: Any) -> str:
    """Return the name of ``pipeline``; TypeError if it is none or of no known architecture."""
    if not isinstance(pipeline, Pipeline):
        raise TypeError(f"{type(pipeline).__name__} is no Pipeline")
    if pipeline.architecture not in SIGNAL_FLOWS:
        raise TypeError(f"pipeline {pipeline.name}: no architecture {pipeline.architecture!r}")
    unknown = [point for point in pipeline.answers if point not in POINTS]
    if unknown:
        raise TypeError(f"pipeline {pipeline.name}: no point {unknown[0]!r} to answer")
    return _described(pipeline)


def check_adapter(adapter: Any) -> str:
    """Return the name of ``adapter``; TypeError if it cannot be one."""
    kind = type(adapter).__name__
    if not callable(getattr(adapter, "recognises", None)):
        raise TypeError(f"{kind} has no method recognises")
    if not any(callable(getattr(adapter, method, None)) for method in ("read", "streams")):
        raise TypeError(f"{kind} has neither a method read nor one called streams")
    return _described(adapter)


def check_profile_format(form: Any) -> str:
    """Return the name of ``form``; TypeError if it cannot be a format of profile files."""
    kind = type(form).__name__
    for method in ("recognises", "read", "write"):
        if not callable(getattr(form, method, None)):
            raise TypeError(f"{kind} has no method {method}")
    suffix = getattr(form, "suffix", None)
    named = isinstance(suffix, str) and re.fullmatch(r"\.[a-z]+", suffix)
    if not (named or isinstance(form, ProfileDirectory)):
        raise TypeError(f"{kind}: suffix {suffix!r} is not a point and small letters, as in .erd")
    return _described(form)


def check_stage(name: Any, stage: Any) -> str:
    """Return ``name``; TypeError unless it is text and ``stage`` makes one."""
    if not isinstance(name, str) or not callable(stage):
        raise TypeError(f"{name!r} is no name of a stage's class")
    return name


class Register:
    """What plug-ins registered through one hook, by name.

    Raises PluginError, with both names, when two register the same.
    """

    def __init__(self, check: Callable[..., str]) -> None:
        """Check every item with ``check``, which returns its name."""
        self.found: dict[str, Any] = {}
        self._check, self._owners = check, dict[str, str]()

    def of(self, plugin: str) -> Callable[..., None]:
        """Return what the hook of ``plugin`` is called with."""

        def register(*item: Any) -> None:
            name = self._check(*item)
            if name in self.found:
                both = f"{self._owners[name]} and {plugin}"
                raise PluginError(f"plug-ins {both} both register {name}; remove one")
            self.found[name], self._owners[name] = item[-1], plugin

        return register


def _described(item: Any) -> str:
    name, summary = getattr(item, "name", None), getattr(item, "summary", None)
    if not (isinstance(name, str) and name and isinstance(summary, str)):
        raise TypeError(f"{type(item).__name__} needs a name and a summary")
    return name
