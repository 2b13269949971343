"""What a pipeline is, and the question an architecture asks at each of its points."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from numbers import Real
from typing import Any

from floatref.errors import InputError
from floatref.stages.protocol import Stage
from floatref.values.block import Header

Answer = Callable[["Context"], Sequence[Stage]]
Ask = Callable[[str], Sequence[Stage]]
Defaults = Mapping[str, Answer]


@dataclass(frozen=True)
class Pipeline:
    """A named way through an architecture.

    ``answers`` replaces the architecture's own stages at the points it names; ``settings`` are
    the pipeline's numbers with their defaults, all above zero but those ``signed``. None is a
    number that the recording decides. ``channels`` are those of the recording that it takes
    beside the nominal ones, for every track or shared, and ``readings`` those of GNSS;
    ``capabilities`` are the sensors that deliver them.
    """

    name: str
    architecture: str
    summary: str
    settings: Mapping[str, float | None] = field(default_factory=dict)
    answers: Defaults = field(default_factory=dict)
    channels: tuple[str, ...] = ()
    readings: tuple[str, ...] = ()
    capabilities: tuple[str, ...] = ()
    signed: tuple[str, ...] = ()

    def resolve(self, given: Mapping[str, Any]) -> dict[str, float | None]:
        """Return the settings with those ``given`` in place; InputError if one cannot be.

        A setting given as None keeps its default.
        """
        for name in given:
            if name not in self.settings:
                known = ", ".join(self.settings) or "none"
                raise InputError(
                    f"setting {name}: pipeline {self.name} has none such; it has {known}"
                )
        chosen = {
            name: _number(name, value, name in self.signed)
            for name, value in given.items()
            if value is not None
        }
        return {**self.settings, **chosen}


@dataclass(frozen=True)
class Context:
    """What a point of the signal flow needs to know to choose its stages.

    ``point`` is the hook's name, ``header`` that of the raw stream in time, ``origin_m`` the
    encoder distance of its first sample, ``ends_m`` the first and the last that the encoder tells
    within a sample of the stream's ends, ``fastest_mps`` the fastest speed over a second.
    """

    point: str
    pipeline: Pipeline
    settings: Mapping[str, float | None]
    header: Header
    origin_m: float
    fastest_mps: float = 0.0
    ends_m: tuple[float, float] = (0.0, 0.0)

    def setting(self, name: str) -> float:
        """Return setting ``name``; InputError if nothing has decided it."""
        value = self.settings.get(name)
        if value is None:
            raise InputError(f"setting {name}: pipeline {self.pipeline.name} needs it")
        return value


def _number(name: str, value: Any, signed: bool) -> float:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InputError(f"setting {name}: {value!r} is not a number")
    try:
        number = float(value)
    except OverflowError:
        number = float("inf")
    if not (isfinite(number) and (signed or number > 0)):
        allowed = "finite" if signed else "finite and above zero"
        raise InputError(f"setting {name}: {number} must be {allowed}")
    return number
