"""Running checks on a device: a stream of events that ends with the verdict."""

from collections.abc import Generator, Iterator
from dataclasses import asdict, dataclass

from floatref_conformance.checks.catalogue import IDS, LeftOut
from floatref_conformance.checks.interface import Case, Check
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.events import (
    CaseFinished,
    CheckFinished,
    CheckStarted,
    Event,
    RunFinished,
    RunStarted,
)
from floatref_conformance.exercise import describe, exercise
from floatref_conformance.judging import (
    check_result,
    flagged_m,
    left_out_result,
    not_applicable_result,
)
from floatref_conformance.verdict import CaseResult, CheckResult, RunResult


@dataclass(frozen=True)
class Plan:
    """A device, the checks to run on it, and those that are left out."""

    spec: str
    device: Device
    checks: tuple[Check, ...]
    left_out: tuple[LeftOut, ...]
    device_class: DeviceClass = DeviceClass.NOMINAL
    seed: int = 0
    effort: Effort = Effort.QUICK


def run(plan: Plan) -> Iterator[Event]:
    """Yield what happens. Raises SuiteError, sys.exit included, and then there is no verdict."""
    try:
        yield from _run(plan)
    except SuiteError:
        raise
    except (Exception, SystemExit) as error:
        text = " ".join(str(error).split())
        raise SuiteError(f"{type(error).__name__}: {text}") from error


def _run(plan: Plan) -> Iterator[Event]:
    description, fault = _described(plan.device)
    yield RunStarted(plan.spec, description, plan.checks, plan.left_out)
    results = []
    for check in plan.checks:
        missing = check.needs - set(description.capabilities)
        if missing:
            result = not_applicable_result(check, missing)
        else:
            result = yield from _check(plan, check, description, fault)
        results.append(result)
        yield CheckFinished(result)
    results += [left_out_result(left_out) for left_out in plan.left_out]
    yield RunFinished(_run_result(plan, description, results))


def _described(device: Device) -> tuple[Description, str | None]:
    try:
        return describe(device), None
    except DeviceError as fault:
        return Description("unknown", "unknown", "unknown", ()), str(fault)


def _check(
    plan: Plan, check: Check, description: Description, fault: str | None
) -> Generator[Event, None, CheckResult]:
    """Yield the events of one check; its generator returns the result."""
    cases = check.cases(plan.seed, plan.effort)
    yield CheckStarted(check.id, len(cases))
    results = []
    for case in cases:
        result = (
            CaseResult(case.name, case.parameters, fault=fault)
            if fault
            else _case(plan.device, description, check, case)
        )
        results.append(result)
        yield CaseFinished(check.id, result)
    return check_result(check, results, plan.device_class)


def _case(device: Device, description: Description, check: Check, case: Case) -> CaseResult:
    simulated = case.simulate()
    try:
        profile = exercise(device, description, simulated.recording)
        measured = check.judge(case, profile, simulated)
    except DeviceError as error:
        return CaseResult(case.name, case.parameters, fault=str(error))
    return CaseResult(case.name, case.parameters, measured, flagged_m=flagged_m(profile))


def _run_result(plan: Plan, description: Description, results: list[CheckResult]) -> RunResult:
    order = [*IDS, *(r.id for r in results if r.id not in IDS)]
    return RunResult(
        device={"spec": plan.spec, **asdict(description)},
        device_class=plan.device_class,
        seed=plan.seed,
        effort=plan.effort.value,
        checks=tuple(sorted(results, key=lambda r: order.index(r.id))),
    )
