"""What is measured, what a check makes of it, and what the run makes of its checks."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from math import inf, isnan
from typing import Any

from floatref.values.arrays import FloatArray
from floatref_conformance.classes import DeviceClass, Limits, lowest


class Outcome(StrEnum):
    """What became of one check."""

    PASS = "pass"
    FAIL = "fail"
    SKIP = "skip"
    ERROR = "error"
    WAIVED = "waived"
    NOT_APPLICABLE = "not-applicable"


class Verdict(StrEnum):
    """What the run says of the device."""

    PASS = "PASS"
    FAIL = "FAIL"
    INCOMPLETE = "INCOMPLETE"

    @property
    def exit_code(self) -> int:
        """Exit code of a run with this verdict."""
        return {Verdict.PASS: 0, Verdict.FAIL: 1, Verdict.INCOMPLETE: 4}[self]


@dataclass(frozen=True, eq=False)
class Evidence:
    """The elevations in m, at ``interval_m``, whose IRI was taken as a measured value."""

    elevation: FloatArray
    interval_m: float


@dataclass(frozen=True, eq=False)
class Measurement:
    """One number of one wheel path against the largest value allowed in each class."""

    quantity: str
    track: str
    value: float
    unit: str
    limits: Limits
    evidence: Evidence | None = None

    def ratio(self, device_class: DeviceClass) -> float:
        """Return value over limit: above 1 is a failure; a value that is NaN is one too."""
        return inf if isnan(self.value) else self.value / self.limits[device_class]

    def within(self, device_class: DeviceClass) -> bool:
        """Return whether the value keeps the limit of ``device_class``."""
        return self.ratio(device_class) <= 1.0

    @property
    def class_reached(self) -> DeviceClass | None:
        """The strictest class whose limit, and those of all easier ones, the value keeps."""
        reached = None
        for device_class in DeviceClass:
            if not self.within(device_class):
                break
            reached = device_class
        return reached


@dataclass(frozen=True, eq=False)
class CaseResult:
    """What one case came to; ``fault`` says what the device did wrong, if it did.

    ``flagged_m`` is the largest length of a wheel path that the device flagged invalid, in m.
    """

    name: str
    parameters: Mapping[str, Any]
    measurements: tuple[Measurement, ...] = ()
    fault: str | None = None
    flagged_m: float = 0.0

    def ratio(self, device_class: DeviceClass) -> float:
        """Return the largest ratio of value to limit; infinite for a faulty device."""
        if self.fault is not None:
            return inf
        return max(m.ratio(device_class) for m in self.measurements)


@dataclass(frozen=True, eq=False)
class CheckResult:
    """What one check came to; ``reason`` says in one line why it did not pass.

    ``flagged_m`` is the largest of its cases'.
    """

    id: str
    clause: str
    outcome: Outcome
    reason: str = ""
    class_reached: DeviceClass | None = None
    cases: int = 0
    worst: Measurement | None = None
    counterexample: Mapping[str, Any] | None = None
    flagged_m: float = 0.0


@dataclass(frozen=True, eq=False)
class RunResult:
    """The verdict on a device, and the checks that it rests on."""

    device: Mapping[str, Any]
    device_class: DeviceClass
    seed: int
    effort: str
    checks: tuple[CheckResult, ...]
    replayed: tuple[Mapping[str, Any], ...] = field(default_factory=tuple)

    @property
    def verdict(self) -> Verdict:
        """FAIL if a check failed, INCOMPLETE if one was left out, else PASS."""
        return verdict_on([check.outcome for check in self.checks])

    @property
    def class_reached(self) -> DeviceClass | None:
        """The class that every check reached; None while a check is left out."""
        judged = [c for c in self.checks if c.outcome is not Outcome.NOT_APPLICABLE]
        return lowest([c.class_reached for c in judged])


def verdict_on(outcomes: Sequence[Outcome]) -> Verdict:
    """Return the verdict that ``outcomes`` make together; nothing judged is INCOMPLETE."""
    if Outcome.FAIL in outcomes or Outcome.ERROR in outcomes:
        return Verdict.FAIL
    if Outcome.SKIP in outcomes or Outcome.WAIVED in outcomes or Outcome.PASS not in outcomes:
        return Verdict.INCOMPLETE
    return Verdict.PASS
