"""Waivers of known failures, one per line: the id of the check, then the reason."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from floatref.errors import InputError
from floatref.files import read_bytes
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.checks.verdict import CheckResult, Outcome, RunResult

MOST_BYTES = 1 << 20
NO_REASON = "no reason given"


def read_waivers(path: Path, known: Mapping[str, object]) -> dict[str, str]:
    """Return why each check in file ``path`` is waived.

    A line holds an id and, after white space, the reason. Text after a # is a comment; it is used
    as the reason if there is no other. Raises InputError for a check that is not in ``known`` or
    is named twice, and for a file that is not text.
    """
    try:
        content = read_bytes(path, MOST_BYTES, "list of waivers")
        lines = content.decode("utf-8-sig").splitlines()
    except InputError as error:
        raise InputError(f"{error}; name a file of waivers") from error
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: not UTF-8; write one check per line: its id, then the reason"
        ) from error
    waivers: dict[str, str] = {}
    for number, line in enumerate(lines, start=1):
        text, _, comment = line.partition("#")
        id_, reason = [*text.split(maxsplit=1), "", ""][:2]
        if not id_:
            continue
        if id_ in waivers or id_ not in {**known, **IDS, **STREAM_CHECKS}:
            what = "waived twice" if id_ in waivers else "unknown check"
            raise InputError(f"{path}, line {number}: {id_}: {what}; known: {', '.join(known)}")
        waivers[id_] = reason.strip() or comment.strip() or NO_REASON
    return waivers


def waive(result: CheckResult, waivers: Mapping[str, str]) -> CheckResult:
    """Return ``result``; a failure that ``waivers`` name becomes waived.

    A waiver applies to a limit only: a crash, a hang or an unusable profile remains an error.
    """
    if result.id not in waivers or result.outcome is not Outcome.FAIL:
        return result
    return replace(
        result,
        outcome=Outcome.WAIVED,
        reason=f"waived ({waivers[result.id]}): {result.reason}",
    )


def check_used(waivers: Mapping[str, str], result: RunResult, path: Path) -> None:
    """Raise InputError naming a waiver of ``path`` that no failure of ``result`` needed.

    For a check that ended in an error it is unknown whether its waiver is still needed.
    """
    found = {check.id: {check.outcome} for check in (*result.checks, *result.streams)}
    for case in result.replayed:
        found.setdefault(case["check"], set()).add(Outcome(case["outcome"]))
    for id_ in waivers:
        if not {Outcome.WAIVED, Outcome.ERROR} & found.get(id_, set()):
            raise InputError(f"{path}: {id_}: {_describe_unused(id_, result)}")


def _describe_unused(id_: str, result: RunResult) -> str:
    """Return why no failure of check ``id_`` was waived."""
    check = next((c for c in (*result.checks, *result.streams) if c.id == id_), None)
    if check is None or (check.outcome is Outcome.SKIP and not check.cases):
        return "was not run: nothing to waive; run it too, or delete the line"
    if check.outcome is Outcome.SKIP:
        return "was skipped by the device: nothing to waive; delete the line"
    if check.outcome is Outcome.NOT_APPLICABLE:
        return "does not apply to the device: nothing to waive; delete the line"
    return "did not fail: nothing to waive; delete the line"
