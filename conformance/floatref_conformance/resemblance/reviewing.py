"""The flaws that a report says its device resembles, found again from what the archive holds."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from floatref.errors import InputError
from floatref_conformance.checks.likeness import Resemblance, resemblance_document
from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.render.report import NAME as REPORT
from floatref_conformance.resemblance.comparing import LEAST
from floatref_conformance.resemblance.fault_reasons import Judged
from floatref_conformance.resemblance.features import Features
from floatref_conformance.resemblance.naming import (
    NO_ANSWERS,
    PROBES,
    is_left_out,
    name_by_features,
    name_by_probes,
    name_by_report,
)
from floatref_conformance.resemblance.naming import REPORT as BY_REPORT

KEY = "resemblance"
WHERE = f"{REPORT}: {KEY}"
REMADE = 0.1
"""By how much a feature of a device that is run again may differ, on another machine too: 10 % of
a large error."""
LARGEST = 711.0
"""A feature is asinh of a number, and that of the largest number is smaller."""


def review(report: Mapping[str, Any], description: Description) -> str:
    """Return in a line how ``report`` contradicts what its own figures name here; empty if not.

    InputError for checks without outcomes.
    """
    stated = report[KEY]
    if report.get("verdict") != Verdict.FAIL.value:
        return "is there, and the device did not fail"
    features = read_features(stated)
    if features is None:
        return f"has features that are no numbers by name, up to {LARGEST:g}"
    if not features and stated.get("found_by") == PROBES and not _is_note(stated):
        return "has no features, and no note that a run writes for that"
    again = _find_again(report, stated, features, description)
    if stated != resemblance_document(again):
        return f"is not what the catalogue says: {_show(again)}"
    return ""


def _find_again(
    report: Mapping[str, Any],
    stated: Mapping[str, Any],
    features: Features,
    description: Description,
) -> Resemblance:
    """Return the resemblance that follows from a report; with its note, if it has no features."""
    by_report = name_by_report(_read(report, "checks"), _read(report, "stream_checks"))
    if by_report:
        return Resemblance(BY_REPORT, by_report, 1.0)
    if not features:
        return Resemblance(PROBES, least=LEAST, features=features, note=str(stated["note"]))
    return name_by_features(features, description)


def _is_note(stated: Mapping[str, Any]) -> bool:
    """Return whether a report without features says why in words that a run has for it."""
    note = str(stated.get("note"))
    return note == NO_ANSWERS or is_left_out(note)


def by_word(report: Mapping[str, Any]) -> str:
    """Return why the report alone says which flaws its device resembles; empty if they follow.

    They follow from features, or from faults in the report.
    """
    stated = report[KEY]
    return str(stated["note"]) if stated["found_by"] == PROBES else ""


@dataclass(frozen=True)
class Probed:
    """What the probes on a device show, of what a report states of it.

    Attributes:
        differences: what contradicts, in a line each.
        missing: why nothing was compared, in one line; empty if it was.
    """

    differences: tuple[str, ...] = ()
    missing: str = ""


def probe_again(
    report: Mapping[str, Any], device: Device, description: Description
) -> Probed | None:
    """Return what the probes on ``device`` show; None where they name no flaw in ``report``.

    That is where nobody asked for flaws, or faults in the report name them. A report that says why
    its probes were not finished states nothing that could be wrong.
    """
    stated = report.get(KEY)
    if report.get("verdict") != Verdict.FAIL.value or not isinstance(stated, dict):
        return None
    if name_by_report(_read(report, "checks"), _read(report, "stream_checks")):
        return None
    before, note = read_features(stated) or {}, str(stated.get("note"))
    now = name_by_probes(device, description)
    if not now.features:
        return Probed(missing=now.note)
    if before:
        # Its flaws follow from these, which the review of the report has compared.
        return Probed(tuple(_compare_features(before, now.features)))
    here = f"here {len(now.features)} features name {_show(now)}"
    if is_left_out(note):
        return Probed(missing=f"in the report, {note}; {here}")
    return Probed((f"the report has no features, {here}",))


def _compare_features(before: Features, now: Features) -> list[str]:
    """Return in a line each feature that differs."""
    return [
        f"{name} is {before.get(name)}, here it is {now.get(name)}"
        for name in sorted(before.keys() | now.keys())
        if not _agree(before.get(name), now.get(name))
    ]


def read_features(stated: Any) -> Features | None:
    """Return the features in a report's object; None if they are not numbers by name."""
    found = stated.get("features") if isinstance(stated, dict) else None
    if not isinstance(found, dict):
        return None
    usable = all(
        x is None or (isinstance(x, (int, float)) and not isinstance(x, bool) and abs(x) <= LARGEST)
        for x in found.values()
    )
    return found if usable else None


def _agree(one: float | None, other: float | None) -> bool:
    if one is None or other is None:
        return one is other
    return abs(one - other) <= REMADE


def _read(report: Mapping[str, Any], key: str) -> list[Judged]:
    try:
        return [
            Judged(str(check["id"]), Outcome(check["outcome"]), str(check["reason"]))
            for check in report.get(key) or []
        ]
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{REPORT}: {key} without outcomes; ask for it again") from error


def _show(found: Resemblance) -> str:
    return ", ".join(f"{one.mutant} {one.alike:g}" for one in found.flaws) or "no flaw"
