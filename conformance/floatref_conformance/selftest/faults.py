"""Graded errors of `faults`: beside a fault, around it, and at the ends."""

from dataclasses import replace

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.driving.rules import ELSEWHERE
from floatref_conformance.checks.faults.check import FaultsCheck
from floatref_conformance.checks.faults.fault_scores import BASE_M
from floatref_conformance.classes import Effort
from floatref_conformance.devices.interface import CAPABILITIES, Description
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.selftest import put_in
from floatref_conformance.selftest.grading import AddError, Graded, Put, Situation

INTERVAL_M = 0.02
LOCAL_AT_M = 400.0
"""Place of a local error in m, away from the fault."""
EQUIPPED = Description("perfect", "1", "temporal", tuple(CAPABILITIES))
LABEL = "with the fault"
CLEAR_M = 30.0
"""Distance from a stop in m beyond which every vehicle drives at 16 km/h or more."""


def situations(check: FaultsCheck) -> tuple[Situation, ...]:
    """Return one fault of each part, each in a separate drive, with ideal sensors."""
    parts: dict[str, Case] = {}
    for case in check.cases(0, Effort.QUICK):
        parts.setdefault(str(case.variation["fault"]).partition("-")[0], case)
    rolling = next(c for c in check.cases(0, Effort.QUICK) if c.scenario.manoeuvre == "stop")
    around = Graded(("flagged around an event",), _flag_before(rolling.scenario.event_at_m))
    return (
        *(_make_situation(check, part, case) for part, case in parts.items()),
        Situation(check, _simplify(rolling), (around,), description=EQUIPPED),
    )


def _flag_before(event_m: float) -> Put:
    end_m = event_m - CLEAR_M
    return lambda v: put_in.flag_points(end_m - v, end_m)


def _make_situation(check: FaultsCheck, part: str, case: Case) -> Situation:
    plain = _simplify(case)
    beyond = Graded((f"flagged beyond a fault: {part}",), _flag_from(case))
    graded = (beyond, *_shared_graded(plain.scenario)) if part == "laser" else (beyond,)
    return Situation(check, plain, graded, description=EQUIPPED)


def _simplify(case: Case) -> Case:
    """Return ``case`` with one wheel path and ideal sensors."""
    scenario = replace(
        case.scenario,
        tracks=("left",),
        rate_hz=4000.0,
        sensors=0.0,
        iri_m_per_km=3.0,
        profile_interval_m=INTERVAL_M,
    )
    return replace(case, scenario=scenario)


def _shared_graded(scenario: Scenario) -> tuple[Graded, ...]:
    """Return the quantities that do not depend on the faulty sensor."""
    middle_m = scenario.length_m / 2
    return (
        Graded(("IRI error, unflagged",), lambda v: put_in.make_rougher(v, 0.0, scenario.length_m)),
        Graded(("local error, unflagged",), _with_fault_only(_local)),
        Graded(("flagged at an end",), put_in.flag_end),
        Graded(
            (ELSEWHERE,),
            lambda v: put_in.flag_points(middle_m - v / 2, middle_m + v / 2),
        ),
    )


def _with_fault_only(put: Put) -> Put:
    return lambda amount: put_in.limit_to_labels(put(amount), LABEL)


def _local(m_per_km: float) -> AddError:
    """Return an error of the IRI filter's output by ``m_per_km`` over the base length."""
    return put_in.change_locally(m_per_km, LOCAL_AT_M, BASE_M)


def _flag_from(case: Case) -> Put:
    """Return a function that flags the distance of the fault, and a length around it."""
    at_m, speed = float(case.variation["at_m"]), case.scenario.speed_kmh / 3.6
    extent_m = speed * float(case.variation["length_s"])
    return _with_fault_only(lambda v: put_in.flag_points(at_m - v / 2, at_m + extent_m + v / 2))
