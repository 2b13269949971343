"""A table of drawn stops as one JSON object, ``conformance-stops/1``."""

from collections.abc import Iterator
from dataclasses import asdict
from itertools import groupby
from typing import Any

from floatref_conformance.render.json_values import finite
from floatref_conformance.schemas import enforce
from floatref_conformance.table.stops.stop_scores import STRETCH_M
from floatref_conformance.table.stops.stop_settings import STOP_ROADS
from floatref_conformance.table.stops.stop_table import StopTable, WheelPath, summary

FORMAT = "conformance-stops/1"


def stop_document(table: StopTable) -> dict[str, Any]:
    """Return the JSON object of ``table``; SuiteError if it breaks its own schema."""
    settings = table.settings
    made = {
        "format": FORMAT,
        "seed": settings.seed,
        "stops": settings.stops,
        "vehicles": list(settings.vehicles),
        "roads": [asdict(road) for road in STOP_ROADS],
        "stretch_m": list(STRETCH_M),
        "pipelines": [_pipeline(table, name) for name in settings.pipelines],
        "passes": list(_passes(table)),
    }
    enforce("conformance-stops-1", made)
    return made


def _pipeline(table: StopTable, name: str) -> dict[str, Any]:
    """Return the summaries of one pipeline, and where its lowest cross correlation is."""
    lowest = table.lowest(name)
    return {
        "pipeline": name,
        "all": finite(asdict(summary(table.of(name)))),
        "vehicles": {
            vehicle: finite(asdict(summary(table.of(name, vehicle=vehicle))))
            for vehicle in table.settings.vehicles
        },
        "roads": {
            road.name: finite(asdict(summary(table.of(name, road=road.kind))))
            for road in STOP_ROADS
        },
        "lowest": {"track": lowest.track, "scenario": lowest.scenario.to_dict()},
    }


def _passes(table: StopTable) -> Iterator[dict[str, Any]]:
    """Yield every drive with the scores of each wheel path through each pipeline."""
    for _, group in groupby(table.paths, key=lambda path: path.scenario.seed):
        paths = tuple(group)
        yield {
            "scenario": paths[0].scenario.to_dict(),
            "wheel_paths": [_wheel_path(path) for path in paths],
        }


def _wheel_path(path: WheelPath) -> dict[str, Any]:
    return {
        "pipeline": path.pipeline,
        "track": path.track,
        **finite(asdict(path.scores)),
    }
