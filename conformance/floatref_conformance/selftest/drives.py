"""Graded errors of the driving checks."""

from collections.abc import Iterator

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.driving.asked import ERROR, LOSS
from floatref_conformance.checks.driving.check import DrivingCheck
from floatref_conformance.checks.driving.layout import Layout, layout_of, place
from floatref_conformance.checks.driving.rules import (
    ELSEWHERE,
    UNFLAGGED,
    VALID_PART,
    WHOLE,
    Rule,
    rule_of,
    rules_of,
)
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.editions.edition import Edition
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import BUMP_LENGTH_M
from floatref_conformance.selftest import put_in
from floatref_conformance.selftest.grading import AddError, Graded, Put, Situation

NOMINAL, ADEQUATE, REFERENCE = DeviceClass
IRI_M_PER_KM = 3.0
"""IRI of the road: 5 % of it are more than 0.1 m/km, and 50 % more than 1 m/km."""
EITHER_PERCENT = 10.0
"""Percent by which the profile is lowered: it loses 0.1 of the correlation, beyond that limit."""
AROUND_M = 60.0
"""Length in m flagged on each side of an event: less than 125 m in total."""
SLOW_M = 15.0
"""Around an event in m: a device may give up what is driven below 16 km/h, and 5 m beside it."""
ERROR_M = 40.0
"""Length in m of the error on each side; the IRI's car has settled where the flags end."""
FAST_KMH = 20.0
AWAY_M = 60.0
"""Distance from an event in m beyond which every vehicle drives at 16 km/h or more."""


def situations(check: DrivingCheck) -> tuple[Situation, ...]:
    """Return one drive for each rule of ``check``: ideal sensors, one wheel path."""
    return tuple(
        Situation(check, case, tuple(_list_graded(case.scenario, rule, check.edition)), condition)
        for condition, rule in check.rules.items()
        for case in (_case(check, rule),)
    )


def _case(check: DrivingCheck, rule: Rule) -> Case:
    rows = (case.scenario for case in check.cases(0, Effort.CERTIFICATION))
    row = next(row for row in rows if rule_of(row, check.edition) is rule and _stays_fast(row))
    plain = check.edition.make_scenario(
        manoeuvre=row.manoeuvre,
        speed_kmh=row.speed_kmh,
        event_speed_kmh=row.event_speed_kmh,
        deceleration_g=row.deceleration_g,
        final_speed_kmh=row.final_speed_kmh,
        dwell_s=1.0,
        iri_m_per_km=IRI_M_PER_KM,
        sensors=0.0,
        tracks=("left",),
        rate_hz=4000.0,
        profile_interval_m=0.01,
    )
    return Case(check.id, place(plain, check.edition))


def _stays_fast(row: Scenario) -> bool:
    """Return whether both ends of the drive are driven at 16 km/h or more."""
    return row.manoeuvre != "braking" or row.event_speed_kmh > FAST_KMH


def _list_graded(scenario: Scenario, rule: Rule, edition: Edition) -> Iterator[Graded]:
    layout, rules = layout_of(scenario), rules_of(edition)
    start_m, end_m = layout.stretches[-1]
    above = (ADEQUATE, REFERENCE) if rule is rules["light"] else tuple(DeviceClass)
    yield Graded((LOSS,), lambda loss: put_in.mix_in_road(loss, start_m, end_m), above)
    yield Graded((ERROR,), _make_higher, above)
    if rule is rules["light"]:
        yield Graded(
            (LOSS, ERROR),
            lambda percent: put_in.make_higher(-percent / 100.0),
            (NOMINAL,),
            limit=EITHER_PERCENT,
        )
    unflagged = _make_higher if rule.slow else _make_rougher(0.0, scenario.length_m)
    yield Graded((UNFLAGGED,), unflagged)
    yield Graded((VALID_PART,), _make_rougher(start_m, end_m), alone=False)
    yield Graded((WHOLE,), _around_event(layout), alone=rule is not rules["start"])
    if not rule.slow:
        yield Graded(("flagged at an end",), put_in.flag_end)
        yield Graded((ELSEWHERE,), _flag_away(scenario, layout))
    yield Graded(("bump error",), lambda percent: _change_bump(scenario, percent))


def _make_higher(percent: float) -> AddError:
    return put_in.make_higher(percent / 100.0)


def _make_rougher(start_m: float, end_m: float) -> Put:
    return lambda m_per_km: put_in.make_rougher(m_per_km, start_m, end_m)


def _around_event(layout: Layout) -> Put:
    """Return a function that puts the whole error near an event, and flags it."""
    start_m, end_m = layout.stretches[0]
    event_m = layout.events_m[0] if layout.events_m else (start_m + end_m) / 2
    before = put_in.between(event_m - ERROR_M, event_m - SLOW_M)
    behind = put_in.between(event_m + SLOW_M, event_m + ERROR_M)
    flags = put_in.flag_points(event_m - AROUND_M, event_m + AROUND_M)
    return lambda v: put_in.chain(
        put_in.make_rougher(v, start_m, end_m, lambda x: before(x) + behind(x)), flags
    )


def _flag_away(scenario: Scenario, layout: Layout) -> Put:
    """Return a function that flags a length before the event, or in the middle without one."""
    middle_m = scenario.length_m / 2

    def put(length_m: float) -> AddError:
        end_m = layout.events_m[0] - AWAY_M if layout.events_m else middle_m + length_m / 2
        return put_in.flag_points(end_m - length_m, end_m)

    return put


def _change_bump(scenario: Scenario, percent: float) -> AddError:
    height_m = percent / 100.0 * scenario.bump_mm / 1000.0
    return put_in.add_shape(
        lambda x: height_m * put_in.raised_cosine(x - scenario.bump_at_m, BUMP_LENGTH_M)
    )
