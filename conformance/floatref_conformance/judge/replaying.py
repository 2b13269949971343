"""One case on one device: what a check measures of it, and what the device did wrong."""

from dataclasses import replace

from floatref.errors import InputError
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.interface import Check
from floatref_conformance.classes import Effort
from floatref_conformance.devices.interface import Device
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceSkipped
from floatref_conformance.judge.bench import DeviceBench
from floatref_conformance.judge.exercise import close, describe
from floatref_conformance.judge.judging import describe_missing
from floatref_conformance.judge.verdict import CaseResult


def judge_case(check: Check, case: Case, bench: DeviceBench) -> CaseResult:
    """Return what the device on ``bench`` makes of ``case``; its faults are in the result."""
    result = CaseResult(case.name, case.parameters)
    try:
        measured = check.judge(case, bench)
    except DeviceSkipped as skipped:
        return replace(result, skipped=str(skipped))
    except DeviceError as error:
        hung, passes = isinstance(error, DeviceHung), tuple(bench.passes)
        return replace(result, fault=str(error), hung=hung, passes=passes)
    flagged, passes = bench.flagged_m, tuple(bench.passes)
    return replace(result, measurements=tuple(measured), flagged_m=flagged, passes=passes)


def refuse_foreign(check: Check, case: Case) -> None:
    """Raise InputError for a number that no case of ``check`` has, which it would not look at.

    The edition's cases have between them every number of its checks; a plug-in's may not.
    """
    if check.id not in IDS:
        return
    cases = (check.simplest, *check.cases(0, Effort.CERTIFICATION))
    known = sorted({name for one in cases for name in one.variation})
    for name in case.variation:
        if name not in known:
            others = f"known: {', '.join(known)}" if known else f"{check.id} has none"
            raise InputError(f"variation {name}: unknown; {others}")


def replay(device: Device, check: Check, case: Case) -> CaseResult:
    """Return what ``device`` makes of ``case`` outside any run, and close the device.

    It is skipped for a device without what ``check`` needs. Raises InputError
    for numbers that make no case of it.
    """
    try:
        refuse_foreign(check, case)
        result = _judge_alone(device, check, case)
    except BaseException:
        close(device)
        raise
    fault = close(device)
    if not fault or result.fault is not None:
        return result
    return replace(result, fault=f"at its end the device {fault}")


def _judge_alone(device: Device, check: Check, case: Case) -> CaseResult:
    try:
        description = describe(device)
    except DeviceError as fault:
        return CaseResult(case.name, case.parameters, fault=str(fault))
    missing = check.needs - description.meets
    if missing:
        return CaseResult(case.name, case.parameters, skipped=describe_missing(missing))
    return judge_case(check, case, DeviceBench(device, description))
