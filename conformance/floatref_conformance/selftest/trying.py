"""Run devices on checks, in several processes, to find out which devices fail."""

from collections.abc import Generator, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass
from functools import cache

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check, fit_check
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Device
from floatref_conformance.editions import EDITION
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.judge.bench import DeviceBench
from floatref_conformance.judge.exercise import close, describe
from floatref_conformance.judge.judging import describe_failure
from floatref_conformance.judge.replaying import judge_case
from floatref_conformance.judge.search import search
from floatref_conformance.plugins import load_registry
from floatref_conformance.registry import Registry
from floatref_conformance.worker_pool import LONGEST_S, worker_pool


@dataclass(frozen=True)
class Try:
    """A device by its SPEC, a check of an edition, a seed, and the class whose limits decide.

    Without a class it is the one that the device claims, nominal if it claims no class.
    """

    spec: str
    check: str
    seed: int
    device_class: DeviceClass | None = None
    edition: str = EDITION


@dataclass(frozen=True)
class TryResult:
    """The result of a try: in one line why the device fails; empty if it passes."""

    tried: Try
    fails: str


def try_all(tries: Sequence[Try], processes: int) -> Generator[TryResult, None, None]:
    """Yield the results of ``tries`` as they finish; an error of the suite is raised."""
    if processes < 2:
        yield from map(attempt, tries)
        return
    with worker_pool(processes) as pool:
        coming = [pool.submit(attempt, one) for one in tries]
        try:
            for done in as_completed(coming, LONGEST_S):
                yield done.result()
        except TimeoutError as error:
            left = sum(not one.done() for one in coming)
            raise SuiteError(f"{left} tries not done after {LONGEST_S / 3600:g} h") from error


def attempt(wanted: Try) -> TryResult:
    """Return the result of ``wanted`` at quick effort, including the search."""
    registry = _registry(wanted.edition)
    device = registry.device(wanted.spec)
    try:
        return TryResult(wanted, _describe_failure(registry.check(wanted.check), device, wanted))
    finally:
        close(device)


def _describe_failure(check: Check, device: Device, wanted: Try) -> str:
    """Return why ``device`` fails ``check``, from the first failing case."""
    found: list[str] = []
    try:
        description = describe(device)
    except DeviceError as fault:
        return str(fault)

    claimed: DeviceClass = getattr(device, "claims", DeviceClass.NOMINAL)
    decisive = wanted.device_class or claimed
    check, edition = fit_check(check, description.meets), find_edition(wanted.edition)

    def ratio(case: Case) -> float:
        if found:
            return 0.0
        result = judge_case(check, case, DeviceBench(device, description, edition=edition))
        if result.ratio(decisive) > 1.0:
            found.append(f"{case.name or 'searched'}: {describe_failure(result, decisive)}")
        return result.ratio(decisive)

    for case in check.cases(wanted.seed, Effort.QUICK):
        ratio(case)
    if not found:
        search(check, wanted.seed, Effort.QUICK.searched, ratio)
    return "".join(found)


@cache
def _registry(edition: str) -> Registry:
    return load_registry(edition)
