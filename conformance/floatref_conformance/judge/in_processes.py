"""The checks of a run in several processes, with the result that one process has.

Each check is judged in a process of its own, by a copy of the device. So the device must give the
same answer in whatever order it is asked, and may run several times at once.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from functools import partial
from multiprocessing.reduction import ForkingPickler
from types import MappingProxyType
from typing import Any

from floatref.errors import InputError
from floatref_conformance.case_files import KeptCase
from floatref_conformance.checks.interface import Check, fit_check
from floatref_conformance.checks.verdict import CheckResult, RunResult
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.events import (
    CaseReplayed,
    CheckFinished,
    CheckStarted,
    Emit,
    Event,
)
from floatref_conformance.judge.runner import Judged, Plan, run
from floatref_conformance.plugins import load_registry
from floatref_conformance.worker_pool import wait_for, worker_pool

OneCheck = tuple[CheckResult, tuple[Mapping[str, Any], ...]]
"""The result of a check, and of its stored cases."""


View = MappingProxyType[Any, Any]


def _make_view(content: dict[Any, Any]) -> View:
    return MappingProxyType(content)


def _reduce_view(view: View) -> tuple[Callable[[dict[Any, Any]], View], tuple[dict[Any, Any]]]:
    """Return how another process makes ``view`` again."""
    return _make_view, (dict(view),)


# Values of profiles and cases are views, which pickle does not know.
ForkingPickler.register(MappingProxyType, _reduce_view)


@dataclass(frozen=True, eq=False)
class Part:
    """One check of a plan as another process is given it: edition and check by their names.

    The other attributes are those of `Plan`; checks, and the data of an edition, cannot be pickled.
    """

    check: str
    edition: str
    spec: str
    device: Device
    device_class: DeviceClass
    seed: int
    effort: Effort
    kept: tuple[KeptCase, ...]
    searching: bool
    waivers: Mapping[str, str]

    @classmethod
    def of(cls, plan: Plan, check: str) -> "Part":
        """Return the part of ``plan`` that is about ``check``, with its stored cases."""
        return cls(
            check,
            plan.edition.name,
            plan.spec,
            plan.device,
            plan.device_class,
            plan.seed,
            plan.effort,
            tuple(kept for kept in plan.kept if kept.case.check == check),
            plan.searching,
            plan.waivers,
        )

    @property
    def plan(self) -> Plan:
        """The plan of this check alone."""
        return Plan(
            self.spec,
            self.device,
            (load_registry(self.edition).check(self.check),),
            (),
            self.device_class,
            self.seed,
            self.effort,
            self.kept,
            self.searching,
            self.waivers,
            ahead=True,
            edition=find_edition(self.edition),
        )


def refuse_processes(plan: Plan, processes: int) -> None:
    """Raise InputError if several ``processes`` cannot run ``plan``.

    Its device has to be ``concurrent``: as for ``searchable``, an attribute says so, and without
    it a device is not.
    """
    if processes == 1:
        return
    if not getattr(plan.device, "concurrent", False):
        raise InputError(
            f"--jobs {processes}: device {plan.spec} may not run several times at once; "
            "leave --jobs out"
        )


def run_in_processes(plan: Plan, emit: Emit, processes: int) -> RunResult:
    """Return the result of ``plan``, judged by ``processes``, as `runner.run` returns it.

    The events of a check are those of its start and its end, in the order of the plan.
    """
    return run(plan, emit, partial(_judge_all, processes) if processes > 1 else None)


def _judge_all(processes: int, plan: Plan, description: Description, emit: Emit) -> Judged:
    """Return the results of all checks, and of all stored cases."""
    results: list[CheckResult] = []
    replayed: list[Mapping[str, Any]] = []
    with worker_pool(processes) as pool:
        coming = [
            (check, pool.submit(judge_alone, Part.of(plan, check.id))) for check in plan.checks
        ]
        for check, future in coming:
            result, again = _wait(plan, check, future, description, emit)
            results.append(result)
            replayed += again
    return results, replayed


def _wait(
    plan: Plan, check: Check, future: Future[OneCheck], description: Description, emit: Emit
) -> OneCheck:
    """Return what ``future`` returns, between the events of the check's start and end."""
    if check.needs <= description.meets:
        fitted = fit_check(check, description.meets)
        emit(CheckStarted(check.id, len(fitted.cases(plan.seed, plan.effort))))
    result, replayed = wait_for(future, f"check {check.id}")
    for again in replayed:
        emit(CaseReplayed(again))
    emit(CheckFinished(result))
    return result, replayed


def judge_alone(part: Part) -> OneCheck:
    """Return the result of the check of ``part``, and of its stored cases."""
    result = run(part.plan, _ignore)
    (check,) = result.checks
    return check, result.replayed


def _ignore(event: Event) -> None:
    """Ignore ``event``."""
