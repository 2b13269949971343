"""Running checks on a device: events on the way, a result at the end."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref_conformance.case_files import KeptCase
from floatref_conformance.checks.catalogue import IDS, LeftOut
from floatref_conformance.checks.interface import Check, fit_check
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.judge.bench import Ahead
from floatref_conformance.judge.events import (
    CaseReplayed,
    CheckFinished,
    Event,
    RunFinished,
    RunStarted,
)
from floatref_conformance.judge.exercise import Closing, describe
from floatref_conformance.judge.judging import (
    given_up_result,
    left_out_result,
    not_applicable_result,
)
from floatref_conformance.judge.trial import Trial
from floatref_conformance.judge.verdict import CheckResult, Outcome, RunResult
from floatref_conformance.judge.waivers import waive

UNDESCRIBED = Description("unknown", "unknown", "unknown", ())
"""What is said of a device that does not say it itself."""


@dataclass(frozen=True)
class Plan:
    """A device, the checks to run on it, and those that are left out.

    Attributes:
        spec: how the user names the device.
        device: what is judged.
        checks: what is run, in order.
        left_out: what is not, and why.
        device_class: whose limits decide.
        seed: draws roads, noise and the search.
        effort: sets the number of cases.
        kept: cases from earlier runs, to be run again.
        searching: whether cases are drawn that depend on the device's answers.
        waivers: why a failure of a check is known, by its id.
        ahead: whether the next cases are simulated while the device works.
        timeout_s, report: time for a recording and folder of the report, told to reproduce it.
    """

    spec: str
    device: Device
    checks: tuple[Check, ...]
    left_out: tuple[LeftOut, ...] = ()
    device_class: DeviceClass = DeviceClass.NOMINAL
    seed: int = 0
    effort: Effort = Effort.QUICK
    kept: tuple[KeptCase, ...] = ()
    searching: bool = True
    waivers: Mapping[str, str] = field(default_factory=dict)
    ahead: bool = False
    timeout_s: float | None = None
    report: Path | None = None


def run(plan: Plan, emit: Callable[[Event], None]) -> RunResult:
    """Return the result of ``plan``; ``emit`` is given what happens on the way.

    Raises SuiteError, for sys.exit in a check as well, and then there is no verdict. Whatever
    happens, the device is closed once.
    """
    closing = Closing(plan.device)
    try:
        return _run(plan, emit, closing)
    except (SuiteError, BrokenPipeError, KeyboardInterrupt):
        raise
    except (Exception, SystemExit) as error:
        text = " ".join(str(error).split())
        raise SuiteError(f"{type(error).__name__}: {text}") from error
    finally:
        closing.close()


def _run(plan: Plan, emit: Callable[[Event], None], closing: Closing) -> RunResult:
    description, fault = _describe(plan.device)
    emit(RunStarted(plan.spec, description, plan.checks, plan.left_out))
    trial = Trial(plan.device, description, plan.device_class, emit, fault)
    with _simulate_ahead(plan, trial) as announce:
        results, replayed = _judge_all(plan, trial, announce, closing)
    results += [left_out_result(left_out) for left_out in plan.left_out]
    replayed += _skip_left_out(plan)
    finished = _result(plan, description, results, replayed)
    emit(RunFinished(finished))
    return finished


def _judge_all(
    plan: Plan, trial: Trial, announce: Callable[[Check], None], closing: Closing
) -> tuple[list[CheckResult], list[Mapping[str, Any]]]:
    """Return what comes of every check, and of every kept case."""
    results: list[CheckResult] = []
    replayed: list[Mapping[str, Any]] = []
    for number, check in enumerate(plan.checks):
        for coming in plan.checks[number : number + 2]:
            announce(coming)
        result = waive(_check(plan, check, trial), plan.waivers)
        for again in _replay(plan, check, result, trial):
            replayed.append(again)
            trial.emit(CaseReplayed(again))
        if check is plan.checks[-1]:
            result = waive(_add_end_fault(result, closing.close()), plan.waivers)
        results.append(result)
        trial.emit(CheckFinished(result))
    return results, replayed


@contextmanager
def _simulate_ahead(plan: Plan, trial: Trial) -> Iterator[Callable[[Check], None]]:
    """Yield what has the seeded cases of a check simulated in the background, if it may."""
    if not plan.ahead or trial.fault is not None:
        yield lambda check: None
        return
    ahead = trial.make = Ahead(trial.description)
    meets = trial.description.meets
    try:
        yield (
            lambda check: (
                ahead.announce(fit_check(check, meets).cases(plan.seed, plan.effort))
                if check.needs <= meets
                else None
            )
        )
    finally:
        ahead.close()


def _add_end_fault(result: CheckResult, fault: str) -> CheckResult:
    """Return the last ``result``, an error if the device was at fault when it was to stop."""
    if not fault or result.outcome is Outcome.NOT_APPLICABLE:
        return result
    reason = "; ".join(part for part in (result.reason, f"at its end the device {fault}") if part)
    return replace(result, outcome=Outcome.ERROR, reason=reason, class_reached=None)


def _check(plan: Plan, check: Check, trial: Trial) -> CheckResult:
    missing = check.needs - trial.description.meets
    if missing:
        return not_applicable_result(check, missing)
    if trial.given_up:
        return given_up_result(check, trial.given_up)
    check = fit_check(check, trial.description.meets)
    return trial.check(check, plan.seed, plan.effort, plan.searching)


def _replay(
    plan: Plan, check: Check, result: CheckResult, trial: Trial
) -> Iterator[Mapping[str, Any]]:
    """Yield what each kept case of ``check`` comes to, if the check was run at all."""
    for kept in plan.kept:
        if kept.case.check != check.id:
            continue
        if not result.cases:
            yield _skipped_case(kept, result.outcome, result.reason)
            continue
        if kept.refused:
            yield _skipped_case(kept, Outcome.SKIP, kept.refused)
            continue
        again = trial.replay(check, kept)
        is_waived = check.id in plan.waivers and again["outcome"] == Outcome.FAIL
        yield {**again, "outcome": Outcome.WAIVED.value} if is_waived else again


def _skip_left_out(plan: Plan) -> list[Mapping[str, Any]]:
    """Return the kept cases of checks that are not run; those of unknown checks are among them."""
    run = {check.id for check in plan.checks}
    reasons = {left_out.id: left_out.reason for left_out in plan.left_out}
    return [
        _skipped_case(kept, Outcome.SKIP, reasons.get(kept.case.check, "unknown check"))
        for kept in plan.kept
        if kept.case.check not in run
    ]


def _skipped_case(kept: KeptCase, outcome: Outcome, reason: str) -> Mapping[str, Any]:
    told = {"file": kept.file, "check": kept.case.check, "outcome": outcome.value}
    return {**told, "reason": reason, "value": None, "limit": None, "unit": None}


def _describe(device: Device) -> tuple[Description, str | None]:
    try:
        return describe(device), None
    except InputError:
        raise
    except DeviceError as fault:
        return UNDESCRIBED, str(fault)


def _result(
    plan: Plan,
    description: Description,
    results: list[CheckResult],
    replayed: list[Mapping[str, Any]],
) -> RunResult:
    order = [*IDS, *(r.id for r in results if r.id not in IDS)]
    return RunResult(
        device={"spec": plan.spec, **asdict(description)},
        device_class=plan.device_class,
        seed=plan.seed,
        effort=plan.effort.value,
        checks=tuple(sorted(results, key=lambda r: order.index(r.id))),
        replayed=tuple(replayed),
        timeout_s=plan.timeout_s,
        report=plan.report,
    )
