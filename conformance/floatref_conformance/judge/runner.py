"""Run checks on a device: events during the run, a result at the end."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from floatref_conformance.case_files import KeptCase
from floatref_conformance.checks.catalogue import IDS, LeftOut
from floatref_conformance.checks.interface import Check, fit_check
from floatref_conformance.checks.verdict import CheckResult, Outcome, RunResult
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.editions.edition import Edition, find_edition
from floatref_conformance.errors import DeviceError, NoRoom, SuiteError
from floatref_conformance.judge.bench import Ahead
from floatref_conformance.judge.events import (
    CaseReplayed,
    CheckFinished,
    Emit,
    RunFinished,
    RunStarted,
)
from floatref_conformance.judge.exercise import Closing, describe
from floatref_conformance.judge.judging import (
    given_up_result,
    left_out_result,
    not_applicable_result,
)
from floatref_conformance.judge.stream_judging import StreamPlan, StreamTrial, judge_streams
from floatref_conformance.judge.trial import StoredResults, Trial
from floatref_conformance.judge.waivers import waive

UNDESCRIBED = Description("unknown", "unknown", "unknown", ())
"""The description of a device that gives no usable one."""


@dataclass(frozen=True)
class Plan:
    """A device, the checks to run on it, and the checks that are left out.

    Attributes:
        spec: the SPEC by which the user names the device.
        device: the one that is judged.
        checks: those that are run, in order.
        left_out: those that are not run, with the reason.
        device_class: the class whose limits decide.
        seed: draws roads, noise and the search.
        effort: sets the number of cases.
        kept: cases stored by earlier runs, to be run again.
        searching: whether cases are drawn that depend on the device's answers.
        waivers: reasons of known failures, by the id of the check.
        ahead: whether the next cases are simulated while the device works.
        edition: of the checks.
        timeout_s, report, variables: time for a recording in s, folder of the report, and names of
            variables that the device gets; the report names them, so that the run can be
            reproduced.
        streams: the checks of streams, for a device that streams.
        stored: results in place of those of the device, by check and case.
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
    edition: Edition = field(default_factory=find_edition)
    streams: StreamPlan = field(default_factory=StreamPlan)
    variables: tuple[str, ...] = ()
    stored: StoredResults | None = None


Judged = tuple[list[CheckResult], list[Mapping[str, Any]]]
"""The results of checks, and of stored cases."""
JudgeAll = Callable[[Plan, Description, Emit], Judged]


def run(plan: Plan, emit: Emit, judge_all: JudgeAll | None = None) -> RunResult:
    """Return the result of ``plan``; ``emit`` is called with every event.

    ``judge_all``, if given, judges the checks of the plan in another way.
    Raises NoRoom for a full disk and SuiteError, also for sys.exit in a check; there is then no
    verdict. The device is closed once in every case.
    """
    closing = Closing(plan.device)
    try:
        return _run(plan, emit, closing, judge_all)
    except (SuiteError, NoRoom, BrokenPipeError, KeyboardInterrupt):
        raise
    except (Exception, SystemExit) as error:
        text = " ".join(str(error).split())
        raise SuiteError(f"{type(error).__name__}: {text}") from error
    finally:
        closing.close()


def _run(plan: Plan, emit: Emit, closing: Closing, judge_all: JudgeAll | None) -> RunResult:
    description, fault = _describe(plan.device)
    emit(RunStarted(plan.spec, description, plan.checks, plan.left_out))
    trial = Trial(plan.device, description, plan.device_class, emit, fault, edition=plan.edition)
    trial.stored = plan.stored
    if judge_all is None:
        with _simulate_ahead(plan, trial) as announce:
            results, replayed = _judge_all(plan, trial, announce, closing)
    else:
        results, replayed = judge_all(plan, description, emit)
    results += [left_out_result(left_out) for left_out in plan.left_out]
    replayed += _skip_left_out(plan)
    streams = () if fault is not None else _judge_streams(plan, description, emit, closing)
    finished = replace(_result(plan, description, results, replayed), streams=streams)
    emit(RunFinished(finished))
    return finished


def _judge_streams(
    plan: Plan, description: Description, emit: Emit, closing: Closing
) -> tuple[CheckResult, ...]:
    """Return the results of the checks of streams; each run starts the device anew."""
    trial = StreamTrial(
        description,
        plan.device_class,
        plan.seed,
        plan.effort,
        emit,
        plan.timeout_s,
        plan.variables,
    )
    results = judge_streams(plan.streams, plan.device, trial, closing.close)
    return tuple(waive(result, plan.waivers) for result in results)


def _judge_all(
    plan: Plan, trial: Trial, announce: Callable[[Check], None], closing: Closing
) -> Judged:
    """Return the results of all checks, and of all stored cases."""
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
    """Yield a function that starts to simulate a check's seeded cases in the background."""
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
    """Return the last ``result``; it is an error if the device did not stop without a fault."""
    if not fault or result.outcome is Outcome.NOT_APPLICABLE:
        return result
    reason = "; ".join(
        part for part in (result.reason, f"when it was stopped, the device {fault}") if part
    )
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
    """Yield the result of each stored case of ``check``, if the check was run."""
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
    """Return the results of stored cases whose checks are not run or unknown."""
    run = {check.id for check in plan.checks}
    reasons = {left_out.id: left_out.reason for left_out in plan.left_out}
    return [
        _skipped_case(kept, Outcome.SKIP, reasons.get(kept.case.check, "unknown check"))
        for kept in plan.kept
        if kept.case.check not in run
    ]


def _skipped_case(kept: KeptCase, outcome: Outcome, reason: str) -> Mapping[str, Any]:
    case = {"file": kept.file, "check": kept.case.check, "outcome": outcome.value}
    return {**case, "reason": reason, "value": None, "limit": None, "unit": None}


def _describe(device: Device) -> tuple[Description, str | None]:
    try:
        return describe(device), None
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
        variables=plan.variables,
        edition=plan.edition.name,
    )
