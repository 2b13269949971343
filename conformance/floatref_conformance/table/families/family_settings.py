"""Which drives a table of families has: its numbers, and the scenario of each drive."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from math import ceil
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref_conformance.checks.case import record_for
from floatref_conformance.checks.driving.layout import least_spacing_m, place
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.table.families.conditions import (
    CONDITIONS,
    FAMILIES,
    SINGLE_FAMILY,
    STOPS,
    STOPS_FAMILY,
    Condition,
)
from floatref_conformance.table.passes import draw_seed
from floatref_conformance.table.table_settings import choose, offered_pipelines

ALL = "all"
APART_M = 160.0
"""Smallest distance of several stops, in m."""
RATE_HZ = 8000.0
"""Sampling rate of the accelerometers: half of 16 kHz takes half the time."""


@dataclass(frozen=True)
class FamilySettings:
    """The numbers that make a table of families again; InputError for values out of range.

    Attributes:
        family: one of `FAMILIES`, or all of them, or `STOPS_FAMILY`.
        seed: all drives, roads and sensor errors are drawn from it.
        drives: how many for each condition.
        pipelines: names of the pipelines; all that floatref has if not given.
        jobs: processes at a time, which changes no figure.
    """

    family: str = ALL
    seed: int = 0
    drives: int = 3
    pipelines: tuple[str, ...] = field(default_factory=offered_pipelines)
    jobs: int = 1

    def __post_init__(self) -> None:
        """Refuse unknown names and numbers too low; put names in their usual order."""
        choose("family", (self.family,), (*FAMILIES, STOPS_FAMILY, ALL))
        if self.seed < 0:
            raise InputError(f"seed is {self.seed}; give 0 or more")
        if self.drives < 1:
            raise InputError(f"drives is {self.drives}; give 1 or more")
        if self.jobs < 1:
            raise InputError(f"jobs is {self.jobs}; give 1 or more")
        pipelines = choose("pipeline", self.pipelines, offered_pipelines())
        object.__setattr__(self, "pipelines", pipelines)

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """The conditions of the family; `STOPS` are not of `ALL`."""
        if self.family == STOPS_FAMILY:
            return STOPS
        return tuple(c for c in CONDITIONS if self.family in (ALL, c.family))

    @property
    def passes(self) -> int:
        """How many drives there are."""
        return len(self.conditions) * self.drives

    def scenarios(self, capabilities: frozenset[str]) -> Iterator[tuple[Condition, str, Scenario]]:
        """Yield every drive with its condition and name.

        ``capabilities`` are the channels to be recorded. A drive follows from the seed, its
        condition and its number, so that a smaller table holds the same figures.
        """
        for condition in self.conditions:
            for number in range(self.drives):
                scenario = draw_drive(self.seed, condition, number, capabilities)
                yield condition, f"{condition.full_name} {number + 1}", scenario


def draw_drive(
    seed: int, condition: Condition, number: int, capabilities: frozenset[str]
) -> Scenario:
    """Return drive ``number`` of ``condition``, long enough for the stretches that count.

    Shapes of the road lie where the judge has them, at the event, or beside it. All conditions of
    `single` have the same road and the same errors of the sensors: only one thing changes.
    """
    alike = condition.family == SINGLE_FAMILY
    drawn = draw_seed(seed, SINGLE_FAMILY if alike else condition.full_name, number)
    numbers = condition.numbers(np.random.default_rng(drawn))
    recorded: dict[str, Any] = record_for(capabilities)
    wanted = Scenario(seed=drawn, rate_hz=RATE_HZ, **{**numbers, **recorded})
    if wanted.stops > 1:
        apart = max(APART_M, float(ceil(least_spacing_m(wanted))) + 1.0)
        wanted = replace(wanted, stop_spacing_m=apart)
    there = replace(place(wanted, find_edition("2026.2")), bump_mm=0.0)
    return replace(
        there,
        crown_at_m=there.crown_at_m + condition.beside_m,
        break_at_m=there.break_at_m + condition.beside_m,
    )
