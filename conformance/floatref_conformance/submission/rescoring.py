"""Profiles of an archive scored again: the recording and its truth are simulated here."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from floatref.errors import InputError
from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check, fit_check
from floatref_conformance.checks.verdict import CaseResult
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.editions.edition import Edition
from floatref_conformance.judge.bench import DeviceBench
from floatref_conformance.judge.replaying import judge_case, refuse_foreign
from floatref_conformance.submission.agreement import TRUTH_M
from floatref_conformance.submission.document import read_json
from floatref_conformance.submission.stored_answers import (
    FOLDER,
    StoredAnswers,
    largest_difference,
    read_passes,
    refuse_without,
)

Inputs = Sequence[Mapping[str, str]]
"""Of each recording of a case, the SHA-256 of every file."""


@dataclass(frozen=True)
class StoredCase:
    """A case whose profiles the archive holds.

    Attributes:
        folder: where in the archive they are.
        case: of the check.
        files: their contents, by name within the folder.
        inputs: hashes of the recordings that the device was given.
    """

    folder: str
    case: Case
    files: Mapping[str, bytes]
    inputs: Inputs


def score_again(
    check: Check,
    case: Case,
    profiles: Sequence[Profile],
    description: Description,
    edition: Edition,
) -> tuple[CaseResult, Inputs]:
    """Return the result of ``case`` for stored ``profiles``, and hashes of its recordings."""
    device = StoredAnswers(profiles, vars(description))
    result = judge_on(device, check, case, description, edition)
    return result, device.inputs


def judge_on(
    device: Device, check: Check, case: Case, description: Description, edition: Edition
) -> CaseResult:
    """Return the result of ``case`` for ``device``; InputError for numbers that make no case."""
    refuse_foreign(check, case)
    bench = DeviceBench(device, description, edition=edition)
    return judge_case(fit_check(check, description.meets), case, bench)


def list_stored(members: Mapping[str, bytes]) -> Iterator[StoredCase]:
    """Yield the cases of ``members`` with profiles; InputError for what is no case."""
    folders = sorted({"/".join(n.split("/")[:2]) for n in members if n.startswith(f"{FOLDER}/")})
    for folder in folders:
        files = {
            name[len(folder) + 1 :]: content
            for name, content in members.items()
            if name.startswith(f"{folder}/")
        }
        yield _read_case(folder, files)


def _read_case(folder: str, files: Mapping[str, bytes]) -> StoredCase:
    where = f"{folder}/case.json"
    found = read_json(refuse_without(files, "case.json"), where)
    try:
        case = Case.of(str(found["check"]), found["parameters"], str(found["name"]))
        inputs: list[dict[str, str]] = [dict(digests) for digests in found["inputs"]]
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{where}: not a case ({error}); ask for the archive again") from error
    if folder != f"{FOLDER}/{case.check}-{case.digest}":
        raise InputError(f"{where}: is another case than its folder says; ask for it again")
    rest = {name: content for name, content in files.items() if name != "case.json"}
    return StoredCase(folder, case, rest, inputs)


def compare_truth(stored: StoredCase, again: CaseResult) -> Iterator[str]:
    """Yield what differs between the truth in the archive and that of the simulation here."""
    truths = read_passes(stored.files, "truth")
    if len(truths) != len(again.passes):
        yield f"{len(truths)} true profiles, here they are {len(again.passes)}"
        return
    for number, (before, now) in enumerate(zip(truths, again.passes, strict=True), 1):
        largest = largest_difference(now.truth, before)
        if not largest <= TRUTH_M:
            yield f"truth {number} is {largest:.3g} m away from that of the simulation here"


def count_other_inputs(stored: StoredCase, inputs: Inputs) -> int:
    """Return the number of recordings whose bits are not those that the archive states."""
    pairs: list[tuple[Any, Any]] = list(zip(stored.inputs, inputs, strict=False))
    longest = max(len(stored.inputs), len(inputs))
    return sum(dict(a) != dict(b) for a, b in pairs) + longest - len(pairs)
