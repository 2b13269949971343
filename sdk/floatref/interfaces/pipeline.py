"""Pipelines, and the context in which each of their points is answered."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import isfinite
from numbers import Real
from typing import Any

from floatref.errors import InputError
from floatref.interfaces.stage_calls import StageCall
from floatref.stages.protocol import Stage
from floatref.values.block import Header
from floatref.values.display.similar_names import suggest

Answer = Callable[["Context"], Sequence[Stage | StageCall]] | Sequence[StageCall]
"""A pipeline's answer at a point: calls of registered stages, or a function that returns stages or
calls."""
Ask = Callable[[str], Sequence[Stage]]
Defaults = Mapping[str, Answer]
OF_ALL = ("slip_per_g",)
"""Settings that every pipeline has, of any sign; the recording decides where they are not given."""


@dataclass(frozen=True)
class Pipeline:
    """A named way through an architecture.

    ``answers`` replaces the architecture's own stages at the points it names; a plug-in that
    answers such a point and names this pipeline has priority. ``settings`` are the pipeline's
    numbers with their defaults, all above zero except the ``signed`` ones; None is a number that
    the recording decides. ``channels`` are the channels that it reads in addition to the nominal
    ones, for every track or shared, and ``readings`` those of GNSS; ``capabilities`` are the
    sensors that deliver them. ``through_stops`` is whether it measures the road where the vehicle
    stops and creeps; None if that is not stated.
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
    through_stops: bool | None = None

    def resolve(self, given: Mapping[str, Any]) -> dict[str, float | None]:
        """Return the settings, with the ``given`` ones replaced; InputError if one is not possible.

        A setting given as None keeps its default. Those of `OF_ALL` are in the result if given.
        """
        for name in given:
            if name not in self.settings and name not in OF_ALL:
                known = suggest(name, (*self.settings, *OF_ALL), "it has")
                raise InputError(
                    f"setting {name}: pipeline {self.name} has no such setting; {known}"
                )
        chosen = {
            name: _number(name, value, name in self.signed or name in OF_ALL)
            for name, value in given.items()
            if value is not None
        }
        return {**self.settings, **chosen}

    def stages_at(self, context: "Context") -> Sequence[Stage | StageCall]:
        """Return this pipeline's stages at the point of ``context``, so that others can be added.

        Raises InputError if it leaves the point to its architecture; a pipeline that was looked up
        by its name has an answer at every point.
        """
        if context.point not in self.answers:
            raise InputError(
                f"pipeline {self.name}: leaves {context.point} to its architecture; "
                f"take floatref.pipeline({self.name!r}), which has every point"
            )
        return stages_of(self.answers[context.point], context)

    def with_answers(
        self,
        *,
        name: str,
        summary: str,
        settings: Mapping[str, float | None] | None = None,
        through_stops: bool | None = None,
        **answers: Answer,
    ) -> "Pipeline":
        """Return a pipeline of another ``name`` with these ``answers``, by point.

        ``settings`` are added to those that it has, or replace their defaults. Whether it measures
        ``through_stops`` stays as it is unless given.
        """
        return replace(
            self,
            name=name,
            summary=summary,
            settings={**self.settings, **(settings or {})},
            answers={**self.answers, **answers},
            through_stops=self.through_stops if through_stops is None else through_stops,
        )


@dataclass(frozen=True)
class Context:
    """The run for which a point of the signal flow is answered; every hook of a point takes one.

    ``point`` is the hook's name, ``header`` that of the raw stream in time, ``origin_m`` the
    encoder distance of its first sample, ``ends_m`` the encoder's first and last distance, if
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
        """Return setting ``name``; InputError if it has no value."""
        value = self.settings.get(name)
        if value is None:
            raise InputError(f"setting {name}: pipeline {self.pipeline.name} needs it")
        return value


def stages_of(answer: Answer, context: Context) -> Sequence[Stage | StageCall]:
    """Return the stages of ``answer`` in ``context``."""
    return answer(context) if callable(answer) else answer


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
