"""A check that has a vehicle drive over a road: its cases, and how they are judged."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.driving.edition import (
    ROADS,
    Roads,
    Table,
    derivation_of,
    edition,
    floor_of,
)
from floatref_conformance.checks.driving.layout import layout_of, place
from floatref_conformance.checks.driving.rules import RULES, Rule, rule_of
from floatref_conformance.checks.driving.strategies import drives
from floatref_conformance.checks.interface import Bench
from floatref_conformance.checks.scoring import compare
from floatref_conformance.checks.stretches import Stretches
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.judge.verdict import Measurement
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

ROUNDS = 3
"""How often certification drives every row, each time on another road."""


@dataclass(frozen=True)
class DrivingCheck:
    """Drives rows of manoeuvres over drawn roads and asks what the drives' rules ask.

    Attributes:
        id, title, clause, derivation, floor: as of any check.
        rows: the drives that the edition fixes, all but road, noise and place.
        quick: how many of them, from the first, a quick run drives.
        roads: what they are driven on.
        simplest_scenario: what failing drives are made simpler towards.
        rules: that the drives are judged by, each with the condition in words, if there is one.
    """

    id: str
    title: str
    clause: str
    derivation: str
    floor: str
    rows: tuple[Scenario, ...]
    quick: int
    roads: Roads
    simplest_scenario: Scenario
    rules: Mapping[str, Rule]
    needs: frozenset[str] = frozenset()

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """For each quantity, with its condition, the limit of each class in words."""
        return {
            f"{quantity}, {condition}" if condition else quantity: words
            for condition, rule in self.rules.items()
            for quantity, words in rule.limits.items()
        }

    @property
    def simplest(self) -> Case:
        """The drive with as few unusual numbers as the check can do with."""
        return Case(self.id, self.simplest_scenario)

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return the rows on drawn roads; those of a quick run come first."""
        rows = self.rows[: self.quick] if effort is Effort.QUICK else self.rows * ROUNDS
        return tuple(self._case(seed, number, row) for number, row in enumerate(rows, start=1))

    def strategy(self) -> "SearchStrategy[Case]":
        """Return the strategy of all cases: the `drives` of this check."""
        return drives(self.id).map(lambda scenario: Case(self.id, scenario))

    def scored(self, case: Case) -> Stretches:
        """Return the stretches over which every point counts.

        Raises InputError for numbers that leave no room for them.
        """
        return layout_of(case.scenario).stretches

    def judge(self, case: Case, bench: Bench) -> tuple[Measurement, ...]:
        """Return what the drive's rule asks of every wheel path.

        Raises InputError for numbers that leave no room for what is scored, DeviceError for a
        point without elevation where every point counts.
        """
        layout, rule = layout_of(case.scenario), rule_of(case.scenario)
        taken = bench.simulate(case.scenario)
        profile = bench.run(taken)
        return tuple(
            measurement
            for compared in compare(taken.truth, profile)
            for measurement in rule.measure(compared, case.scenario, layout)
        )

    def _case(self, seed: int, number: int, row: Scenario) -> Case:
        scenario = self.roads.draw_for(row, (seed, number, *self.id.encode()))
        return Case(self.id, place(scenario), name=f"{self.id}-{number}")


def _check(table: Table) -> DrivingCheck:
    """Return the check of a table of the edition."""
    common = table.get("every_row", {})
    return DrivingCheck(
        table["id"],
        table["title"],
        table["clause"],
        derivation_of(table),
        floor_of(table),
        tuple(Scenario.from_dict({**common, **row}) for row in table["rows"]),
        table["quick"],
        ROADS[table["roads"]],
        place(Scenario.from_dict(table["simplest"])),
        {condition: RULES[name] for condition, name in table["rules"].items()},
    )


DRIVING_CHECKS: Mapping[str, DrivingCheck] = {
    table["id"]: _check(table) for table in edition()["checks"]
}
"""Those of the edition by id, in the order of the suite's list."""
