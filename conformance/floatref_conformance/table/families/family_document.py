"""A table of families as one JSON object, ``conformance-families/1``."""

from dataclasses import asdict
from typing import Any

from floatref_conformance.render.json_values import finite
from floatref_conformance.schemas import enforce
from floatref_conformance.table.families.conditions import STOPS_FAMILY
from floatref_conformance.table.families.family_table import (
    FamilyPath,
    FamilyTable,
    error_of_valid,
    summarize,
)
from floatref_conformance.table.families.stop_shares import rows_of_stops, share_stops

FORMAT = "conformance-families/1"


def family_document(table: FamilyTable) -> dict[str, Any]:
    """Return the JSON object of ``table``; SuiteError if it breaks its own schema.

    That of the family `stops` also has the shares of every condition and vehicle.
    """
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
    if settings.family == STOPS_FAMILY:
        made["stop_shares"] = [
            share for name in settings.pipelines for share in _shares(table, name)
        ]
    enforce("conformance-families-1", made)
    return made


def _shares(table: FamilyTable, pipeline: str) -> list[dict[str, Any]]:
    """Return the shares of stops, of all vehicles of a condition together where it is null."""
    return [
        {
            "pipeline": pipeline,
            "condition": condition.name,
            "vehicle": vehicle,
            "wheel_paths": len(paths),
            "without_profile": sum(path.scores is None for path in paths),
            "encoder": finite(asdict(summarize(paths).encoder)),
            **finite(asdict(share_stops(paths))),
        }
        for condition, vehicle, paths in rows_of_stops(table, pipeline)
    ]


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
