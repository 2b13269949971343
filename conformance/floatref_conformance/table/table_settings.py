"""What a table is made of: how many roads and noises, which runs, pipelines and vehicle."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest
from floatref_conformance.devices import builtin
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.vehicles.parameter_sets import find_vehicle
from floatref_conformance.table.published import RUN_NAMES, published_figures


def offered_pipelines() -> tuple[str, ...]:
    """Return the pipelines that floatref has: the published in the order of print, then others."""
    offered = [entry.name for entry in builtin.entries()]
    printed = dict.fromkeys(pipeline for pipeline, _ in published_figures())
    return (
        *(name for name in printed if name in offered),
        *(name for name in offered if name not in printed),
    )


@dataclass(frozen=True)
class TableSettings:
    """The numbers that make a table again; InputError for values out of range.

    Attributes:
        seed: all roads and sensor errors are drawn from it.
        roads: how many roads.
        seeds: how many sets of passes with other sensor errors on each road.
        vehicle: a name of `proving_ground.vehicles.VEHICLES`.
        runs: names of the runs; all 17 if not given.
        pipelines: names of the pipelines; all that floatref has if not given.
    """

    seed: int = 0
    roads: int = 3
    seeds: int = 2
    vehicle: str = Scenario.vehicle
    runs: tuple[str, ...] = RUN_NAMES
    pipelines: tuple[str, ...] = field(default_factory=offered_pipelines)

    def __post_init__(self) -> None:
        """Refuse unknown names and counts below one; put names in the order of print."""
        if self.seed < 0:
            raise InputError(f"seed is {self.seed}; give 0 or more")
        for name in ("roads", "seeds"):
            if getattr(self, name) < 1:
                raise InputError(f"{name} is {getattr(self, name)}; give 1 or more")
        find_vehicle(self.vehicle)
        object.__setattr__(self, "runs", choose("run", self.runs, RUN_NAMES))
        pipelines = choose("pipeline", self.pipelines, offered_pipelines())
        object.__setattr__(self, "pipelines", pipelines)

    @property
    def passes(self) -> int:
        """How many passes are driven, those of the reference included."""
        return self.roads * self.seeds * (1 + len(self.runs))


def choose(kind: str, names: Sequence[str], known: Sequence[str]) -> tuple[str, ...]:
    """Return those of ``known`` that are in ``names``, all if that is empty.

    Raises InputError for a name that is not known, calling it a ``kind``.
    """
    for name in names:
        if name not in known:
            raise InputError(f"{kind} {name}: unknown; {suggest(name, known, 'choose from')}")
    return tuple(name for name in known if name in names or not names)
