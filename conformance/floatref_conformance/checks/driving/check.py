"""A check in which a vehicle drives over a road: its cases, and their judgement."""

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
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

ROUNDS = 3
"""Number of times that certification drives each row, each time on another road."""


@dataclass(frozen=True)
class DrivingCheck:
    """Drives rows of manoeuvres over drawn roads and judges each by the rule of its drive.

    Attributes:
        id, title, clause, derivation, floor: as of any check.
        rows: the drives of the edition, without road, noise and place.
        quick: number of first rows that a quick run drives.
        roads: the roads from which one is drawn.
        simplest_scenario: the drive towards which failing drives are simplified.
        rules: the rules of the drives, by their condition in words, if there is one.
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
        """The drive with the fewest numbers that differ from the defaults."""
        return Case(self.id, self.simplest_scenario)

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return the rows on drawn roads; those of a quick run come first."""
        rows = self.rows[: self.quick] if effort is Effort.QUICK else self.rows * ROUNDS
        return tuple(self._case(seed, number, row) for number, row in enumerate(rows, start=1))

    def strategy(self) -> "SearchStrategy[Case]":
        """Return the strategy of all cases, with the `drives` of this check."""
        return drives(self.id).map(lambda scenario: Case(self.id, scenario))

    def list_scored(self, case: Case) -> Stretches:
        """Return the stretches over which every point counts.

        Raises InputError for a drive that is too short for them.
        """
        return layout_of(case.scenario).stretches

    def judge(self, case: Case, bench: Bench) -> tuple[Measurement, ...]:
        """Return the measurements of every wheel path by the rule of the drive.

        Raises InputError for a drive that is too short for the stretches, DeviceError for a
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
"""The driving checks of the edition by id, in the order of the suite's list."""
