"""Scenario files: what they may hold, as a JSON Schema, and how one is read."""

import json
from dataclasses import Field, fields, replace
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files import read_bytes
from floatref_conformance.proving_ground.roads.files import FILE_ROAD, file_of
from floatref_conformance.proving_ground.scenario import (
    FIRST_FORMAT,
    FORMAT,
    MANOEUVRES,
    ROADS,
    SECOND_DISTANCES,
    Scenario,
)
from floatref_conformance.proving_ground.vehicles.parameter_sets import LINEAR_MODELS, VEHICLES

CHOICES = {
    "manoeuvre": MANOEUVRES,
    "vehicle": (*VEHICLES, *LINEAR_MODELS),
    "second_distance": SECOND_DISTANCES,
}
"""The names that a field may have. A road may also be `measured:FILE`."""


LARGEST_BYTES = 1 << 20


def read_scenario(path: Path) -> Scenario:
    """Return the scenario in a JSON file; InputError with one line naming the file.

    The file of a road is found from the folder of the scenario file.
    """
    try:
        document = json.loads(read_bytes(path, LARGEST_BYTES, "scenario").decode("utf-8"))
    except InputError as error:
        raise InputError(f"{error}; give a run or a scenario file") from error
    except ValueError as error:
        raise InputError(f"{path}: not JSON ({error}); write one object") from error
    except RecursionError as error:
        raise InputError(f"{path}: nested too deeply; write one object of numbers") from error
    try:
        scenario = Scenario.from_dict(document)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    road = file_of(scenario.road)
    return scenario if road is None else replace(scenario, road=f"{FILE_ROAD}{path.parent / road}")


def scenario_schema() -> dict[str, Any]:
    """Return the JSON Schema ``floatref-scenario-2``, made from the fields of `Scenario`."""
    properties: dict[str, Any] = {
        "$schema": {"type": "string"},
        "format": {"enum": [FORMAT, FIRST_FORMAT], "default": FORMAT},
    }
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": FORMAT.replace("/", "-"),
        "title": "One recording to be simulated",
        "type": "object",
        "additionalProperties": False,
        "properties": properties | {f.name: _describe(f) for f in fields(Scenario)},
    }


def _describe(field: Field[Any]) -> dict[str, Any]:
    """Return the schema of one field."""
    found: dict[str, Any] = {"description": field.metadata["meaning"], "default": field.default}
    if isinstance(field.default, tuple):
        names = {"type": "array", "minItems": 1, "uniqueItems": True, "items": {"type": "string"}}
        return found | names | {"default": list(field.default)}
    if isinstance(field.default, bool):
        return found | {"type": "boolean"}
    if isinstance(field.default, str):
        known = CHOICES.get(field.name)
        return (
            found
            | {"type": "string"}
            | ({"enum": list(known)} if known else {"examples": list(ROADS)})
        )
    kind = "integer" if isinstance(field.default, int) else "number"
    limits = {"minimum": field.metadata["lowest"], "maximum": field.metadata["highest"]}
    return found | {"type": kind} | limits
