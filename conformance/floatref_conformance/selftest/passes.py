"""Graded errors of checks that compare two results: `repeatability` and `invariance`."""

from dataclasses import replace

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.sameness import repeatability, two_passes
from floatref_conformance.checks.sameness.changed_drives import (
    BEFORE_M,
    BEHIND_M,
    END_M,
    FREE_M,
    STOP,
)
from floatref_conformance.checks.sameness.invariance import FROM_M, RAN_IN_M, InvarianceCheck
from floatref_conformance.checks.sameness.repeatability import RepeatabilityCheck
from floatref_conformance.classes import Effort
from floatref_conformance.selftest import put_in
from floatref_conformance.selftest.grading import Graded, Put, Situation

INTERVAL_M = 0.01
FINE_M = 0.0025
"""Profile interval in m; displacements are measured in whole intervals."""


def situations_of_repeatability(check: RepeatabilityCheck) -> tuple[Situation, ...]:
    """Return two passes at one speed, with one wheel path and ideal sensors."""
    scenario = replace(
        check.simplest.scenario,
        tracks=("left",),
        rate_hz=4000.0,
        sensors=0.0,
        profile_interval_m=INTERVAL_M,
    )
    stretch = two_passes.START_M, two_passes.END_M
    second = repeatability.LABELS[1]
    graded = (
        Graded(
            (two_passes.BETWEEN,),
            lambda loss: put_in.limit_to_labels(put_in.mix_in_road(loss, *stretch), second),
        ),
        Graded(
            (two_passes.DIFFERENCE,),
            lambda percent: put_in.limit_to_labels(put_in.make_higher(percent / 100.0), second),
        ),
        Graded((repeatability.TO_TRUTH,), lambda loss: put_in.mix_in_road(loss, *stretch)),
    )
    return (Situation(check, replace(check.simplest, scenario=scenario), graded),)


def situations_of_invariance(check: InvarianceCheck) -> tuple[Situation, ...]:
    """Return a drive with another storage of its clock, and one with a stop twice as long."""
    steady = replace(
        check.simplest.scenario, sensors=0.0, rate_hz=4000.0, profile_interval_m=FINE_M
    )
    stretch = FROM_M, steady.length_m - END_M
    graded = (
        Graded(
            ("correlation loss between both",),
            _change_only(lambda v: put_in.mix_in_road(v, *stretch)),
        ),
        Graded(("IRI difference of both",), _change_only(lambda v: put_in.make_higher(v / 100.0))),
        Graded(("displacement between both",), _change_only(put_in.move_features)),
        Graded(("correlation loss",), lambda loss: put_in.mix_in_road(loss, *stretch)),
    )
    return (
        Situation(check, replace(check.simplest, scenario=steady), graded),
        _at_a_stop(check),
    )


def _at_a_stop(check: InvarianceCheck) -> Situation:
    drives = check.cases(0, Effort.QUICK)
    case: Case = next(c for c in drives if c.variation["change"] == STOP)
    scenario = replace(
        case.scenario, sensors=0.0, dwell_s=1.0, profile_interval_m=INTERVAL_M, vehicle="loaded-van"
    )
    ends = scenario.event_at_m - BEFORE_M, scenario.event_at_m + BEHIND_M
    graded = (
        Graded(("rise of the IRI error",), _change_only(lambda v: put_in.make_rougher(v, *ends))),
        Graded(("correlation loss",), lambda loss: put_in.mix_in_road(loss, RAN_IN_M, FREE_M)),
    )
    return Situation(check, replace(case, scenario=scenario), graded)


def _change_only(put: Put) -> Put:
    return lambda amount: put_in.limit_to_labels(put(amount), "changed")
