"""The checks of streams on one device, after the checks of recordings: a group of its own."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from floatref_conformance.checks.case import record_for
from floatref_conformance.checks.streams.stream_catalogue import (
    STREAM_CHECKS,
    drives,
    long_drive,
)
from floatref_conformance.checks.streams.stream_check import StreamCase, StreamCheck
from floatref_conformance.checks.verdict import CaseResult, CheckResult, Outcome
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Description, Device, visible
from floatref_conformance.devices.protocol import RUN_PER_LENGTH, RUN_S
from floatref_conformance.devices.streams.live_session import LiveCommand
from floatref_conformance.devices.streams.pieces import span
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceRefused, DeviceSkipped
from floatref_conformance.judge.bench import make_taken
from floatref_conformance.judge.events import CaseFinished, CheckFinished, CheckStarted, Emit
from floatref_conformance.judge.judging import check_result
from floatref_conformance.judge.stream_runs import StreamRuns
from floatref_conformance.judge.trial import MOST_HANGS

NOT_SELECTED = "not selected"
NOT_STREAMING = "the device does not declare streaming"


@dataclass(frozen=True)
class StreamPlan:
    """Which checks of streams are run on a device that streams.

    Attributes:
        checks: those that are run, in order.
        named: whether the user named them; a device that does not stream then gets a result, too.
        counts: whether checks of streams belong to the run; those that are not run are left out.
    """

    checks: tuple[StreamCheck, ...] = ()
    named: bool = False
    counts: bool = False

    @classmethod
    def of(cls, ids: Sequence[str]) -> "StreamPlan":
        """Return the plan for the checks that the user named; all without any name."""
        chosen = tuple(check for id_, check in STREAM_CHECKS.items() if not ids or id_ in ids)
        return cls(chosen, bool(ids and chosen), True)


def find_live_argv(device: Device) -> Sequence[str] | None:
    """Return the command line of a process of ``device`` for one stream; None without one.

    Raises DeviceError if the device declares what cannot be.
    """
    argv: Sequence[str] | None = getattr(device, "live_argv", None)
    return argv


def judge_streams(
    plan: StreamPlan, device: Device, trial: "StreamTrial", stop: Callable[[], str]
) -> tuple[CheckResult, ...]:
    """Return the results of ``plan`` in the order of the list; empty if it does not stream.

    ``stop`` ends what was started once, for recordings, which may need hardware of its own, and
    returns its fault. Checks of streams that are not in the plan are results, too.
    """
    if not plan.counts:
        return ()
    try:
        argv = find_live_argv(device)
    except DeviceError as fault:
        return tuple(_without_run(plan, Outcome.ERROR, str(fault)))
    if argv is None:
        named = plan if plan.named else StreamPlan()
        return tuple(_without_run(named, Outcome.NOT_APPLICABLE, NOT_STREAMING))
    end_fault = stop() if plan.checks else ""
    if end_fault:
        reason = f"when it was stopped, the device {end_fault}"
        return tuple(_without_run(plan, Outcome.ERROR, reason))
    results = {check.id: trial.judge(check, argv) for check in plan.checks}
    return tuple(
        results.get(id_) or CheckResult(id_, check.clause, Outcome.SKIP, NOT_SELECTED)
        for id_, check in STREAM_CHECKS.items()
    )


def _without_run(plan: StreamPlan, outcome: Outcome, reason: str) -> Iterator[CheckResult]:
    for check in plan.checks:
        yield CheckResult(check.id, check.clause, outcome, reason)


@dataclass
class StreamTrial:
    """The checks of streams on one device.

    Attributes:
        description: what it is, and which channels it may receive.
        device_class: the class whose limits decide; they are the same for every class.
        seed, effort: draw the drives, and say how many.
        emit: is called with every event.
        timeout_s: time in s for an answer; None for 60 s and twice the drive's length.
        variables: names of variables of the environment that the device gets.
    """

    description: Description
    device_class: DeviceClass
    seed: int
    effort: Effort
    emit: Emit
    timeout_s: float | None = None
    variables: tuple[str, ...] = ()
    hangs: int = 0
    _runs: dict[str, StreamRuns] = field(default_factory=dict)

    def judge(self, check: StreamCheck, argv: Sequence[str]) -> CheckResult:
        """Return the result of ``check`` for processes started by ``argv``."""
        cases = (long_drive(self.seed),) if check.is_long else drives(self.seed, self.effort)
        self.emit(CheckStarted(check.id, len(cases)))
        results = [self.judge_case(check, case, argv) for case in cases]
        skipped = [case.skipped for case in results if case.skipped is not None]
        result = (
            CheckResult(check.id, check.clause, Outcome.NOT_APPLICABLE, skipped[0])
            if skipped
            else check_result(check, results, self.device_class)
        )
        self.emit(CheckFinished(result))
        return result

    def judge_case(self, check: StreamCheck, case: StreamCase, argv: Sequence[str]) -> CaseResult:
        """Return the result of ``case``, with the device's faults."""
        result = CaseResult(case.name, case.scenario.to_dict())
        try:
            if self.hangs >= MOST_HANGS:
                raise DeviceError(f"not run: the device hung {self.hangs} times")
            result = replace(result, measurements=check.judge(self._runs_of(case, argv)))
        except DeviceSkipped as reason:
            result = replace(result, skipped=str(reason))
        except DeviceError as fault:
            hung, refused = isinstance(fault, DeviceHung), isinstance(fault, DeviceRefused)
            self.hangs += hung
            result = replace(result, fault=str(fault), hung=hung, false_alarms=int(refused))
        self.emit(CaseFinished(check.id, result))
        return result

    def _runs_of(self, case: StreamCase, argv: Sequence[str]) -> StreamRuns:
        """Return the runs of ``case``, which all its checks share."""
        if case.name not in self._runs:
            recorded = record_for(self.description.capabilities)
            taken = make_taken(replace(case.scenario, **recorded))
            recording = visible(taken.recording, self.description.channels)
            begin_s, end_s = span(recording)
            limit_s = self.timeout_s or RUN_S + RUN_PER_LENGTH * (end_s - begin_s)
            command = LiveCommand(tuple(argv), Path.cwd(), limit_s, self.variables)
            self._runs[case.name] = StreamRuns(case, recording, taken.truth, command, self.seed)
        return self._runs[case.name]
