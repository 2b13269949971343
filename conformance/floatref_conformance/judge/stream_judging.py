"""The checks of streams on one device, after the checks of recordings: a group of its own."""

from collections.abc import Mapping, Sequence
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
    """

    checks: tuple[StreamCheck, ...] = ()
    named: bool = False

    @classmethod
    def of(cls, ids: Sequence[str]) -> "StreamPlan":
        """Return the plan for the checks that the user named; all without any name."""
        chosen = tuple(check for id_, check in STREAM_CHECKS.items() if not ids or id_ in ids)
        return cls(chosen, bool(ids and chosen))


def find_live_argv(device: Device) -> Sequence[str] | None:
    """Return the command line of a process of ``device`` for one stream; None if it has none.

    Raises DeviceError if the device declares what cannot be.
    """
    argv: Sequence[str] | None = getattr(device, "live_argv", None)
    return argv


@dataclass
class StreamTrial:
    """The checks of streams on one device.

    Attributes:
        argv: the command line of its process.
        description: what it is, and which channels it may receive.
        device_class: the class whose limits decide; they are the same for every class.
        seed, effort: draw the drives, and say how many.
        timeout_s: time in s for an answer; None for 60 s and twice the drive's length.
        emit: is called with every event.
    """

    argv: Sequence[str]
    description: Description
    device_class: DeviceClass
    seed: int
    effort: Effort
    timeout_s: float | None
    emit: Emit
    hangs: int = 0
    _runs: dict[str, StreamRuns] = field(default_factory=dict)

    def judge(self, check: StreamCheck) -> CheckResult:
        """Return the result of ``check``."""
        cases = (long_drive(self.seed),) if check.is_long else drives(self.seed, self.effort)
        self.emit(CheckStarted(check.id, len(cases)))
        results = [self.judge_case(check, case) for case in cases]
        skipped = [case.skipped for case in results if case.skipped is not None]
        result = (
            CheckResult(check.id, check.clause, Outcome.NOT_APPLICABLE, skipped[0])
            if skipped
            else check_result_of(check, results, self.device_class)
        )
        self.emit(CheckFinished(result))
        return result

    def judge_case(self, check: StreamCheck, case: StreamCase) -> CaseResult:
        """Return the result of ``case``, with the device's faults."""
        result = CaseResult(case.name, case.scenario.to_dict())
        try:
            if self.hangs >= MOST_HANGS:
                raise DeviceError(f"not run: the device hung {self.hangs} times")
            result = replace(result, measurements=check.judge(self._runs_of(case)))
        except DeviceSkipped as reason:
            result = replace(result, skipped=str(reason))
        except DeviceError as fault:
            hung, refused = isinstance(fault, DeviceHung), isinstance(fault, DeviceRefused)
            self.hangs += hung
            result = replace(result, fault=str(fault), hung=hung, false_alarms=int(refused))
        self.emit(CaseFinished(check.id, result))
        return result

    def _runs_of(self, case: StreamCase) -> StreamRuns:
        """Return the runs of ``case``, which all its checks share."""
        if case.name not in self._runs:
            recorded = record_for(self.description.capabilities)
            taken = make_taken(replace(case.scenario, **recorded))
            recording = visible(taken.recording, self.description.channels)
            begin_s, end_s = span(recording)
            limit_s = self.timeout_s or RUN_S + RUN_PER_LENGTH * (end_s - begin_s)
            command = LiveCommand(tuple(self.argv), Path.cwd(), limit_s)
            self._runs[case.name] = StreamRuns(case, recording, taken.truth, command, self.seed)
        return self._runs[case.name]


def check_result_of(
    check: StreamCheck, cases: Sequence[CaseResult], device_class: DeviceClass
) -> CheckResult:
    """Return the outcome of ``check`` from its ``cases``."""
    return check_result(check, cases, device_class)


def left_out_streams(plan: StreamPlan) -> list[CheckResult]:
    """Return the results of the checks of streams that are not in ``plan``."""
    chosen = {check.id for check in plan.checks}
    return [
        CheckResult(id_, check.clause, Outcome.SKIP, NOT_SELECTED)
        for id_, check in STREAM_CHECKS.items()
        if id_ not in chosen
    ]


def not_streaming(plan: StreamPlan) -> list[CheckResult]:
    """Return the results for a device that does not stream: empty unless checks were named."""
    return [
        CheckResult(check.id, check.clause, Outcome.NOT_APPLICABLE, NOT_STREAMING)
        for check in (plan.checks if plan.named else ())
    ]


def in_order(results: Sequence[CheckResult]) -> tuple[CheckResult, ...]:
    """Return ``results`` in the order of the list of checks."""
    by_id: Mapping[str, CheckResult] = {result.id: result for result in results}
    return tuple(by_id[id_] for id_ in STREAM_CHECKS if id_ in by_id)
