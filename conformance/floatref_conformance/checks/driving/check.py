"""A check in which a vehicle drives over a road: its cases, and their judgement."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.driving.layout import layout_of, place
from floatref_conformance.checks.driving.rules import Rule, rule_of, rules_of
from floatref_conformance.checks.driving.strategies import drives
from floatref_conformance.checks.encoder_axis import EncoderAxis
from floatref_conformance.checks.interface import Bench, Taken
from floatref_conformance.checks.scoring import Compared, compare
from floatref_conformance.checks.stretches import Stretches
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.editions.drawn import Roads
from floatref_conformance.editions.edition import Edition, Table
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

DRAWN = 1
"""Marks the numbers that are drawn beside the road, so that they do not depend on it."""
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
        edition: what else the drives have, and what is drawn for each.
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
    edition: Edition
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
        return drives(self.id, self.edition).map(lambda scenario: Case(self.id, scenario))

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
        layout, rule = layout_of(case.scenario), rule_of(case.scenario, self.edition)
        taken = bench.simulate(case.scenario)
        profile = bench.run(taken)
        found: list[Measurement] = []
        beside = self._compare_beside(taken, profile)
        for compared in compare(taken.truth, profile):
            other = beside.get(compared.track)
            found += rule.measure(compared, case.scenario, layout, other)
        return tuple(found)

    def _compare_beside(self, taken: Taken, profile: Profile) -> Mapping[str, Compared]:
        """Return ``profile`` with the truth along the encoder's distance, if that is measured."""
        if not self.edition.true_axis:
            return {}
        along = EncoderAxis.of(taken).place(taken.truth)
        return {c.track: c for c in compare(along, profile)}

    def _case(self, seed: int, number: int, row: Scenario) -> Case:
        entropy = (seed, number, *self.id.encode())
        scenario = self.edition.draw_for(self.roads.draw_for(row, entropy), (*entropy, DRAWN))
        return Case(self.id, place(scenario, self.edition), name=f"{self.id}-{number}")


@cache
def driving_checks(edition: Edition) -> Mapping[str, DrivingCheck]:
    """Return the driving checks of ``edition`` by id, in the order of the suite's list."""
    return {table["id"]: _check(table, edition) for table in edition.document["checks"]}


def _check(table: Table, edition: Edition) -> DrivingCheck:
    """Return the check of a table of ``edition``."""
    common, rules = table.get("every_row", {}), rules_of(edition)
    return DrivingCheck(
        table["id"],
        table["title"],
        table["clause"],
        str(table["derivation"]).format_map(_texts(edition)),
        _floor(table, edition),
        tuple(edition.make_scenario(**{**common, **row}) for row in table["rows"]),
        table["quick"],
        edition.roads[table["roads"]],
        place(edition.make_scenario(**table["simplest"]), edition),
        {condition: rules[name] for condition, name in table["rules"].items()},
        edition,
    )


def _floor(table: Table, edition: Edition) -> str:
    """Return what a profile must contain: the bump at the place of the check."""
    text = str(edition.document["floor"]["text"])
    return text.format(where=table["bump"], slow=table.get("slow", ""))


@cache
def _texts(edition: Edition) -> Mapping[str, str]:
    """Return the shared texts of derivations, each with earlier ones inserted."""
    texts: dict[str, str] = {}
    for name, text in edition.document["texts"].items():
        texts[name] = text.format_map(texts)
    return texts
