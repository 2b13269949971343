"""One case on one device: the measurements of the check, and the faults of the device."""

from dataclasses import replace

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.verdict import CaseResult
from floatref_conformance.classes import Effort
from floatref_conformance.devices.interface import Device
from floatref_conformance.editions.edition import Edition
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceSkipped
from floatref_conformance.judge.bench import DeviceBench
from floatref_conformance.judge.exercise import close, describe
from floatref_conformance.judge.judging import describe_missing


def judge_case(check: Check, case: Case, bench: DeviceBench) -> CaseResult:
    """Return the result of ``case`` for the device on ``bench``, with the device's faults."""
    result = CaseResult(case.name, case.parameters)
    try:
        measured = check.judge(case, bench)
    except DeviceSkipped as skipped:
        return replace(result, skipped=str(skipped))
    except DeviceError as error:
        return replace(
            result,
            fault=str(error),
            hung=isinstance(error, DeviceHung),
            passes=tuple(bench.passes),
            false_alarms=bench.false_alarms,
        )
    return replace(
        result,
        measurements=tuple(measured),
        flagged_m=bench.flagged_m,
        early_m=bench.early_m,
        passes=tuple(bench.passes),
        nees=bench.nees,
    )


def refuse_foreign(check: Check, case: Case) -> None:
    """Raise InputError for a number that no case of ``check`` has, and that it would ignore.

    The cases of the edition together use every number of their check; those of a plug-in may not.
    """
    if check.id not in IDS:
        return
    cases = (check.simplest, *check.cases(0, Effort.CERTIFICATION))
    known = sorted({name for one in cases for name in one.variation})
    for name in case.variation:
        if name not in known:
            others = suggest(name, known, "known:") if known else f"{check.id} has no variation"
            raise InputError(f"variation {name}: unknown; {others}")


def replay(device: Device, check: Check, case: Case, edition: Edition) -> CaseResult:
    """Return the result of ``case`` of ``edition`` for ``device`` outside any run.

    The device is closed.

    The case is skipped for a device that does not meet the needs of ``check``. Raises InputError
    for numbers that make no case of the check.
    """
    try:
        refuse_foreign(check, case)
        result = _judge_alone(device, check, case, edition)
    except BaseException:
        close(device)
        raise
    fault = close(device)
    if not fault or result.fault is not None:
        return result
    return replace(result, fault=f"when it was stopped, the device {fault}")


def _judge_alone(device: Device, check: Check, case: Case, edition: Edition) -> CaseResult:
    try:
        description = describe(device)
    except DeviceError as fault:
        return CaseResult(case.name, case.parameters, fault=str(fault))
    missing = check.needs - description.meets
    if missing:
        return CaseResult(case.name, case.parameters, skipped=describe_missing(missing))
    return judge_case(check, case, DeviceBench(device, description, edition=edition))
