"""Everything of a submission that can be repeated here, offline, in one pass over the archive."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref_conformance.checks.verdict import CaseResult, Outcome, Verdict, verdict_on
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.runner import UNDESCRIBED
from floatref_conformance.judge.waivers import NO_REASON
from floatref_conformance.plugins import load_registry
from floatref_conformance.registry import Registry
from floatref_conformance.render.report import NAME as REPORT
from floatref_conformance.resemblance.reviewing import KEY, WHERE, by_word, review
from floatref_conformance.submission.checksums import SUMS, compare_sums
from floatref_conformance.submission.device_again import GivenDevice, repeat_device
from floatref_conformance.submission.document import NAME, Submission, read_json, read_submission
from floatref_conformance.submission.findings import Verification
from floatref_conformance.submission.origins import (
    describe_environment,
    describe_other_drawer,
    describe_suite,
)
from floatref_conformance.submission.packing import RESULTS
from floatref_conformance.submission.rejudging import (
    Repetition,
    check_members,
    score_stored,
)
from floatref_conformance.submission.result_records import read_result
from floatref_conformance.submission.retracing import (
    Departed,
    compare_reports,
    make_report,
)
from floatref_conformance.submission.signatures import SIGNATURES, check_signature
from floatref_conformance.submission.stored_answers import refuse_without

RECORDED = "files:"
TOLD_APART = ("verdict", "stream_checks", KEY)
"""Keys of a report that are compared by rule: streams and probes have no stored results."""


@dataclass(frozen=True)
class Wanted:
    """What a verification is asked for beside the archive.

    Attributes:
        signers: who may have signed it; None if anybody.
        device: the device itself, to run it again; None without it.
        every_case: whether the device gets every case again, not only those that decide.
    """

    signers: Path | None = None
    device: GivenDevice | None = None
    every_case: bool = False


def verify(
    members: Mapping[str, bytes],
    wanted: Wanted,
    load: Callable[[str], Registry] = load_registry,
) -> Verification:
    """Return what the repetition of ``members``, an archive's, has shown.

    ``load`` returns the checks of an edition. Raises InputError if the archive is not of
    `conformance submit`, or a tool is missing.
    """
    verification = Verification()
    check_signature(members, wanted.signers, verification)
    verification.findings += compare_sums(members, SIGNATURES)
    verification.repeated.append(f"{SUMS}: the SHA-256 of {len(members)} members")
    try:
        _repeat(members, wanted, load, verification)
    except InputError as error:
        # What cannot be read of a changed archive contradicts, too.
        verification.contradict("archive", str(error))
    return verification


def _repeat(
    members: Mapping[str, bytes],
    wanted: Wanted,
    load: Callable[[str], Registry],
    verification: Verification,
) -> None:
    submission = read_submission(refuse_without(members, NAME))
    report = read_json(refuse_without(members, REPORT), REPORT)
    if not isinstance(report, dict):
        raise InputError(f"{REPORT}: not an object; ask for the archive again")
    verification.claimed, verification.about = str(report.get("verdict")), submission.about
    results = read_results(members)
    repetition = Repetition(members, submission, results, load(submission.edition), verification)
    _compare_origins(submission, verification)
    _check_waivers(submission, verification)
    _check_search(submission, verification)
    again = _retrace(repetition, report)
    if again is None:
        # Only what the edition draws is simulated: other numbers could take hours.
        verification.not_repeated.append("profiles: the cases are not those that are drawn here")
        return
    check_members(repetition, again)
    score_stored(repetition, again)
    repeat_device(repetition, wanted.device, wanted.every_case)


def read_results(members: Mapping[str, bytes]) -> dict[str, list[CaseResult]]:
    """Return the results of all cases by check, in their order; InputError for others."""
    results = {}
    for name, content in members.items():
        if name.startswith(f"{RESULTS}/") and name.endswith(".json"):
            found = read_json(content, name)
            if not isinstance(found, list):
                raise InputError(f"{name}: not a list of results; ask for the archive again")
            id_ = name[len(RESULTS) + 1 : -len(".json")]
            results[id_] = [read_result(entry, name) for entry in found]
    return results


def _retrace(repetition: Repetition, report: dict[str, Any]) -> dict[str, Any] | None:
    """Compare ``report`` with its repetition, and return that; None where the cases are others."""
    verification, results = repetition.verification, repetition.results
    try:
        again = make_report(repetition.submission, results, repetition.registry)
    except Departed as error:
        _explain_departure(error, repetition.submission, verification)
        # What a report says of itself holds whatever the cases are.
        _compare_verdict(report, report, verification)
        return None
    except SuiteError as error:
        # Figures that no run has can stop the judge where those of a run cannot.
        verification.contradict(RESULTS, str(error))
        return None
    for place, what in compare_reports(_comparable(report), _comparable(again)):
        verification.contradict(f"{REPORT}: {place}", what)
    _compare_verdict(report, again, verification)
    check_resemblance(report, repetition.submission, verification)
    count = sum(map(len, results.values()))
    verification.repeated.append(f"the report, figure by figure, from the results of {count} cases")
    streams = report.get("stream_checks")
    if streams:
        verification.not_repeated.append(f"{len(streams)} checks of streams: they need the device")
    return again


def _explain_departure(error: Departed, submission: Submission, verification: Verification) -> None:
    """Contradict an archive of other cases, unless another library may have drawn them.

    Only a search draws by a library, whose versions may draw others from the same seed: so an
    honest archive would be accused. Whoever states another version than the true one is found where
    that is installed, and has nothing confirmed before.
    """
    other = describe_other_drawer(submission.environment)
    if not (other and error.searched and submission.searching):
        verification.contradict(RESULTS, str(error))
        return
    verification.undecided = (
        f"the archive states {other}, and a search draws other cases here: verify again where "
        "that version is installed, or ask for an archive made with yours"
    )


def _comparable(report: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in report.items() if key not in TOLD_APART}


def check_resemblance(
    report: Mapping[str, Any], submission: Submission, verification: Verification
) -> None:
    """Compare the flaws that ``report`` names, if it does, with those of the catalogue here.

    With other sources of the suite the catalogue may be another one, and nothing is compared.
    """
    what = "the flaws that it resembles"
    if report.get(KEY) is None:
        if report.get("verdict") == Verdict.FAIL.value:
            verification.not_repeated.append(f"{what}: the report does not have them")
        return
    if dict(submission.suite) != describe_suite():
        verification.not_repeated.append(f"{what}: the catalogue may be another one")
        return
    known = UNDESCRIBED if submission.fault else submission.describe()
    contradiction = review(report, known)
    if contradiction:
        verification.contradict(WHERE, contradiction)
    elif note := by_word(report):
        verification.not_repeated.append(f"{what}: by the word of the report, {note}")
    else:
        verification.repeated.append(f"{what}, from the stored features or faults")


def _compare_verdict(
    report: Mapping[str, Any], again: Mapping[str, Any], verification: Verification
) -> None:
    """Compare the verdict with the one that follows from all outcomes, of streams included."""
    try:
        checks = [*again["checks"], *again["replayed"], *(report.get("stream_checks") or [])]
        follows = verdict_on([Outcome(check["outcome"]) for check in checks]).value
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{REPORT}: stream_checks without outcomes; ask for it again") from error
    if report.get("verdict") != follows:
        what = f"is {report.get('verdict')}, the outcomes make it {follows}"
        verification.contradict(f"{REPORT}: verdict", what)


def _check_waivers(submission: Submission, verification: Verification) -> None:
    for id_, reason in submission.waivers.items():
        if reason.strip() in ("", NO_REASON):
            verification.contradict(f"{NAME}: waivers", f"{id_} is waived without a reason")


def _check_search(submission: Submission, verification: Verification) -> None:
    """Contradict a run without a search: recorded profiles alone are judged so."""
    if not submission.searching and not submission.device["spec"].startswith(RECORDED):
        what = "is false, but only `files:` is judged without cases that a search draws"
        verification.contradict(f"{NAME}: searching", what)


def _compare_origins(submission: Submission, verification: Verification) -> None:
    """Say whether this suite is the one of the archive, and this machine one like it."""
    suite, environment = describe_suite(), describe_environment()
    if dict(submission.suite) != suite:
        stated = submission.suite["version"]
        verification.not_repeated.append(
            f"the suite itself: the archive is of version {stated} with other sources than here, "
            f"version {suite['version']}"
        )
    others = [
        f"{name} {submission.environment.get(name)}, here {value}"
        for name, value in environment.items()
        if submission.environment.get(name) != value
    ]
    if others:
        verification.not_repeated.append(f"the environment: {'; '.join(others)}")
