"""The matrix for other programs: `conformance-matrix/1`."""

from dataclasses import asdict
from typing import Any

from floatref_conformance.matrix.result_matrix import Matrix, count_judged, follow_outcomes
from floatref_conformance.matrix.stored_reports import StoredReport
from floatref_conformance.render.json_values import finite
from floatref_conformance.schemas import enforce

FORMAT = "conformance-matrix/1"
SCHEMA = "conformance-matrix-1"


def matrix_document(matrix: Matrix) -> dict[str, Any]:
    """Return the object of ``matrix``; SuiteError if it breaks the schema."""
    document = {
        "format": FORMAT,
        "groups": [
            {
                "label": group.label,
                "edition": group.terms.edition,
                "class": group.terms.device_class,
                "seed": group.terms.seed,
                "effort": group.terms.effort,
                "differs_from_first": list(group.differs),
            }
            for group in matrix.groups
        ],
        "reports": [
            _report(report, label)
            for report, label in zip(matrix.reports, matrix.labels, strict=True)
        ],
        "checks": [
            {"id": id_, "cells": [finite(asdict(cell)) for cell in cells]}
            for id_, cells in matrix.rows.items()
        ],
    }
    enforce(SCHEMA, document)
    return document


def _report(report: StoredReport, label: str) -> dict[str, Any]:
    passed, judged = count_judged(report)
    device = report.document["device"]
    return {
        "name": report.name,
        "path": str(report.path),
        "group": label,
        "device": {key: device[key] for key in ("spec", "name", "version")},
        "verdict": report.document["verdict"],
        "outcomes_make": follow_outcomes(report),
        "class_reached": report.document["class_reached"],
        "passed": passed,
        "judged": judged,
    }
