"""From the cases of a check to its outcome."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from floatref.values.profile import Profile
from floatref_conformance import oracle
from floatref_conformance.checks.catalogue import LeftOut
from floatref_conformance.checks.interface import Check
from floatref_conformance.classes import DeviceClass, lowest
from floatref_conformance.verdict import CaseResult, CheckResult, Measurement, Outcome


def check_result(
    check: Check, cases: Sequence[CaseResult], device_class: DeviceClass
) -> CheckResult:
    """Return the outcome of ``check`` from its ``cases``, for a device of ``device_class``.

    A faulty device is an error; else the worst measurement decides. Raises SuiteError if the
    oracle does not confirm the worst IRI.
    """
    measured = [m for case in cases for m in case.measurements]
    _confirm_worst(check.id, measured, device_class)
    worst_case = max(cases, key=lambda case: case.ratio(device_class))
    worst = max(measured, key=lambda m: m.ratio(device_class), default=None)
    outcome, reason = _outcome(cases, worst, device_class)
    return CheckResult(
        id=check.id,
        clause=check.clause,
        outcome=outcome,
        reason=reason,
        class_reached=(
            None if outcome is Outcome.ERROR else lowest([m.class_reached for m in measured])
        ),
        cases=len(cases),
        worst=worst,
        counterexample=None if outcome is Outcome.PASS else _counterexample(worst_case, reason),
        flagged_m=max(case.flagged_m for case in cases),
    )


def flagged_m(profile: Profile) -> float:
    """Return the largest length in m of a wheel path in ``profile`` that is flagged invalid."""
    return max(profile.interval_m * float(np.sum(~track.valid)) for track in profile.tracks)


def not_applicable_result(check: Check, missing: frozenset[str]) -> CheckResult:
    """Return the result of a check that needs capabilities ``missing`` from the device."""
    reason = f"needs {', '.join(sorted(missing))}, which the device does not declare"
    return CheckResult(check.id, check.clause, Outcome.NOT_APPLICABLE, reason)


def left_out_result(left_out: LeftOut) -> CheckResult:
    """Return the result of a check that was not run."""
    return CheckResult(left_out.id, left_out.clause, Outcome.SKIP, left_out.reason)


def _confirm_worst(id_: str, measured: Sequence[Measurement], device_class: DeviceClass) -> None:
    shown = [m for m in measured if m.evidence is not None]
    if shown:
        oracle.confirm(id_, max(shown, key=lambda m: m.ratio(device_class)))


def _outcome(
    cases: Sequence[CaseResult], worst: Measurement | None, device_class: DeviceClass
) -> tuple[Outcome, str]:
    faults = [case for case in cases if case.fault is not None]
    if faults or worst is None:
        first = faults[0] if faults else cases[0]
        return Outcome.ERROR, f"{first.name}: {first.fault or 'nothing was measured'}"
    if worst.within(device_class):
        return Outcome.PASS, ""
    limit = worst.limits[device_class]
    return Outcome.FAIL, (
        f"{worst.quantity}, track {worst.track}: {worst.value:.4g} {worst.unit}, "
        f"limit {limit:.4g} {worst.unit}"
    )


def _counterexample(case: CaseResult, reason: str) -> Mapping[str, Any]:
    return {"case": case.name, "parameters": dict(case.parameters), "reason": reason}
