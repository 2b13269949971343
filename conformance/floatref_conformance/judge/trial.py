"""One check on one device: seeded cases, a search, and the simplest case that fails."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from floatref.errors import InputError
from floatref_conformance.case_files import KeptCase
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check, Taken
from floatref_conformance.checks.verdict import CaseResult, CheckResult, Measurement, Outcome
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.editions.edition import Edition, find_edition
from floatref_conformance.judge.bench import DeviceBench, make_taken
from floatref_conformance.judge.events import (
    CaseFinished,
    CheckStarted,
    Event,
    SearchStarted,
    ShrinkStarted,
)
from floatref_conformance.judge.judging import check_result, describe_failure, find_failing
from floatref_conformance.judge.replaying import judge_case, refuse_foreign
from floatref_conformance.judge.search import search, simplify
from floatref_conformance.proving_ground.scenario import Scenario

StoredResults = Callable[[Check, Case], CaseResult]
"""Returns the result that a case had in an earlier run."""
MOST_HANGS = 3
"""Number of hangs after which a device gets no more cases, so that the run ends."""
SEARCHED = "-search-"
"""In the name of a case that a search has drawn, between check and number."""


def is_searched(id_: str, name: str) -> bool:
    """Return whether a search of the check ``id_`` has drawn the case called ``name``."""
    return name.startswith(f"{id_}{SEARCHED}")


@dataclass
class Trial:
    """The state of a device during the checks of a run.

    Attributes:
        device, description: what is judged.
        device_class: the class whose limits decide.
        emit: is called with every event.
        fault: why the device could not describe itself; it is then the fault of every case.
        hangs: how often the device has not answered in time.
        make: simulates a scenario.
        edition: says where a profile may end.
        stored: results in place of those of the device, which is then not asked.
    """

    device: Device
    description: Description
    device_class: DeviceClass
    emit: Callable[[Event], None]
    fault: str | None = None
    hangs: int = 0
    make: Callable[[Scenario], Taken] = make_taken
    edition: Edition = field(default_factory=find_edition)
    stored: StoredResults | None = None
    _judged: dict[Case, CaseResult] = field(default_factory=dict)

    @property
    def given_up(self) -> str:
        """Why the device gets no more cases; empty while it gets them."""
        return f"not run: the device hung {self.hangs} times" if self._is_hopeless() else ""

    def check(self, check: Check, seed: int, effort: Effort, searching: bool) -> CheckResult:
        """Return the result of ``check`` for the device."""
        self._judged = {}
        seeded = check.cases(seed, effort)
        self.emit(CheckStarted(check.id, len(seeded)))
        for case in seeded:
            self._try(check, case)
        if searching and not self._find_failing() and not self._has_skipped():
            self.emit(SearchStarted(check.id, effort.searched))
            search(check, seed, effort.searched, lambda case: self._judge_found(check, case))
        cases = dict(self._judged)
        simpler = self._simplify(check, effort.shrunk if searching else 0)
        return check_result(check, tuple(cases.values()), self.device_class, simpler)

    def replay(self, check: Check, kept: KeptCase) -> Mapping[str, Any]:
        """Return the result of a stored case, by the limits of this run.

        A case whose numbers make no drive in this edition is skipped.
        """
        try:
            refuse_foreign(check, kept.case)
            result = self._judge(check, kept.case)
        except InputError as error:
            result = CaseResult(kept.case.name, kept.case.parameters, skipped=str(error))
        reason = result.skipped or describe_failure(result, self.device_class)
        return {
            "file": kept.file,
            "check": check.id,
            "outcome": _outcome(result, reason).value,
            "reason": reason,
            **_figures(result.worst(self.device_class), self.device_class),
        }

    def _judge_found(self, check: Check, case: Case) -> float:
        named = replace(case, name=f"{check.id}{SEARCHED}{len(self._judged) + 1}")
        return self._try(check, named).ratio(self.device_class)

    def _try(self, check: Check, case: Case) -> CaseResult:
        """Return the result of ``case``, judged once; only the worst case stores its passes."""
        if case in self._judged:
            return self._judged[case]
        result, worst = self._judge(check, case), self._find_failing()
        ratio = result.ratio(self.device_class)
        if ratio > max(1.0, worst.ratio(self.device_class) if worst else 0.0):
            for other, judged in self._judged.items():
                self._judged[other] = replace(judged, passes=())
        else:
            result = replace(result, passes=())
        self._judged[case] = result
        return result

    def _judge(self, check: Check, case: Case) -> CaseResult:
        if self.fault is not None or self._is_hopeless():
            fault = self.fault or self.given_up
            result = CaseResult(case.name, case.parameters, fault=fault)
        else:
            result = (self.stored or self._ask)(check, case)
            self.hangs += result.hung
        self.emit(CaseFinished(check.id, result))
        return result

    def _ask(self, check: Check, case: Case) -> CaseResult:
        bench = DeviceBench(self.device, self.description, self.make, self.edition)
        return judge_case(check, case, bench)

    def _simplify(self, check: Check, budget: int) -> tuple[Case, CaseResult] | None:
        worst = self._find_failing()
        if worst is None:
            return None
        start = next(case for case, result in self._judged.items() if result is worst)
        if self.fault is not None or self._is_hopeless() or self.hangs:
            return start, worst
        self.emit(ShrinkStarted(check.id, budget))
        found = {start: worst}

        def fails(case: Case) -> bool:
            if self._is_hopeless():
                return False
            result = self._judge(check, replace(case, name=f"{start.name}, simplified"))
            failed = result.ratio(self.device_class) > 1.0
            if failed:
                found[case] = result
            return failed

        simpler = simplify(start, check.simplest, budget, fails)
        return simpler, self._run_again(check, simpler, found[simpler])

    def _run_again(self, check: Check, case: Case, failed: CaseResult) -> CaseResult:
        """Return ``failed`` with the outcome of a second run, if that does not fail."""
        if self._is_hopeless():
            return failed
        result = self._judge(check, replace(case, name=f"{case.name}, again"))
        if result.ratio(self.device_class) > 1.0:
            return failed
        return replace(failed, again="passed" if result.skipped is None else "skipped")

    def _find_failing(self) -> CaseResult | None:
        return (
            find_failing(tuple(self._judged.values()), self.device_class) if self._judged else None
        )

    def _has_skipped(self) -> bool:
        return any(result.skipped is not None for result in self._judged.values())

    def _is_hopeless(self) -> bool:
        return self.hangs >= MOST_HANGS


def _figures(worst: Measurement | None, device_class: DeviceClass) -> dict[str, Any]:
    if worst is None:
        return {"value": None, "limit": None, "unit": None}
    limit = worst.limits.get(device_class)
    return {"value": worst.value, "limit": limit, "unit": worst.unit}


def _outcome(result: CaseResult, reason: str) -> Outcome:
    if result.skipped is not None:
        return Outcome.SKIP
    if result.fault is not None:
        return Outcome.ERROR
    return Outcome.FAIL if reason else Outcome.PASS
