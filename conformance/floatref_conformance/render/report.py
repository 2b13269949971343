"""`report.json`: the result for other programs."""

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from floatref.files.owners import own_name
from floatref_conformance.checks.likeness import resemblance_document
from floatref_conformance.checks.verdict import CheckResult, Measurement, RunResult
from floatref_conformance.classes import DeviceClass
from floatref_conformance.judge.events import Event, RunFinished
from floatref_conformance.render.json_values import finite
from floatref_conformance.render.wording import margin
from floatref_conformance.schemas import enforce

NAME = "report.json"


@dataclass(frozen=True)
class JsonReport:
    """Writes ``report.json`` into ``folder`` when the verdict is there."""

    folder: Path

    @classmethod
    def into(cls, folder: Path) -> "JsonReport":
        """Return a writer into ``folder``, made if need be; OSError if it cannot be.

        The report of an earlier run goes away now, so that it is never taken for this one's.
        """
        folder.mkdir(parents=True, exist_ok=True)
        (folder / NAME).unlink(missing_ok=True)
        return cls(folder)

    def handle(self, event: Event) -> None:
        """Write the report once the run has finished."""
        if isinstance(event, RunFinished):
            write(as_json(event.result), self.folder / NAME)


@dataclass(frozen=True)
class JsonOutput:
    """Passes the report as one text to ``write`` when the verdict is there.

    The text is ASCII; it is the same document as that of `JsonReport`.
    """

    write: Callable[[str], None]

    def handle(self, event: Event) -> None:
        """Write the report once the run has finished; SuiteError if it breaks the schema."""
        if isinstance(event, RunFinished):
            document = as_json(event.result)
            enforce("conformance-report-1", document)
            self.write(json.dumps(document, indent=2, allow_nan=False))


def as_json(result: RunResult) -> dict[str, Any]:
    """Return ``result`` as the object of format conformance-report/1; NaN becomes null."""
    shown = result.streams_shown
    streams = {"stream_checks": [_check(c, result.device_class) for c in shown]} if shown else {}
    found = result.resemblance
    alike = {} if found is None else {"resemblance": finite(resemblance_document(found))}
    return {
        "format": "conformance-report/1",
        "edition": result.edition,
        "device": finite(result.device),
        "class": result.device_class.value,
        "class_reached": _name(result.class_reached),
        "seed": result.seed,
        "effort": result.effort,
        "verdict": result.verdict.value,
        "checks": [_check(check, result.device_class) for check in result.checks],
        **streams,
        "replayed": [finite(replayed) for replayed in result.replayed],
        **alike,
    }


def write(document: dict[str, Any], path: Path) -> None:
    """Write ``document`` beside ``path`` and rename it; SuiteError if it breaks the schema."""
    enforce("conformance-report-1", document)
    text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    beside = path.with_name(own_name())
    try:
        # A new file, so that no link is followed, as renaming does not.
        with beside.open("xb") as stream:
            # A lone surrogate, which UTF-8 has no bytes for, becomes its escape in JSON.
            stream.write(text.encode("utf-8", "backslashreplace"))
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)


def _check(check: CheckResult, device_class: DeviceClass) -> dict[str, Any]:
    early = {"early_m": check.early_m} if check.early_m else {}
    nees = {"nees": finite(asdict(check.nees))} if check.nees else {}
    alarms = {"false_alarms": check.false_alarms} if check.false_alarms else {}
    return {
        "id": check.id,
        "outcome": check.outcome.value,
        "reason": check.reason,
        "class_reached": _name(check.class_reached),
        "cases": check.cases,
        "worst": check.worst and _measured(check.worst, check.worst_case, device_class),
        "shown": check.shown and _measured(check.shown, check.shown_case, device_class),
        "clause": check.clause,
        "flagged_m": check.flagged_m,
        **early,
        **alarms,
        **nees,
        "counterexample": finite(check.counterexample),
    }


def _measured(worst: Measurement, case: str, device_class: DeviceClass) -> dict[str, Any]:
    """Return ``worst`` of its check; the limit is null in a class that does not limit it."""
    return {
        "value": finite(worst.value),
        "limit": worst.limits.get(device_class),
        "unit": worst.unit,
        "quantity": worst.quantity,
        "track": worst.track,
        "case": case,
        "margin": margin(worst, device_class),
    }


def _name(device_class: DeviceClass | None) -> str | None:
    return None if device_class is None else device_class.value
