"""The rules: the requirements for every wheel path, by the kind of drive."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import nan

import numpy as np

from floatref_conformance.checks import flags
from floatref_conformance.checks.driving import bump
from floatref_conformance.checks.driving.asked import Requirement, limits_of, read_requirement
from floatref_conformance.checks.driving.edition import Table, edition
from floatref_conformance.checks.driving.layout import BUMP_REACH_M, Layout
from floatref_conformance.checks.flags import SLOW_MPS
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits, write_limits
from floatref_conformance.errors import DeviceError
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

ELSEWHERE = "flagged elsewhere"
UNLIMITED = "not limited"
UNFLAGGED, WHOLE = "IRI error, unflagged part", "IRI error, 160.9 m"


@dataclass(frozen=True)
class Rule:
    """The requirements for a drive.

    Attributes:
        whole: requirements for every scored stretch, over all its points.
        unflagged: requirements for all points that the device marks valid.
        flagged_elsewhere: limits of the flagged length in m around an event.
        slow: whether the vehicle stays below 16 km/h. The flagged length is then not limited, and
            flagged points do not count in class nominal.
    """

    whole: tuple[Requirement, ...]
    unflagged: tuple[Requirement, ...]
    flagged_elsewhere: Limits
    slow: bool

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """For each quantity, the limit of each class in words."""
        table: dict[str, dict[DeviceClass, str]] = {}
        for asked in (*self.whole, *self.unflagged):
            row = table.setdefault(asked.quantity, dict.fromkeys(DeviceClass, UNLIMITED))
            row |= asked.words
        if not self.slow:
            table["flagged at an end"] = write_limits(flags.END_LIMITS, "m")
            table[ELSEWHERE] = write_limits(self.flagged_elsewhere, "m")
        table["bump error"] = write_limits(bump.LIMITS, "%")
        return table

    def measure(
        self, compared: Compared, scenario: Scenario, layout: Layout
    ) -> tuple[Measurement, ...]:
        """Return the measurements of one wheel path.

        Raises DeviceError for a point without elevation where every point counts.
        """
        found = [m for start, end in layout.stretches for m in self._whole(compared, start, end)]
        trusted = compared.unflagged()
        if trusted is not None:
            found += [asked.measure(trusted, compared.track) for asked in self.unflagged]
        if not self.slow:
            ends, away = flags.measure_flags(compared, scenario, layout.events_m)
            found += [ends, replace(away, quantity=ELSEWHERE, limits=self.flagged_elsewhere)]
        if scenario.bump_mm:
            found.append(self._bump(compared, scenario))
        return tuple(found)

    def _whole(self, compared: Compared, start: float, end: float) -> list[Measurement]:
        try:
            pair = compared.whole(start, end)
        except DeviceError:
            if not self.slow:
                raise
            return [_missing(asked.quantity, compared) for asked in self.whole]
        return [asked.measure(pair, compared.track) for asked in self.whole]

    def _bump(self, compared: Compared, scenario: Scenario) -> Measurement:
        near = np.abs(compared.distance_m - scenario.bump_at_m) <= BUMP_REACH_M
        if not self.slow or compared.valid[near].all():
            return bump.measure_bump(compared, scenario)
        try:
            found = bump.measure_bump(compared, scenario)
        except DeviceError:
            return _missing("bump error", compared)
        return replace(found, limits=_above_nominal(found.limits))


def _missing(quantity: str, compared: Compared) -> Measurement:
    """Return NaN for a quantity of points without elevation; only class nominal passes it."""
    return Measurement(
        quantity, compared.track, nan, "", _above_nominal(dict.fromkeys(DeviceClass, 1.0))
    )


def _above_nominal(limits: Limits) -> Limits:
    return {c: limit for c, limit in limits.items() if c is not DeviceClass.NOMINAL}


def _rule(table: Table) -> Rule:
    """Return the rule of a table of the edition."""
    elsewhere = table.get("flagged_elsewhere")
    return Rule(
        tuple(read_requirement(entry, WHOLE) for entry in table["whole"]),
        tuple(
            read_requirement(entry, UNFLAGGED, UNFLAGGED) for entry in table.get("unflagged", ())
        ),
        limits_of(elsewhere) if elsewhere else flags.EVENT_LIMITS,
        table.get("slow", False),
    )


RULES: Mapping[str, Rule] = {name: _rule(table) for name, table in edition()["rules"].items()}
"""The rules of the edition, by name."""


def rule_of(scenario: Scenario) -> Rule:
    """Return the rule of the scenario's drive, which a driving check scores."""
    named = edition()["manoeuvres"][scenario.manoeuvre]
    if "below_16_kmh" in named and scenario.speed_kmh * KMH < SLOW_MPS:
        return RULES[named["below_16_kmh"]]
    if "up_to_g" in named and scenario.deceleration_g > named["up_to_g"]:
        return RULES[named["beyond"]]
    return RULES[named["rule"]]
