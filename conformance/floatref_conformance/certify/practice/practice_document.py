"""Practices as JSON files, ``conformance-practice/1``: our own by name, and those of an agency."""

import hashlib
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.document import parse_document
from floatref.files.schema import enforce_schema
from floatref.files.sources import name_errors, read_bytes
from floatref.values.display.similar_names import suggest
from floatref_conformance.certify.practice.practice_texts import check_texts
from floatref_conformance.certify.practice.requirements import (
    UNITS,
    Practice,
    Requirement,
    Source,
)
from floatref_conformance.classes import DeviceClass
from floatref_conformance.schemas import read_schema

SCHEMA = "conformance-practice-1"
DEFAULT = "aashto-r56-14"
"""The practice of a certification for which no other is named."""
LARGEST_BYTES = 1 << 20
CORRELATIONS = ("repeatability", "accuracy")
IN_UNITS: Mapping[str, Mapping[str, float]] = {
    "": {"": 1.0},
    "%": {"%": 1.0},
    "m": {"m": 1.0, "mm": 1e-3, "in": 0.0254, "ft": 0.3048},
    "mm": {"mm": 1.0, "in": 25.4, "mil": 0.0254, "m": 1e3},
    "m/km": {"m/km": 1.0, "in/mi": 25.4 / 1609.344},
}
"""By the unit of a quantity, what one of each unit of a file is in it."""


def list_names() -> tuple[str, ...]:
    """Return the names of our own practices, the default first."""
    names = sorted(
        entry.name.removesuffix(".json")
        for entry in _folder().iterdir()
        if entry.name.endswith(".json")
    )
    return DEFAULT, *(name for name in names if name != DEFAULT)


def find_practice(name_or_file: str) -> Practice:
    """Return our own practice of that name, or that of the JSON file.

    Raises InputError in one line naming the field for a file that is no practice, and for what is
    neither a name nor a file.
    """
    if name_or_file in list_names():
        return read_own(name_or_file)
    path = Path(name_or_file)
    if not path.exists():
        hint = suggest(name_or_file, list_names(), "known:")
        raise InputError(f"practice {name_or_file}: not one of ours, and no file; {hint}")
    data = read_bytes(path, LARGEST_BYTES, "practice")
    return _practice(data, path)


def read_own(name: str) -> Practice:
    """Return our own practice ``name``, which is one of `list_names`."""
    data = _folder().joinpath(f"{name}.json").read_bytes()
    return _made(parse_document(data.decode("utf-8")), data)


def _folder() -> Any:
    return files("floatref_conformance.certify.practice") / "data"


def _practice(data: bytes, source: Path) -> Practice:
    with name_errors(source):
        try:
            document = parse_document(data.decode("utf-8-sig"), keys_once=True)
        except UnicodeDecodeError as error:
            raise InputError(f"byte {error.start} is not UTF-8 text; give a JSON file") from error
    enforce_schema(document, read_schema(SCHEMA), source)
    with name_errors(source):
        check_texts(document)
        if document["name"] in list_names():
            raise InputError(
                f"name is {document['name']!r}, which is a practice of ours; give it another name"
            )
        made = _made(document, data)
        _check_once(made)
        return made


def _made(document: Mapping[str, Any], data: bytes) -> Practice:
    """Return the practice that ``document``, which keeps the schema, describes."""
    return Practice(
        document["name"],
        document["title"],
        document["version"],
        tuple(_requirement(index, entry) for index, entry in enumerate(document["limits"])),
        hashlib.sha256(data).hexdigest(),
        document.get("status", ""),
        tuple(document.get("notes", ())),
    )


def _requirement(index: int, entry: Mapping[str, Any]) -> Requirement:
    quantity, given = entry["quantity"], entry["limit"]
    known = IN_UNITS[UNITS[quantity]]
    where = f"limits[{index}] ({quantity})"
    if entry["unit"] not in known:
        units = ", ".join(repr(unit) for unit in known)
        raise InputError(f"{where}: unit is {entry['unit']!r}; expected {units}")
    limit = None if isinstance(given, str) else round(given * known[entry["unit"]], 12)
    if limit is not None:
        _check_limit(where, quantity, limit)
    return Requirement(
        quantity,
        limit,
        given if isinstance(given, str) else "",
        entry["clause"],
        entry.get("basis", "agency"),
        Source(**entry["source"]),
        entry.get("missing", ""),
        entry.get("class", ""),
        entry.get("verdict", True),
    )


def _check_limit(where: str, quantity: str, limit: float) -> None:
    """Raise InputError for a limit that every run or no run can keep, and for parts of a run."""
    if quantity in CORRELATIONS and not 0.0 < limit <= 1.0:
        raise InputError(
            f"{where}: limit is {limit:g}; a correlation is from 0 to 1, and all reach 0"
        )
    if quantity == "interval_m" and limit <= 0.0:
        raise InputError(f"{where}: limit is {limit:g}; give an interval above 0")
    if quantity == "runs" and (limit < 1.0 or limit != int(limit)):
        raise InputError(f"{where}: limit is {limit:g}; give a whole number of runs, 1 or more")


def _check_once(practice: Practice) -> None:
    """Raise InputError for a quantity that has two limits in one class."""
    for device_class in DeviceClass:
        seen = set()
        for one in practice.of_class(device_class.value).requirements:
            if one.quantity in seen:
                raise InputError(
                    f"limits: {one.quantity} has two limits in class {device_class}; give one"
                )
            seen.add(one.quantity)
