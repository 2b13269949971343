"""The steps of the self-test, with progress, and the limits to grade."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
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
from floatref_conformance.editions.edition import Edition
from floatref_conformance.selftest import drives, faults, passes, places, stationary, waves
from floatref_conformance.selftest.counts import (
    Counts,
    Killers,
    list_claim_tries,
    list_named_tries,
    list_other_tries,
)
from floatref_conformance.selftest.grading import Limit, Roads, Situation, find_ungraded, grade
from floatref_conformance.selftest.stream_tries import list_stream_tries, try_streams
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
"""The functions that make the graded cases of each kind of check."""


def situations(check: Check) -> tuple[Situation, ...]:
    """Return the graded cases of ``check``; empty for a check of a plug-in."""
    grader = GRADERS.get(type(check))
    return () if grader is None else grader(check)


def grade_all(checks: Iterable[Check]) -> Iterator[Limit]:
    """Yield the result of every limit of ``checks``."""
    for check in checks:
        roads = Roads()
        for situation in situations(check):
            yield from grade(situation, roads)


def list_ungraded(checks: Iterable[Check], limits: Sequence[Limit]) -> tuple[str, ...]:
    """Return the published limits of ``checks`` that are missing in ``limits``."""
    return tuple(missing for check in checks for missing in find_ungraded(check, limits))


Item = TypeVar("Item")


class Track(Protocol):
    """Returns its items one after another, and shows the progress."""

    def __call__(self, items: Iterable[Item], count: int | None, title: str) -> Iterable[Item]:
        """Return ``items``; ``count`` is their number, ``title`` their name."""


@dataclass(frozen=True)
class Extent:
    """The extent of the self-test.

    Attributes:
        seeds: number of seeds, from 0 on, for every mutant.
        false_alarms: number of seeds for every built-in device that claims a class.
        limits: whether limits are graded.
        unique: whether the only killers are determined.
        processes: number of devices that are run in parallel.
    """

    seeds: int
    false_alarms: int
    limits: bool
    unique: bool
    processes: int


@dataclass(frozen=True)
class Work:
    """The self-test of ``checks`` of ``edition``, and of the checks ``streams`` by their ids.

    ``track`` shows the progress.
    """

    checks: tuple[Check, ...]
    edition: Edition
    killers: Killers
    extent: Extent
    track: Track
    streams: tuple[str, ...] = ()

    def count(self) -> Counts:
        """Return all counts; an error of the suite is raised."""
        extent, ids = self.extent, tuple(check.id for check in self.checks)
        seeds, more = range(extent.seeds), range(extent.false_alarms)
        limits = self._limits()
        return Counts(
            self.killers,
            ids,
            self._try("mutants", list_named_tries(self.killers, ids, seeds, self.edition)),
            self._try("only killers", self._others(ids)),
            self._try("false alarms", list_claim_tries(ids, more, self.edition)),
            limits,
            list_ungraded(self.checks, limits) if extent.limits else (),
            try_streams(
                list_stream_tries(self.streams, extent.seeds, extent.false_alarms, extent.unique),
                extent.processes,
            ),
        )

    def _limits(self) -> tuple[Limit, ...]:
        if not self.extent.limits:
            return ()
        return tuple(self.track(grade_all(self.checks), None, "limits"))

    def _others(self, ids: tuple[str, ...]) -> tuple[Try, ...]:
        if not self.extent.unique:
            return ()
        return list_other_tries(self.killers, ids, range(self.extent.seeds), self.edition)

    def _try(self, title: str, tries: tuple[Try, ...]) -> tuple[TryResult, ...]:
        with closing(try_all(tries, self.extent.processes)) as results:
            return tuple(self.track(results, len(tries), title))
