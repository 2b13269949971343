"""Collects what a submission keeps of a run: every result, and the profiles of what decides."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.checks.verdict import CaseResult, CheckResult, RunResult
from floatref_conformance.classes import DeviceClass
from floatref_conformance.judge.events import CaseFinished, Event, RunFinished, ShrinkStarted


@dataclass
class CaseCollector:
    """Takes the events of a run whose limits are those of ``device_class``.

    Attributes:
        results: of every case of recordings, by check, in the order in which they were judged.
        result: of the run; None before its end.
    """

    device_class: DeviceClass
    results: dict[str, list[CaseResult]] = field(default_factory=dict)
    result: RunResult | None = None
    _worst: dict[str, CaseResult] = field(default_factory=dict)
    _simplifying: set[str] = field(default_factory=set)

    def handle(self, event: Event) -> None:
        """Store what ``event`` says."""
        if isinstance(event, CaseFinished) and event.id not in STREAM_CHECKS:
            self.results.setdefault(event.id, []).append(replace(event.result, passes=()))
            self._keep_worst(event.id, event.result)
        if isinstance(event, ShrinkStarted):
            self._simplifying.add(event.id)
        if isinstance(event, RunFinished):
            self.result = event.result

    def decisive(self) -> Iterator[tuple[str, CaseResult]]:
        """Yield check and result, with profiles, of each case on which the report rests.

        These are the worst of each check, and the simplest that fails it. A case in which the
        device delivered nothing has no profiles, and is left out.
        """
        for check in self.result.checks if self.result else ():
            simplest = self._find_simplest(check)
            for result in (self._worst.get(check.id), simplest):
                if result is not None and result.passes and result.fault is None:
                    yield check.id, result

    def _keep_worst(self, id_: str, result: CaseResult) -> None:
        """Store ``result`` if it is the worst so far; the first of equals, as in a report.

        Cases that are tried to simplify a failing one do not count in a report.
        """
        if id_ in self._simplifying:
            return
        if id_ not in self._worst or self._rank(result) > self._rank(self._worst[id_]):
            self._worst[id_] = result

    def _rank(self, result: CaseResult) -> tuple[float, bool]:
        worst = result.worst(self.device_class)
        if result.fault is not None or worst is None:
            return -1.0, False
        return worst.rank(self.device_class)

    def _find_simplest(self, check: CheckResult) -> CaseResult | None:
        """Return the result of the counterexample of ``check``, with its profiles."""
        if check.counterexample is None:
            return None
        parameters = check.counterexample["parameters"]
        for result in self.results[check.id]:
            if result.parameters == parameters and result.ratio(self.device_class) > 1.0:
                return replace(result, passes=check.passes)
        return None
