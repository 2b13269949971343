"""The JSON Schemas of the suite's files, shipped with it and enforced on writing."""

import json
from importlib.resources import files
from typing import Any

from jsonschema import Draft202012Validator

from floatref_conformance.errors import SuiteError


def read_schema(name: str) -> dict[str, Any]:
    """Return schema ``name``, for example ``conformance-report-1``."""
    text = files(__name__).joinpath(f"{name}.json").read_text(encoding="utf-8")
    schema: dict[str, Any] = json.loads(text)
    return schema


def enforce(name: str, document: object) -> None:
    """Raise SuiteError unless ``document``, made by the suite itself, keeps schema ``name``."""
    for error in Draft202012Validator(read_schema(name)).iter_errors(document):
        raise SuiteError(f"{name} at {error.json_path}: {error.message}")
