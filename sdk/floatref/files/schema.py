"""The JSON Schemas of the directories, and their errors as one line with a remedy."""

import json
from collections.abc import Iterable
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any, cast

from floatref.errors import InputError
from floatref.files.document import show
from floatref.values.display.similar_names import suggest

if TYPE_CHECKING:
    from jsonschema import Draft202012Validator, ValidationError

SCHEMAS = (
    "floatref-recording-1",
    "floatref-profile-1",
    "floatref-map-1",
    "floatref-batch-1",
    "floatref-batch-record-1",
    "floatref-live-1",
    "floatref-live-answer-1",
)
"""Names of the schemas in the package."""


def read_schema(name: str) -> dict[str, Any]:
    """Return the JSON Schema (draft 2020-12) called ``name``; InputError if it is unknown."""
    if name not in SCHEMAS:
        raise InputError(f"schema {name}: unknown; {suggest(name, SCHEMAS, 'known:')}")
    text = (files("floatref.files") / "schemas" / f"{name}.json").read_text(encoding="utf-8")
    return cast(dict[str, Any], json.loads(text))


def enforce(document: Any, name: str, source: object) -> None:
    """Raise InputError unless ``document`` obeys schema ``name``.

    The line names ``source``, the JSON path, the value found there and what is expected.
    """
    _enforce(_validator(name), document, source)


def enforce_schema(document: Any, schema: dict[str, Any], source: object) -> None:
    """Raise InputError unless ``document`` obeys ``schema``, whose parts all have a description."""
    from jsonschema import Draft202012Validator

    _enforce(Draft202012Validator(schema), document, source)


def _enforce(validator: "Draft202012Validator", document: Any, source: object) -> None:
    error = next(validator.iter_errors(document), None)
    if error is not None:
        place = _place(document, error.absolute_path)
        raise InputError(f"{source}: {place}{_complaint(error)}; {_describe_expected(error)}")


@cache
def _validator(name: str) -> "Draft202012Validator":
    from jsonschema import Draft202012Validator

    return Draft202012Validator(read_schema(name))


def _place(document: Any, path: Iterable[str | int]) -> str:
    text, label, node = "", "", document
    for step in path:
        node = node[step]
        text += f"[{step}]" if isinstance(step, int) else f".{show(step)[1:-1]}"
        if isinstance(step, int) and isinstance(node, dict):
            label = _label(node)
    return f"{text.lstrip('.')}{label} " if text else ""


def _label(node: dict[str, Any]) -> str:
    known = (node.get("track"), node.get("name", node.get("channel")))
    parts = [show(part)[1:-1] for part in known if isinstance(part, str)]
    return f" ({'.'.join(parts)})" if parts else ""


def _complaint(error: "ValidationError") -> str:
    if error.validator == "required":
        required = cast(list[str], error.validator_value)
        missing = [key for key in required if key not in cast(dict[str, Any], error.instance)]
        return f"has no {', '.join(missing)}"
    if error.validator == "oneOf":
        options = cast(list[dict[str, Any]], error.validator_value)
        keys = [key for option in options for key in option["required"]]
        found = [key for key in keys if key in cast(dict[str, Any], error.instance)]
        return f"has {' and '.join(found) or 'no key'} of {', '.join(keys)}"
    if error.validator == "additionalProperties" and error.validator_value is False:
        return f"has the unknown key {show(_unknown(error))}"
    if "propertyNames" in error.absolute_schema_path:
        return f"holds the name {show(error.instance)}"
    if isinstance(error.instance, list) and error.validator in ("minItems", "maxItems"):
        return f"is a list of {len(error.instance)}"
    return f"is {show(error.instance)}"


def _unknown(error: "ValidationError") -> str:
    known = cast(dict[str, Any], error.schema)["properties"]
    return next(key for key in cast(dict[str, Any], error.instance) if key not in known)


def _describe_expected(error: "ValidationError") -> str:
    schema = cast(dict[str, Any], error.schema)
    if error.validator == "additionalProperties":
        return suggest(_unknown(error), schema["properties"], "known:")
    if error.validator == "enum" and isinstance(error.instance, str):
        return suggest(error.instance, cast(list[str], error.validator_value), "known:")
    return f"expected {schema['description']}"
