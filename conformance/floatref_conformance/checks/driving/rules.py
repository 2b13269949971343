"""What is asked of every wheel path of a drive, and the rule of each kind of drive."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import nan

import numpy as np

from floatref_conformance.checks import flags
from floatref_conformance.checks.driving import bump
from floatref_conformance.checks.driving.asked import Asked, either, loss, percent, within
from floatref_conformance.checks.driving.layout import BUMP_REACH_M, Layout
from floatref_conformance.checks.flags import SLOW_MPS
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.classes import DeviceClass, Limits
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.verdict import Measurement
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

ELSEWHERE = "flagged elsewhere"
UNLIMITED = "not limited"


@dataclass(frozen=True)
class Rule:
    """What is asked of a drive.

    Attributes:
        whole: of every scored stretch, whose points all count.
        unflagged: of all points that the device vouches for.
        flagged_elsewhere: limits of the flagged length in m around an event.
        slow: whether the vehicle stays below 16 km/h, where any length may be flagged: then it
            is not limited, and class nominal answers for nothing that it flags.
    """

    whole: tuple[Asked, ...]
    unflagged: tuple[Asked, ...] = ()
    flagged_elsewhere: Limits = field(default_factory=lambda: flags.EVENT_LIMITS)
    slow: bool = False

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """For each quantity, the limit of each class in words."""
        table: dict[str, dict[DeviceClass, str]] = {}
        for asked in (*self.whole, *self.unflagged):
            row = table.setdefault(asked.quantity, dict.fromkeys(DeviceClass, UNLIMITED))
            row |= asked.words
        if not self.slow:
            table["flagged at an end"] = _words(flags.END_LIMITS, "m")
            table[ELSEWHERE] = _words(self.flagged_elsewhere, "m")
        table["bump error"] = _words(bump.LIMITS, "%")
        return table

    def measure(
        self, compared: Compared, scenario: Scenario, layout: Layout
    ) -> tuple[Measurement, ...]:
        """Return what is asked of one wheel path.

        Raises DeviceError for a point without elevation where every point counts.
        """
        found = [m for start, end in layout.stretches for m in self._whole(compared, start, end)]
        trusted = compared.unflagged()
        if trusted is not None:
            found += [asked.measure(trusted, compared.track) for asked in self.unflagged]
        if not self.slow:
            ends, away = flags.flagged(compared, scenario, layout.events_m)
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
    """Return what no class above nominal passes: a quantity of points without elevation."""
    return Measurement(
        quantity, compared.track, nan, "", _above_nominal(dict.fromkeys(DeviceClass, 1.0))
    )


def _above_nominal(limits: Limits) -> Limits:
    return {c: limit for c, limit in limits.items() if c is not DeviceClass.NOMINAL}


def _words(limits: Limits, unit: str) -> dict[DeviceClass, str]:
    return {c: f"{limit:g} {unit}" for c, limit in limits.items()}


NOMINAL, ADEQUATE, REFERENCE = DeviceClass
LIGHT_G = 0.16
"""Braking up to here rarely raised the roughness (3.3.1.3)."""
UNFLAGGED, WHOLE = "IRI error, unflagged part", "IRI error, 160.9 m"
EVENT_LOSS: Limits = {ADEQUATE: 0.08, REFERENCE: 0.02}
EVENT_PERCENT: Limits = {ADEQUATE: 5.0, REFERENCE: 2.0}
UNPROVOKED: Limits = {NOMINAL: 10.0, ADEQUATE: 10.0, REFERENCE: 5.0}
"""Longest flagged length in m, away from the ends, of a drive without an event within it."""

CONSTANT = Rule(
    whole=(
        loss({NOMINAL: 0.08, ADEQUATE: 0.05, REFERENCE: 0.02}),
        percent({NOMINAL: 5.0, ADEQUATE: 3.0, REFERENCE: 2.0}),
    ),
    flagged_elsewhere=UNPROVOKED,
)
"""At constant speed."""
LIGHT = Rule(whole=(either(NOMINAL, 0.08, 10.0), loss(EVENT_LOSS), percent(EVENT_PERCENT)))
"""Coasting, throttle, and braking up to `LIGHT_G`."""
HARD = Rule(
    whole=(within(WHOLE, NOMINAL, 50.0, 1.0), loss(EVENT_LOSS), percent(EVENT_PERCENT)),
    unflagged=(within(UNFLAGGED, NOMINAL, 5.0, 0.1),),
)
"""Braking beyond `LIGHT_G`, near stops and stops."""
START = Rule(HARD.whole, HARD.unflagged, UNPROVOKED)
"""A start from rest: its event lies at an end of the run."""
SLOW = Rule(
    whole=(loss({ADEQUATE: 0.08, REFERENCE: 0.05}), percent({ADEQUATE: 5.0, REFERENCE: 3.0})),
    unflagged=(percent({NOMINAL: 5.0}, UNFLAGGED),),
    slow=True,
)
"""Below 16 km/h all the way."""


def rule_of(scenario: Scenario) -> Rule:
    """Return the rule for the scenario's drive."""
    if scenario.manoeuvre == "constant":
        return SLOW if scenario.speed_kmh * KMH < SLOW_MPS else CONSTANT
    if scenario.manoeuvre == "braking":
        return LIGHT if scenario.deceleration_g <= LIGHT_G else HARD
    return _BY_MANOEUVRE.get(scenario.manoeuvre, HARD)


_BY_MANOEUVRE = {"creeping": SLOW, "coasting": LIGHT, "throttle": LIGHT, "dead-start": START}
