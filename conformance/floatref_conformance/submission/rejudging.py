"""What decides is judged again, from the profiles in the archive."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from floatref.errors import InputError
from floatref_conformance.case_files import FOLDER as CASES
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.verdict import CaseResult
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.judging import describe_failure
from floatref_conformance.registry import Registry
from floatref_conformance.render.report import NAME as REPORT
from floatref_conformance.submission.agreement import SCORED, compare_results
from floatref_conformance.submission.checksums import SUMS
from floatref_conformance.submission.document import NAME, Submission
from floatref_conformance.submission.findings import Verification
from floatref_conformance.submission.origins import (
    DRAWER,
    describe_environment,
    describe_suite,
)
from floatref_conformance.submission.packing import RESULTS, write_cases
from floatref_conformance.submission.rescoring import (
    StoredCase,
    compare_truth,
    count_other_inputs,
    list_stored,
    score_again,
)
from floatref_conformance.submission.signatures import SIGNATURES
from floatref_conformance.submission.stored_answers import FOLDER as ANSWERS
from floatref_conformance.submission.stored_answers import read_passes


@dataclass(frozen=True)
class Repetition:
    """An archive, read, and what of it is repeated."""

    members: Mapping[str, bytes]
    submission: Submission
    results: Mapping[str, Sequence[CaseResult]]
    registry: Registry
    verification: Verification

    @cached_property
    def decisive(self) -> set[tuple[str, str]]:
        """Check and digest of every case whose profiles are stored."""
        return {(s.case.check, s.case.digest) for s in list_stored(self.members)}

    def find(self, case: Case) -> CaseResult:
        """Return the stored result of ``case``; InputError if it is missing."""
        for result in self.results.get(case.check, ()):
            if result.name == case.name and result.parameters == dict(case.parameters):
                return result
        raise InputError(f"{case.check}, {case.name}: no result of this case in the archive")


def check_members(repetition: Repetition, report: Mapping[str, Any]) -> None:
    """Name members that no submission has, and cases that are not those of ``report``."""
    submission, members = repetition.submission, repetition.members
    spec = str(submission.device["spec"])
    cases = write_cases(report["checks"], submission.device_class, spec, submission.edition)
    for name in sorted(cases.keys() | {n for n in members if n.startswith(f"{CASES}/")}):
        if members.get(name) != cases.get(name):
            repetition.verification.contradict(name, "is not the simplest case of the report")
    known = {SUMS, NAME, REPORT, *SIGNATURES, *cases}
    known |= {f"{RESULTS}/{id_}.json" for id_ in repetition.results}
    for name in sorted(members.keys() - known):
        if not name.startswith((f"{ANSWERS}/", f"{CASES}/")):
            repetition.verification.contradict(name, "is no part of a submission")


def score_stored(repetition: Repetition, report: Mapping[str, Any]) -> None:
    """Score the profiles in the archive against roads that are simulated here.

    Every case that decides a figure of ``report`` has to have its profiles there.
    """
    stored = list(list_stored(repetition.members))
    _note_missing(repetition, report)
    others = sum([_score(repetition, one) for one in stored])
    _note_unscored(repetition)
    if stored:
        _note_inputs(repetition, others)


def _score(repetition: Repetition, one: StoredCase) -> int:
    """Score one case again; return how many of its recordings have other bits here."""
    verification, submission = repetition.verification, repetition.submission
    before = repetition.find(one.case)
    check, edition = repetition.registry.check(one.case.check), find_edition(submission.edition)
    profiles = read_passes(one.files, "answer")
    result, inputs = score_again(check, one.case, profiles, submission.describe(), edition)
    differences = [*compare_results(before, result, SCORED), *compare_truth(one, result)]
    for difference in differences:
        verification.contradict(one.folder, difference)
    if not differences:
        failure = describe_failure(result, submission.device_class)
        text = f"fails: {failure}" if failure else "is within every limit"
        what = f"{one.case.check}, {one.case.name}, scored from the stored profiles"
        verification.repeated.append(f"{what}: {text}")
    return count_other_inputs(one, inputs)


def _note_missing(repetition: Repetition, report: Mapping[str, Any]) -> None:
    """Name every case that decides, delivered profiles, and is without them in the archive."""
    decisive = repetition.decisive
    for check in report["checks"]:
        for result in repetition.results.get(check["id"], ()):
            digest = Case.of(check["id"], result.parameters).digest
            delivered = result.fault is None and bool(result.measurements)
            if delivered and _decides(check, result) and (check["id"], digest) not in decisive:
                where = f"{ANSWERS}: {check['id']}, {result.name}"
                repetition.verification.contradict(where, "decides, and its profiles are missing")


def _decides(check: Mapping[str, Any], result: CaseResult) -> bool:
    """Return whether ``result`` is the worst, or the simplest that fails, of ``check``."""
    worst, simplest = check["worst"], check["counterexample"]
    return bool(worst and worst["case"] == result.name) or bool(
        simplest and simplest["parameters"] == result.parameters
    )


def _note_unscored(repetition: Repetition) -> None:
    decisive = repetition.decisive
    for id_, results in repetition.results.items():
        rest = len(results) - sum(id_ == check for check, _ in decisive)
        if rest > 0:
            what = f"{id_}: {rest} of {len(results)} cases have no stored profiles"
            repetition.verification.not_repeated.append(what)


def _note_inputs(repetition: Repetition, others: int) -> None:
    """Name recordings with other bits: on a machine like the archive's they have to be equal."""
    if not others:
        repetition.verification.repeated.append("recordings bit for bit, and their truth")
    elif _has_these_bits(repetition.submission):
        what = f"{others} recordings have other bits than the archive states"
        repetition.verification.contradict("answers: inputs", what)
    else:
        repetition.verification.not_repeated.append(
            f"the bits of {others} recordings: other sources, or another environment"
        )


def _has_these_bits(submission: Submission) -> bool:
    """Return whether sources and environment are such that recordings have the bits of ours."""
    stated, ours = dict(submission.environment), describe_environment()
    for each in (stated, ours):
        # It draws numbers of cases, and no sample.
        each.pop(DRAWER, None)
    return stated == ours and dict(submission.suite) == describe_suite()
