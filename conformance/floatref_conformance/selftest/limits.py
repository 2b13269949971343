"""All limits of the suite's checks, graded."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from floatref_conformance.checks.distance import DistanceCheck
from floatref_conformance.checks.driving import DrivingCheck
from floatref_conformance.checks.faults import FaultsCheck
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.invariance import InvarianceCheck
from floatref_conformance.checks.repeatability import RepeatabilityCheck
from floatref_conformance.checks.stationary import StationaryCheck
from floatref_conformance.checks.waveband import WavebandCheck
from floatref_conformance.selftest import damage, drives, passes, places, stationary, waves
from floatref_conformance.selftest.grading import Limit, Situation, grade, ungraded
from floatref_conformance.selftest.truth_bench import Roads

GRADERS: Mapping[type, Callable[..., tuple[Situation, ...]]] = {
    StationaryCheck: stationary.situations,
    DrivingCheck: drives.situations,
    WavebandCheck: waves.situations,
    RepeatabilityCheck: passes.situations_of_repeatability,
    DistanceCheck: places.situations,
    InvarianceCheck: passes.situations_of_invariance,
    FaultsCheck: damage.situations,
}
"""How the cases of each kind of check are made whose quantities are graded."""


def situations(check: Check) -> tuple[Situation, ...]:
    """Return the graded cases of ``check``; none for one that did not come with the suite."""
    grader = GRADERS.get(type(check))
    return () if grader is None else grader(check)


def graded(checks: Iterable[Check]) -> Iterator[Limit]:
    """Yield every limit of ``checks`` with what became of it."""
    for check in checks:
        roads = Roads()
        for situation in situations(check):
            yield from grade(situation, roads)


def without_grader(checks: Iterable[Check], limits: Sequence[Limit]) -> tuple[str, ...]:
    """Return the published limits of ``checks`` that ``limits`` lack."""
    return tuple(missing for check in checks for missing in ungraded(check, limits))
