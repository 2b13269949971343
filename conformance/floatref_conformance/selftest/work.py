"""The work of the self-test, step by step, with its progress, and all limits to be graded."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

from floatref_conformance.checks.distance.feature_places import DistanceCheck
from floatref_conformance.checks.distance.waveband import WavebandCheck
from floatref_conformance.checks.driving.check import DrivingCheck
from floatref_conformance.checks.faults.check import FaultsCheck
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.sameness.invariance import InvarianceCheck
from floatref_conformance.checks.sameness.repeatability import RepeatabilityCheck
from floatref_conformance.checks.stationary.parked_checks import StationaryCheck
from floatref_conformance.selftest import drives, faults, passes, places, stationary, waves
from floatref_conformance.selftest.counts import (
    Counts,
    Killers,
    list_claim_tries,
    list_named_tries,
    list_other_tries,
)
from floatref_conformance.selftest.grading import Limit, Roads, Situation, find_ungraded, grade
from floatref_conformance.selftest.trying import Try, TryResult, try_all

GRADERS: Mapping[type, Callable[..., tuple[Situation, ...]]] = {
    StationaryCheck: stationary.situations,
    DrivingCheck: drives.situations,
    WavebandCheck: waves.situations,
    RepeatabilityCheck: passes.situations_of_repeatability,
    DistanceCheck: places.situations,
    InvarianceCheck: passes.situations_of_invariance,
    FaultsCheck: faults.situations,
}
"""How the cases of each kind of check are made whose quantities are graded."""


def situations(check: Check) -> tuple[Situation, ...]:
    """Return the graded cases of ``check``; none for one that did not come with the suite."""
    grader = GRADERS.get(type(check))
    return () if grader is None else grader(check)


def grade_all(checks: Iterable[Check]) -> Iterator[Limit]:
    """Yield every limit of ``checks`` with what became of it."""
    for check in checks:
        roads = Roads()
        for situation in situations(check):
            yield from grade(situation, roads)


def list_ungraded(checks: Iterable[Check], limits: Sequence[Limit]) -> tuple[str, ...]:
    """Return the published limits of ``checks`` that ``limits`` lack."""
    return tuple(missing for check in checks for missing in find_ungraded(check, limits))


Item = TypeVar("Item")


class Track(Protocol):
    """Returns what it is given, one after another, and tells that it is done."""

    def __call__(self, items: Iterable[Item], count: int | None, title: str) -> Iterable[Item]:
        """Return ``items``, ``count`` of them, which ``title`` names."""


@dataclass(frozen=True)
class Extent:
    """How much is tested.

    Attributes:
        seeds: with so many seeds, from 0 on, every mutant is tried.
        false_alarms: with so many, every built-in device that claims a class.
        limits: whether limits are graded.
        unique: whether the only killers are looked for.
        processes: how many devices are tried at a time.
    """

    seeds: int
    false_alarms: int
    limits: bool
    unique: bool
    processes: int


@dataclass(frozen=True)
class Work:
    """The self-test of ``checks``, whose progress ``track`` tells."""

    checks: tuple[Check, ...]
    killers: Killers
    extent: Extent
    track: Track

    def count(self) -> Counts:
        """Return what all of it comes to; an error of the suite is raised."""
        extent, ids = self.extent, tuple(check.id for check in self.checks)
        seeds, more = range(extent.seeds), range(extent.false_alarms)
        limits = self._limits()
        return Counts(
            self.killers,
            ids,
            self._try("mutants", list_named_tries(self.killers, ids, seeds)),
            self._try("only killers", self._others(ids)),
            self._try("false alarms", list_claim_tries(ids, more)),
            limits,
            list_ungraded(self.checks, limits) if extent.limits else (),
        )

    def _limits(self) -> tuple[Limit, ...]:
        if not self.extent.limits:
            return ()
        return tuple(self.track(grade_all(self.checks), None, "limits"))

    def _others(self, ids: tuple[str, ...]) -> tuple[Try, ...]:
        if not self.extent.unique:
            return ()
        return list_other_tries(self.killers, ids, range(self.extent.seeds))

    def _try(self, title: str, tries: tuple[Try, ...]) -> tuple[TryResult, ...]:
        return tuple(self.track(try_all(tries, self.extent.processes), len(tries), title))
