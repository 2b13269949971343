"""From the cases of a check to its outcome."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from floatref_conformance.case_files import name_of
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.catalogue import LeftOut
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.nees import nees_ends
from floatref_conformance.checks.stretches import Stretches
from floatref_conformance.checks.verdict import CaseResult, CheckResult, Measurement, Outcome
from floatref_conformance.classes import DeviceClass, lowest
from floatref_conformance.devices.interface import HEIGHT, NEEDS, RESPONSE
from floatref_conformance.judge import oracle


class Known(Protocol):
    """What a result takes of a check, of recordings or of streams."""

    @property
    def id(self) -> str:
        """Name by which the check is selected."""

    @property
    def clause(self) -> str:
        """Where its limits come from."""


def check_result(
    check: Known,
    cases: Sequence[CaseResult],
    device_class: DeviceClass,
    simpler: tuple[Case, CaseResult] | None = None,
) -> CheckResult:
    """Return the outcome of ``check`` from its ``cases``, for a device of ``device_class``.

    A fault of the device is an error; otherwise the worst measurement decides. ``simpler`` is the
    simplest failing case. Raises SuiteError if the oracle does not confirm the worst measurement,
    or that of the judge's table.
    """
    worst, worst_case = _find_largest(cases, lambda m: m.rank(device_class))
    shown, shown_case = _find_largest(cases, lambda m: m.rank_in_table(device_class))
    if worst is not None:
        oracle.confirm(check.id, worst)
    if shown is not None and shown is not worst:
        oracle.confirm(check.id, shown)
    outcome, reason = _outcome(cases, worst, device_class)
    failed = outcome in (Outcome.FAIL, Outcome.ERROR)
    if failed and simpler and simpler[1].again:
        reason = f"{reason}; the simplest case {_describe_unsteady(simpler[1])}"
    return CheckResult(
        id=check.id,
        clause=check.clause,
        outcome=outcome,
        reason=reason,
        class_reached=_class_reached(cases, outcome),
        cases=len(cases),
        worst=worst,
        worst_case=worst_case,
        counterexample=_counterexample(*simpler, device_class) if failed and simpler else None,
        flagged_m=max(case.flagged_m for case in cases),
        early_m=max(case.early_m for case in cases),
        false_alarms=sum(case.false_alarms for case in cases),
        nees=nees_ends((case.name, case.nees) for case in cases),
        passes=simpler[1].passes if failed and simpler else (),
        scored_m=find_scored(check, simpler[0]) if failed and simpler else (),
        worst_track=_worst_track(simpler[1], device_class) if failed and simpler else "",
        shown=shown,
        shown_case=shown_case,
    )


def _find_largest(
    cases: Sequence[CaseResult], rank: Callable[[Measurement], tuple[float, ...]]
) -> tuple[Measurement | None, str]:
    """Return the measurement of ``cases`` that ``rank`` puts last, and the name of its case."""
    measured = ((m, case.name) for case in cases for m in case.measurements)
    return max(measured, key=lambda pair: rank(pair[0]), default=(None, ""))


def find_scored(check: Known, case: Case) -> Stretches:
    """Return the stretches that ``check`` scores in ``case``; empty if it raises or has no such.

    They are only for pictures and do not affect the verdict.
    """
    list_scored: Callable[[Case], Stretches] = getattr(check, "list_scored", lambda _: ())
    try:
        return tuple((float(start), float(end)) for start, end in list_scored(case))
    except (Exception, SystemExit):
        return ()


def find_failing(cases: Sequence[CaseResult], device_class: DeviceClass) -> CaseResult | None:
    """Return the worst failing case of ``cases``; None if all pass."""
    worst = max(cases, key=lambda case: case.ratio(device_class))
    return worst if worst.ratio(device_class) > 1.0 else None


def describe_failure(case: CaseResult, device_class: DeviceClass) -> str:
    """Return in one line why ``case`` fails; empty if it passes."""
    if case.fault is not None:
        return case.fault
    worst = case.worst(device_class)
    if worst is None or worst.within(device_class):
        return ""
    value, limit = (
        f"{number:.4g} {worst.unit}".strip() for number in (worst.value, worst.limits[device_class])
    )
    return f"{worst.quantity}, track {worst.track}: {value}, limit {limit}"


def not_applicable_result(check: Check, missing: frozenset[str]) -> CheckResult:
    """Return the result of a check that needs ``missing`` of `NEEDS` from the device."""
    return CheckResult(check.id, check.clause, Outcome.NOT_APPLICABLE, describe_missing(missing))


def describe_missing(missing: frozenset[str]) -> str:
    """Return the sentence that a check needs ``missing``, which the device does not have."""
    undeclared = ", ".join(sorted(missing - {HEIGHT}))
    parts = [f"needs {undeclared}, which the device does not declare"] if undeclared else []
    if HEIGHT in missing:
        parts.append(f"needs {NEEDS[HEIGHT]}, which architecture {RESPONSE} does not have")
    return "; ".join(parts)


def left_out_result(left_out: LeftOut) -> CheckResult:
    """Return the result of a check that was not run."""
    return CheckResult(left_out.id, left_out.clause, Outcome.SKIP, left_out.reason)


def given_up_result(check: Check, reason: str) -> CheckResult:
    """Return the result of a check that is not run because the device hung too often."""
    return CheckResult(check.id, check.clause, Outcome.ERROR, reason)


def _class_reached(cases: Sequence[CaseResult], outcome: Outcome) -> DeviceClass | None:
    if outcome not in (Outcome.PASS, Outcome.FAIL):
        return None
    return lowest([m.class_reached for case in cases for m in case.measurements])


def _outcome(
    cases: Sequence[CaseResult], worst: Measurement | None, device_class: DeviceClass
) -> tuple[Outcome, str]:
    faults = [case for case in cases if case.fault is not None]
    if faults:
        return Outcome.ERROR, f"{faults[0].name}: {faults[0].fault}"
    failed = find_failing(cases, device_class)
    if failed is not None:
        return Outcome.FAIL, describe_failure(failed, device_class)
    skipped = [case for case in cases if case.skipped is not None]
    if skipped:
        return Outcome.SKIP, f"{skipped[0].name}: {skipped[0].skipped}"
    if worst is None:
        return Outcome.ERROR, f"{cases[0].name}: nothing was measured"
    return Outcome.PASS, ""


def _counterexample(case: Case, result: CaseResult, device_class: DeviceClass) -> Mapping[str, Any]:
    reason = describe_failure(result, device_class)
    return {
        "case": result.name,
        "parameters": dict(result.parameters),
        "reason": f"{reason}; {_describe_unsteady(result)}" if result.again else reason,
        "file": name_of(case),
    }


def _worst_track(case: CaseResult, device_class: DeviceClass) -> str:
    worst = case.worst(device_class)
    return "" if worst is None else worst.track


def _describe_unsteady(result: CaseResult) -> str:
    return f"{result.again} when run again: the device does not fail it every time"
