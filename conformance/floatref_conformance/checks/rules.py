"""The limits of the driving checks, by what the drive does."""

from floatref_conformance.checks.asked import either, loss, percent, within
from floatref_conformance.checks.flags import SLOW_MPS
from floatref_conformance.checks.rule import Rule
from floatref_conformance.classes import DeviceClass, Limits
from floatref_conformance.proving_ground.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

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
