"""The rules: the requirements for every wheel path, by the kind of drive."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from math import nan

import numpy as np
from scipy.ndimage import minimum_filter1d

from floatref.values.arrays import BoolArray
from floatref_conformance.checks import flags, scoring
from floatref_conformance.checks.driving import bump
from floatref_conformance.checks.driving.asked import Requirement, limits_of, read_requirement
from floatref_conformance.checks.driving.layout import BUMP_REACH_M, Layout
from floatref_conformance.checks.flags import SLOW_MPS
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits, write_limits
from floatref_conformance.editions.edition import Edition, Table
from floatref_conformance.errors import DeviceError
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

ELSEWHERE = "flagged elsewhere"
UNLIMITED = "not limited"
AXIS_M = 5.0
"""By how much the axis of a device may be off in m: 12 % per g from 100 km/h lose 4.7 m."""
UNFLAGGED, WHOLE = "IRI error, unflagged part", "IRI error, 160.9 m"
VALID_PART = "IRI error, 160.9 m without flagged points"
BESIDE = "correlation loss along the encoder"


@dataclass(frozen=True)
class Rule:
    """The requirements for a drive.

    Attributes:
        whole: requirements for every scored stretch, over all its points.
        valid_part: requirements for every scored stretch, whose flagged points get the truth's
            shape.
        unflagged: requirements for all points that the device marks valid.
        flagged_elsewhere: limits of the flagged length in m around an event.
        slow: whether the vehicle stays below 16 km/h. The flagged length is then not limited, and
            flagged points do not count in class nominal.
        excused: whether points that are flagged and driven below 16 km/h do not count in class
            nominal, as in a slow drive.
    """

    whole: tuple[Requirement, ...]
    valid_part: tuple[Requirement, ...]
    unflagged: tuple[Requirement, ...]
    flagged_elsewhere: Limits
    slow: bool
    excused: bool

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """For each quantity, the limit of each class in words."""
        table: dict[str, dict[DeviceClass, str]] = {}
        for asked in (*self.whole, *self.valid_part, *self.unflagged):
            row = table.setdefault(asked.quantity, dict.fromkeys(DeviceClass, UNLIMITED))
            row |= asked.words
        if not self.slow:
            table["flagged at an end"] = write_limits(flags.END_LIMITS, "m")
            table[ELSEWHERE] = write_limits(self.flagged_elsewhere, "m")
        table["bump error"] = write_limits(bump.LIMITS, "%")
        return table

    def measure(
        self, compared: Compared, scenario: Scenario, layout: Layout, beside: Compared | None = None
    ) -> tuple[Measurement, ...]:
        """Return the measurements of one wheel path.

        ``beside`` is the same with the truth along the encoder's distance: its loss is measured,
        and not limited, and the bump may lie there. Raises DeviceError for a point without
        elevation where every point counts.
        """
        found: list[Measurement] = []
        for stretch in layout.stretches:
            found += self._whole(compared, scenario, stretch)
            found += self._valid_part(compared, stretch)
            found += _beside(beside, stretch)
        trusted = compared.unflagged()
        if trusted is not None:
            found += [asked.measure(trusted, compared.track) for asked in self.unflagged]
        if not self.slow:
            ends, away = flags.measure_flags(compared, scenario, layout.events_m)
            found += [ends, replace(away, quantity=ELSEWHERE, limits=self.flagged_elsewhere)]
        if scenario.bump_mm:
            found.append(self._bump(compared, scenario, beside))
        return tuple(found)

    def _whole(
        self, compared: Compared, scenario: Scenario, stretch: tuple[float, float]
    ) -> list[Measurement]:
        """Return what is asked of all points; nominal may have given up slow ones."""
        given_up = self._given_up(compared, scenario)
        if not given_up.any():
            return self._all(compared, stretch)
        answered = compared.without(given_up)
        nominal = [_nominal(m) for m in self._all(answered, stretch)]
        try:
            above = self._all(compared, stretch)
        except DeviceError:
            above = [_missing(asked.quantity, compared) for asked in self.whole]
        strict = [replace(m, limits=_above_nominal(m.limits)) for m in above]
        return [*nominal, *strict]

    def _given_up(self, compared: Compared, scenario: Scenario) -> BoolArray:
        """Return the points that class nominal need not answer for, shape (n,)."""
        if not self.excused or compared.valid.all():
            return np.zeros(compared.valid.size, dtype=np.bool_)
        reach = 2 * int(AXIS_M / compared.interval_m) + 1
        speed = flags.speed_at(scenario, compared.distance_m)
        return np.asarray(~compared.valid & (minimum_filter1d(speed, reach) < SLOW_MPS))

    def _all(self, compared: Compared, stretch: tuple[float, float]) -> list[Measurement]:
        try:
            pair = compared.whole(*stretch)
        except DeviceError:
            if not self.slow:
                raise
            return [_missing(asked.quantity, compared) for asked in self.whole]
        return [asked.measure(pair, compared.track) for asked in self.whole]

    def _valid_part(
        self, compared: Compared, stretch: tuple[float, float]
    ) -> Iterator[Measurement]:
        if self.valid_part:
            pair = compared.without(~compared.valid).whole(*stretch)
            for asked in self.valid_part:
                yield asked.measure(pair, compared.track)

    def _bump(self, compared: Compared, scenario: Scenario, beside: Compared | None) -> Measurement:
        near = np.abs(compared.distance_m - scenario.bump_at_m) <= BUMP_REACH_M
        if not (self.slow or self.excused) or compared.valid[near].all():
            return _bump_on_either(compared, scenario, beside)
        try:
            found = _bump_on_either(compared, scenario, beside)
        except DeviceError:
            return _missing("bump error", compared)
        return replace(found, limits=_above_nominal(found.limits))


def _bump_on_either(compared: Compared, scenario: Scenario, beside: Compared | None) -> Measurement:
    """Return the smaller error of the bump of both axes: its place is not judged here."""
    axes = [compared] if beside is None else [compared, beside]
    return min((bump.measure_bump(axis, scenario) for axis in axes), key=lambda m: m.value)


def _beside(beside: Compared | None, stretch: tuple[float, float]) -> Iterator[Measurement]:
    """Yield the loss along the encoder's distance, which has no limit."""
    if beside is None:
        return
    try:
        pair = beside.whole(*stretch)
    except DeviceError:
        return
    yield replace(scoring.correlation(pair, beside.track, {}), quantity=BESIDE)


def _nominal(measured: Measurement) -> Measurement:
    limits: Limits = {c: v for c, v in measured.limits.items() if c is DeviceClass.NOMINAL}
    return replace(measured, limits=limits)


def _missing(quantity: str, compared: Compared) -> Measurement:
    """Return NaN for a quantity of points without elevation; only class nominal passes it."""
    return Measurement(
        quantity, compared.track, nan, "", _above_nominal(dict.fromkeys(DeviceClass, 1.0))
    )


def _above_nominal(limits: Limits) -> Limits:
    return {c: limit for c, limit in limits.items() if c is not DeviceClass.NOMINAL}


def _rule(table: Table, excused: bool) -> Rule:
    """Return the rule of a table of an edition."""
    elsewhere = table.get("flagged_elsewhere")
    return Rule(
        tuple(read_requirement(entry, WHOLE) for entry in table["whole"]),
        tuple(
            read_requirement(entry, VALID_PART, VALID_PART) for entry in table.get("valid_part", ())
        ),
        tuple(
            read_requirement(entry, UNFLAGGED, UNFLAGGED) for entry in table.get("unflagged", ())
        ),
        limits_of(elsewhere) if elsewhere else flags.EVENT_LIMITS,
        table.get("slow", False),
        excused,
    )


@cache
def rules_of(edition: Edition) -> Mapping[str, Rule]:
    """Return the rules of ``edition``, by name."""
    excused = edition.document["slow"]["excused"]
    return {name: _rule(table, excused) for name, table in edition.document["rules"].items()}


def rule_of(scenario: Scenario, edition: Edition) -> Rule:
    """Return the rule of the scenario's drive, which a driving check of ``edition`` scores."""
    named, rules = edition.document["manoeuvres"][scenario.manoeuvre], rules_of(edition)
    if "below_16_kmh" in named and scenario.speed_kmh * KMH < SLOW_MPS:
        return rules[named["below_16_kmh"]]
    if "up_to_g" in named and scenario.deceleration_g > named["up_to_g"]:
        return rules[named["beyond"]]
    return rules[named["rule"]]
