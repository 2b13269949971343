"""The worksheet as one JSON object, ``conformance-worksheet/1``."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any, cast

from floatref.files.atomic import replace_file
from floatref.files.document import plain
from floatref_conformance.certify.judging.contents import (
    Criterion,
    RunSheet,
    SectionSheet,
    StationarySheet,
    Worksheet,
)
from floatref_conformance.certify.practice.requirements import Practice
from floatref_conformance.schemas import enforce

FORMAT = "conformance-worksheet/1"
SCHEMA = "conformance-worksheet-1"


def as_json(worksheet: Worksheet) -> dict[str, Any]:
    """Return the JSON object of ``worksheet``, NaN as null.

    Raises SuiteError if it breaks its own schema, and InputError for settings that JSON cannot
    hold.
    """
    made = {
        "format": FORMAT,
        "profiler": worksheet.profiler,
        "class": worksheet.device_class.value,
        "verdict": worksheet.verdict.value,
        "practice": _practice(worksheet.limits.practice),
        "limits": worksheet.limits.figures(),
        "criteria": [_criterion(one) for one in worksheet.criteria],
        "sections": [_section(sheet) for sheet in worksheet.sections],
        "stationary": [_stationary(sheet) for sheet in worksheet.stationary],
        "settings": dict(worksheet.settings),
        "versions": dict(worksheet.versions),
    }
    document = cast(dict[str, Any], plain(made, "worksheet"))
    enforce(SCHEMA, document)
    return document


def write_worksheet(worksheet: Worksheet, path: Path) -> None:
    """Write `as_json` of ``worksheet`` to the file ``path``, replacing an older one whole.

    Raises InputError if it cannot be written.
    """
    text = json.dumps(as_json(worksheet), indent=1, ensure_ascii=False, allow_nan=False)
    with replace_file(path, overwrite=True) as beside:
        beside.write_text(text + "\n", encoding="utf-8")


def _practice(practice: Practice) -> Mapping[str, Any]:
    return {
        "name": practice.name,
        "title": practice.title,
        "version": practice.version,
        "sha256": practice.sha256,
        "changed": list(practice.changed),
        "not_judged": [one.quantity for one in practice.open_requirements()],
    }


def _criterion(criterion: Criterion) -> Mapping[str, Any]:
    return asdict(criterion) | {"judged": criterion.judged.value}


def _section(sheet: SectionSheet) -> Mapping[str, Any]:
    return {
        "name": sheet.name,
        "reference": sheet.reference_source,
        "reference_said": list(sheet.reference_notes),
        "start_m": sheet.start_m,
        "end_m": sheet.end_m,
        "interval_m": sheet.reference.interval_m,
        "reference_iri_m_per_km": dict(sheet.reference_iri),
        "criteria": [_criterion(one) for one in sheet.criteria],
        "runs": [_run(run) for run in sheet.runs],
        "pairs": dict(sheet.pairs),
        "lateral": [asdict(one) for one in sheet.lateral],
    }


def _run(run: RunSheet) -> Mapping[str, Any]:
    return {
        "name": run.name,
        "source": run.source,
        "said": list(run.notes),
        "error": run.error,
        "tracks": [asdict(track) for track in run.tracks],
    }


def _stationary(sheet: StationarySheet) -> Mapping[str, Any]:
    return {
        "id": sheet.id,
        "source": sheet.source,
        "start_m": sheet.start_m,
        "end_m": sheet.end_m,
        "iri_m_per_km": dict(sheet.iri_m_per_km),
        "said": list(sheet.notes),
        "criteria": [_criterion(one) for one in sheet.criteria],
    }
