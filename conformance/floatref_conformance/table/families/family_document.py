"""A table of families as one JSON object, ``conformance-families/1``."""

from dataclasses import asdict
from typing import Any

from floatref_conformance.render.json_values import finite
from floatref_conformance.schemas import enforce
from floatref_conformance.table.families.family_table import (
    FamilyPath,
    FamilyTable,
    error_of_valid,
    summarize,
)

FORMAT = "conformance-families/1"


def family_document(table: FamilyTable) -> dict[str, Any]:
    """Return the JSON object of ``table``; SuiteError if it breaks its own schema."""
    settings = table.settings
    made = {
        "format": FORMAT,
        "family": settings.family,
        "seed": settings.seed,
        "drives": settings.drives,
        "summaries": [
            {
                "pipeline": pipeline,
                "family": condition.family,
                "condition": condition.name,
                **finite(asdict(summarize(table.of(pipeline, condition)))),
            }
            for pipeline in settings.pipelines
            for condition in settings.conditions
        ],
        "wrong": [
            {**_place(path), "error_percent": error_of_valid(path)} for path in table.wrong()
        ],
        "paths": [
            {**_place(path), "failure": path.failure, "scores": _scores(path)}
            for path in table.paths
        ],
    }
    enforce("conformance-families-1", made)
    return made


def _place(path: FamilyPath) -> dict[str, Any]:
    return {
        "pipeline": path.pipeline,
        "family": path.condition.family,
        "condition": path.condition.name,
        "track": path.track,
        "scenario": path.scenario.to_dict(),
    }


def _scores(path: FamilyPath) -> dict[str, Any] | None:
    return None if path.scores is None else finite(asdict(path.scores))
