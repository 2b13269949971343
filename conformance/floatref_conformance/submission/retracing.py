"""A report made again from the results of its cases, without a device and without a simulation.

The run is repeated with the stored results in place of the device: the edition and the seed draw
the cases, the search goes where the results lead it, and the failing case is made simpler. Every
case that is drawn has to be the next one in the archive, and the report that comes of it the
archive's, figure by figure.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.catalogue import LeftOut
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.verdict import CaseResult
from floatref_conformance.devices.interface import Description
from floatref_conformance.editions.edition import Edition, find_edition
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.judge.events import CaseFinished, Event
from floatref_conformance.judge.runner import UNDESCRIBED, Plan, run
from floatref_conformance.judge.trial import is_searched
from floatref_conformance.registry import Registry
from floatref_conformance.render.report import as_json
from floatref_conformance.submission.document import Submission, write_json
from floatref_conformance.submission.rescoring import score_again

MISSING = "missing"
"""Of a key that only one of two reports has; no report has such a value."""
Results = Mapping[str, Sequence[CaseResult]]


class Departed(Exception):
    """The repetition draws a case that is not the next one in the archive; says which.

    Attributes:
        searched: whether a search drew the case, whose draws are those of a library; of all others
            edition and seed decide alone.
    """

    def __init__(self, what: str, searched: bool) -> None:
        """Say what departs."""
        super().__init__(what)
        self.searched = searched


@dataclass(frozen=True)
class SilentDevice:
    """A device that only describes itself, or fails to, as the one of the archive did."""

    submission: Submission

    def describe(self) -> Mapping[str, Any]:
        """Return the description in the archive; DeviceError with its fault in its place."""
        if self.submission.fault:
            raise DeviceError(self.submission.fault)
        return self.submission.description

    def run(self, recording: Path, profile: Path) -> None:
        """Refuse: results are stored."""
        raise DeviceError("was asked, though its results are stored")

    def close(self) -> None:
        """End as the device did; DeviceError with its fault."""
        if self.submission.end_fault:
            raise DeviceError(self.submission.end_fault)


@dataclass
class Tape:
    """Gives out stored results in their order, and departs where another case is drawn."""

    results: Results
    description: Description
    edition: Edition
    reached: dict[str, int] = field(default_factory=dict)

    def __call__(self, check: Check, case: Case) -> CaseResult:
        """Return the stored result of ``case``.

        Raises Departed if it is not the next one, and InputError for numbers that make no drive,
        which have no result.
        """
        stored = self._next(check.id)
        if stored is not None and _is_of(stored, case):
            return stored
        if case.name.endswith(", simplified"):
            # Numbers that make no drive raise InputError here, as they did in the run.
            score_again(check, case, (), self.description, self.edition)
        raise Departed(_describe(case, stored), is_searched(check.id, case.name))

    def handle(self, event: Event) -> None:
        """Go on by a case; Departed if it is not the next one."""
        if isinstance(event, CaseFinished):
            stored = self._next(event.id)
            if stored is None or stored.name != event.result.name:
                drawn = Case.of(event.id, {}, event.result.name)
                raise Departed(_describe(drawn, stored), is_searched(event.id, drawn.name))
            self.reached[event.id] = self.reached.get(event.id, 0) + 1

    def check_end(self) -> None:
        """Raise Departed if there are results that the repetition did not draw."""
        for id_, results in self.results.items():
            left = results[self.reached.get(id_, 0) :]
            if left:
                what = f"{id_}: {len(left)} results of cases that are not drawn here"
                raise Departed(what, all(is_searched(id_, result.name) for result in left))

    def _next(self, id_: str) -> CaseResult | None:
        results, reached = self.results.get(id_, ()), self.reached.get(id_, 0)
        return results[reached] if reached < len(results) else None


def make_report(submission: Submission, results: Results, registry: Registry) -> dict[str, Any]:
    """Return the report that follows from ``results``, without checks of streams.

    Raises Departed where these are not the results of the cases that are drawn, and InputError
    for a check that is not there.
    """
    checks, left_out = _select(submission, registry)
    device = SilentDevice(submission)
    edition = find_edition(submission.edition)
    known = UNDESCRIBED if submission.fault else submission.describe()
    tape = Tape(results, known, edition)
    plan = Plan(
        submission.device["spec"],
        device,
        checks,
        left_out,
        submission.device_class,
        submission.seed,
        submission.effort,
        searching=submission.searching,
        waivers=submission.waivers,
        edition=edition,
        stored=tape,
    )
    try:
        result = run(plan, tape.handle)
    except SuiteError as error:
        if isinstance(error.__cause__, Departed):
            raise error.__cause__ from None
        raise
    tape.check_end()
    made: dict[str, Any] = json.loads(write_json(as_json(result)))
    return made


def _select(
    submission: Submission, registry: Registry
) -> tuple[tuple[Check, ...], tuple[LeftOut, ...]]:
    if not submission.checks:
        rest = tuple(LeftOut(c.id, "not selected", c.clause) for c in registry.checks.values())
        return (), rest
    return registry.select(submission.checks)


def compare_reports(stored: Any, again: Any, where: str = "") -> Iterator[tuple[str, str]]:
    """Yield place and description of what differs between a report and its repetition."""
    if isinstance(stored, dict) and isinstance(again, dict):
        for key in sorted(stored.keys() | again.keys()):
            place = f"{where}.{key}".strip(".")
            yield from compare_reports(stored.get(key, MISSING), again.get(key, MISSING), place)
    elif isinstance(stored, list) and isinstance(again, list) and len(stored) == len(again):
        for number, pair in enumerate(zip(stored, again, strict=True)):
            name = pair[1].get("id", number) if isinstance(pair[1], dict) else number
            yield from compare_reports(*pair, f"{where}[{name}]")
    elif stored != again or isinstance(stored, bool) != isinstance(again, bool):
        yield where, f"is {_show(stored)}, repeated it is {_show(again)}"


def _is_of(result: CaseResult, case: Case) -> bool:
    drawn = json.loads(json.dumps(dict(case.parameters)))
    return bool(result.name == case.name and result.parameters == drawn)


def _describe(case: Case, stored: CaseResult | None) -> str:
    here = "no more results" if stored is None else f"{stored.name} with other numbers"
    if stored is not None and stored.name != case.name:
        here = f"the result of {stored.name}"
    return (
        f"edition and seed draw {case.name} here, and the archive has {here}: a case was changed, "
        "removed or exchanged, or edition, seed or effort are others"
    )


def _show(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
