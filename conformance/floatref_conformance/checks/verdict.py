"""Measurements, results of cases and checks, and the verdict of a run."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from math import inf, isnan
from pathlib import Path
from typing import Any

from floatref.values.profile import Profile
from floatref_conformance.checks.evidence import Evidence
from floatref_conformance.checks.likeness import Resemblance
from floatref_conformance.checks.nees import NeesEnds, PathNees
from floatref_conformance.classes import DeviceClass, Limits, lowest
from floatref_conformance.editions import EDITION
from floatref_conformance.proving_ground.scenario import Scenario


class Outcome(StrEnum):
    """The outcome of one check."""

    PASS = "pass"
    FAIL = "fail"
    SKIP = "skip"
    ERROR = "error"
    WAIVED = "waived"
    NOT_APPLICABLE = "not-applicable"


class Verdict(StrEnum):
    """The verdict of a run on the device."""

    PASS = "PASS"
    FAIL = "FAIL"
    INCOMPLETE = "INCOMPLETE"

    @property
    def exit_code(self) -> int:
        """Exit code of a run with this verdict."""
        return {Verdict.PASS: 0, Verdict.FAIL: 1, Verdict.INCOMPLETE: 4}[self]


@dataclass(frozen=True, eq=False)
class Measurement:
    """One number of one wheel path against the largest value allowed in each class.

    A class that is missing in ``limits`` does not limit this quantity. ``is_flagged_length`` is
    true for a length that the device flagged invalid, which is no error of its profile.
    """

    quantity: str
    track: str
    value: float
    unit: str
    limits: Limits
    evidence: Evidence | None = None
    is_flagged_length: bool = False

    def ratio(self, device_class: DeviceClass) -> float:
        """Return value over limit: above 1 is a failure; NaN is a failure too.

        0 where ``device_class`` has no limit.
        """
        if device_class not in self.limits:
            return 0.0
        return inf if isnan(self.value) else self.value / self.limits[device_class]

    def rank(self, device_class: DeviceClass) -> tuple[float, bool]:
        """Return the sort key, the worst last: the ratio, then whether the class has a limit."""
        return self.ratio(device_class), device_class in self.limits

    def rank_in_table(self, device_class: DeviceClass) -> tuple[bool, bool, float]:
        """Return the sort key of the judge's table, the row's quantity last.

        A flagged length within its limit ranks below every error that has a limit.
        """
        counts = not (self.is_flagged_length and self.within(device_class))
        return device_class in self.limits, counts, self.ratio(device_class)

    def within(self, device_class: DeviceClass) -> bool:
        """Return whether the value is within the limit of ``device_class``."""
        return self.ratio(device_class) <= 1.0

    @property
    def class_reached(self) -> DeviceClass | None:
        """The strictest class for which the value is within its limit and all easier ones."""
        reached = None
        for device_class in DeviceClass:
            if not self.within(device_class):
                break
            reached = device_class
        return reached


@dataclass(frozen=True, eq=False)
class Pass:
    """One recording that the device processed: the true profile and the delivered one.

    ``truth`` is the unfiltered elevation along the laser's path.
    """

    label: str
    truth: Profile
    result: Profile
    scenario: Scenario


@dataclass(frozen=True, eq=False)
class CaseResult:
    """The result of one case.

    Attributes:
        name: within its check.
        parameters: the numbers that define the case.
        measurements: of every wheel path.
        fault: the fault of the device, if there was one.
        hung: whether it did not answer in time.
        skipped: why the device skipped the case, if it did.
        flagged_m: largest length of a wheel path that the device flagged invalid, in m.
        early_m: largest length by which a profile ended before its recording, in m.
        passes: what it processed, stored for the pictures of a failing case.
        again: outcome of a second run of a failing case, if that run did not fail.
        false_alarms: number of healthy recordings that the device refused.
        nees: of every wheel path whose profile has a 1-sigma.
    """

    name: str
    parameters: Mapping[str, Any]
    measurements: tuple[Measurement, ...] = ()
    fault: str | None = None
    hung: bool = False
    skipped: str | None = None
    flagged_m: float = 0.0
    early_m: float = 0.0
    passes: tuple[Pass, ...] = ()
    again: str = ""
    false_alarms: int = 0
    nees: tuple[PathNees, ...] = ()

    def ratio(self, device_class: DeviceClass) -> float:
        """Return the largest ratio of value to limit; infinite for a faulty device."""
        if self.fault is not None:
            return inf
        return max((m.ratio(device_class) for m in self.measurements), default=0.0)

    def worst(self, device_class: DeviceClass) -> Measurement | None:
        """Return the measurement nearest to its limit, or farthest beyond; None without any.

        One without a limit of ``device_class`` is returned only if no other has one.
        """
        return max(self.measurements, key=lambda m: m.rank(device_class), default=None)


@dataclass(frozen=True, eq=False)
class CheckResult:
    """The result of one check.

    Attributes:
        id, clause: of the check.
        outcome: whether it passed, failed or was not judged.
        reason: in one line why it did not pass.
        class_reached: the strictest class whose limits every case is within.
        cases: number of judged cases, seeded and drawn by the search.
        worst: the measurement nearest to its limit, or farthest beyond.
        worst_case: name of its case.
        shown: the measurement of the judge's table, by `Measurement.rank_in_table`.
        shown_case: name of its case.
        counterexample: the simplest case found that fails: ``case``, ``parameters``,
            ``reason``, and ``file``, its name in a report directory.
        flagged_m, early_m: the largest values of its cases.
        false_alarms: number of healthy recordings that the device refused in its cases.
        passes: of the counterexample.
        worst_track: the wheel path that fails it, empty without measurements.
        scored_m: start and end of each stretch that it scores, in m.
        nees: of all wheel paths of its cases; None without a 1-sigma.
    """

    id: str
    clause: str
    outcome: Outcome
    reason: str = ""
    class_reached: DeviceClass | None = None
    cases: int = 0
    worst: Measurement | None = None
    worst_case: str = ""
    counterexample: Mapping[str, Any] | None = None
    flagged_m: float = 0.0
    early_m: float = 0.0
    passes: tuple[Pass, ...] = ()
    scored_m: tuple[tuple[float, float], ...] = ()
    worst_track: str = ""
    false_alarms: int = 0
    nees: NeesEnds | None = None
    shown: Measurement | None = None
    shown_case: str = ""


@dataclass(frozen=True, eq=False)
class RunResult:
    """The verdict on a device, and the results of the checks.

    ``replayed`` has for every case stored by an earlier run: ``file``, ``check``,
    ``outcome``, ``reason``, and ``value``, ``limit`` and ``unit`` of its worst measurement.
    ``timeout_s``, the time for a recording, and ``report``, the folder of the report, are as the
    user gave them; None if not given. ``edition`` is the name of the checks' edition, and
    ``variables`` are those of the environment that the device got on request. ``streams`` has the
    checks of streams, empty for a device that does not stream. ``resemblance`` has the flaws that a
    failing device resembles; None where nobody asked.
    """

    device: Mapping[str, Any]
    device_class: DeviceClass
    seed: int
    effort: str
    checks: tuple[CheckResult, ...]
    replayed: tuple[Mapping[str, Any], ...] = ()
    timeout_s: float | None = None
    report: Path | None = None
    edition: str = EDITION
    streams: tuple[CheckResult, ...] = ()
    variables: tuple[str, ...] = ()
    resemblance: Resemblance | None = None

    @property
    def verdict(self) -> Verdict:
        """FAIL if a check or a kept case failed, INCOMPLETE if one was left out, else PASS."""
        outcomes = [check.outcome for check in (*self.checks, *self.streams)]
        return verdict_on([*outcomes, *(Outcome(case["outcome"]) for case in self.replayed)])

    @property
    def false_alarms(self) -> int:
        """Number of healthy recordings that the device refused."""
        return sum(check.false_alarms for check in (*self.checks, *self.streams))

    @property
    def streams_shown(self) -> tuple[CheckResult, ...]:
        """The checks of streams that a report shows.

        Where the user selected checks of recordings alone, those of streams need no mention.
        """
        left_out = any(check.outcome is Outcome.SKIP for check in self.checks)
        ran = any(check.outcome is not Outcome.SKIP for check in self.streams)
        return self.streams if ran or not left_out else ()

    @property
    def class_reached(self) -> DeviceClass | None:
        """The class that every check reached; None while a check is left out."""
        judged = [c for c in self.checks if c.outcome is not Outcome.NOT_APPLICABLE]
        return lowest([c.class_reached for c in judged])


def verdict_on(outcomes: Sequence[Outcome]) -> Verdict:
    """Return the common verdict of ``outcomes``; INCOMPLETE if no check was judged."""
    if Outcome.FAIL in outcomes or Outcome.ERROR in outcomes:
        return Verdict.FAIL
    if Outcome.SKIP in outcomes or Outcome.WAIVED in outcomes or Outcome.PASS not in outcomes:
        return Verdict.INCOMPLETE
    return Verdict.PASS
