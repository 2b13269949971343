"""The flaws that a report says its device resembles, found again from what the archive holds."""

from collections.abc import Mapping
from math import isfinite
from typing import Any

from floatref.errors import InputError
from floatref_conformance.checks.likeness import Resemblance, resemblance_document
from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.render.report import NAME as REPORT
from floatref_conformance.resemblance.comparing import LEAST
from floatref_conformance.resemblance.fault_reasons import Judged
from floatref_conformance.resemblance.features import Features, measure_features
from floatref_conformance.resemblance.naming import (
    PROBES,
    name_by_features,
    name_by_report,
)
from floatref_conformance.resemblance.naming import REPORT as BY_REPORT
from floatref_conformance.resemblance.probe_answers import ask_probes

KEY = "resemblance"
WHERE = f"{REPORT}: {KEY}"
REMADE = 0.05
"""By how much a feature of a device that is run again may differ: 5 % of a large error."""


def review(report: Mapping[str, Any], description: Description) -> str:
    """Return in a line how ``report`` contradicts what its own figures name here; empty if not.

    InputError for checks without outcomes.
    """
    stated = report[KEY]
    if report.get("verdict") != Verdict.FAIL.value:
        return "is there, and the device did not fail"
    features = read_features(stated)
    if features is None:
        return "has features that are no numbers by name"
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
    """Return the resemblance that follows from a report; with its note, if it has one."""
    by_report = name_by_report(_read(report, "checks"), _read(report, "stream_checks"))
    if by_report:
        return Resemblance(BY_REPORT, by_report, 1.0)
    if stated.get("note"):
        return Resemblance(PROBES, least=LEAST, features=features, note=str(stated["note"]))
    return name_by_features(features, description)


def compare_features(stated: Any, device: Device, description: Description) -> list[str]:
    """Return in a line each feature that the device does not have when it is run again."""
    before = read_features(stated) or {}
    now = measure_features(ask_probes(device, description))
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
        x is None or (isinstance(x, (int, float)) and not isinstance(x, bool) and isfinite(x))
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
