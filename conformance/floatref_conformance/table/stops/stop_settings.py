"""Which stops are driven, by which vehicles on which roads, and how they are drawn."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import log10

import numpy as np

from floatref.errors import InputError
from floatref_conformance.checks.case import record_for
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES
from floatref_conformance.table.passes import ROADS, draw_seed
from floatref_conformance.table.table_settings import choose, offered_pipelines

SPEED_KMH = (30.0, 80.0)
"""Slowest and fastest speed before the brake."""
DECELERATION_G = (0.1, 0.35)
"""Lightest and hardest brake."""
DWELL_S = (0.5, 120.0)
"""Shortest and longest stop; drawn evenly in their logarithm."""
FINAL_SPEED_KMH = (30.0, 72.0)
"""Slowest and fastest speed after the stop."""
LENGTH_M = 550.0
"""True distance driven: a vehicle needs 214 m to set off to 72 km/h."""


@dataclass(frozen=True)
class StopRoad:
    """A road that is stopped on: its name, its kind in a `Scenario`, and its IRI."""

    name: str
    kind: str
    iri_m_per_km: float


STOP_ROADS = tuple(
    StopRoad(name, kind, iri)
    for name, kind, iri in zip(("smooth", "fair", "rough"), ROADS, (0.8, 1.8, 4.0), strict=True)
)
"""The kinds of the other table, smooth to rough; every drive draws a road of its own."""


@dataclass(frozen=True)
class StopSettings:
    """The numbers that make a table of drawn stops again; InputError for values out of range.

    Attributes:
        seed: all drives, roads and sensor errors are drawn from it.
        stops: how many for each vehicle on each road.
        vehicles: names of the vehicles; all of the proving ground if not given.
        pipelines: names of the pipelines; all that floatref has if not given.
    """

    seed: int = 0
    stops: int = 7
    vehicles: tuple[str, ...] = tuple(VEHICLES)
    pipelines: tuple[str, ...] = field(default_factory=offered_pipelines)

    def __post_init__(self) -> None:
        """Refuse unknown names and numbers too low; put names in their usual order."""
        if self.seed < 0:
            raise InputError(f"seed is {self.seed}; give 0 or more")
        if self.stops < 1:
            raise InputError(f"stops is {self.stops}; give 1 or more")
        object.__setattr__(self, "vehicles", choose("vehicle", self.vehicles, tuple(VEHICLES)))
        pipelines = choose("pipeline", self.pipelines, offered_pipelines())
        object.__setattr__(self, "pipelines", pipelines)

    @property
    def passes(self) -> int:
        """How many drives there are."""
        return len(self.vehicles) * len(STOP_ROADS) * self.stops

    def scenarios(self, capabilities: frozenset[str]) -> Iterator[tuple[str, Scenario]]:
        """Yield every drive with its name; ``capabilities`` are the channels to be recorded.

        A drive follows from the seed, its vehicle, its road and its number, so that a table of
        fewer stops, vehicles or pipelines holds the same figures.
        """
        for vehicle in self.vehicles:
            for road in STOP_ROADS:
                for number in range(self.stops):
                    scenario = draw_stop(self.seed, vehicle, road, number, capabilities)
                    yield f"{vehicle}, {road.name} road: stop {number + 1}", scenario


def draw_stop(
    seed: int, vehicle: str, road: StopRoad, number: int, capabilities: frozenset[str]
) -> Scenario:
    """Return stop ``number`` of ``vehicle`` on ``road``, its numbers rounded to be read."""
    drawn = draw_seed(seed, f"stop {vehicle} {road.name}", number)
    draw = np.random.default_rng(drawn)
    return Scenario(
        seed=drawn,
        road=road.kind,
        iri_m_per_km=road.iri_m_per_km,
        vehicle=vehicle,
        manoeuvre="stop",
        speed_kmh=round(draw.uniform(*SPEED_KMH), 1),
        deceleration_g=round(draw.uniform(*DECELERATION_G), 3),
        dwell_s=round(float(10 ** draw.uniform(log10(DWELL_S[0]), log10(DWELL_S[1]))), 2),
        final_speed_kmh=round(draw.uniform(*FINAL_SPEED_KMH), 1),
        length_m=LENGTH_M,
        **record_for(capabilities),
    )
