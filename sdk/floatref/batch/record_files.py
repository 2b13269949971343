"""Records as JSON files, `floatref-batch-record/1`: complete or not at all."""

from collections.abc import Mapping
from dataclasses import asdict, fields
from math import nan
from pathlib import Path
from typing import Any

from floatref.batch.record import FORMAT, Effort, Record, Row
from floatref.errors import InputError
from floatref.files.atomic import replacing_file
from floatref.files.document import plain, read_document, write_document
from floatref.files.schema import enforce

SCHEMA = "floatref-batch-record-1"
MOST_BYTES = 1 << 28
"""Largest record that is read: ten thousand kilometres in segments of 100 m."""


def read_record(path: Path) -> Record:
    """Return the record in the JSON file ``path``; InputError unless it is one."""
    document = read_document(path, MOST_BYTES)
    enforce(document, SCHEMA, path)
    return of_document(document)


def of_document(document: Mapping[str, Any]) -> Record:
    """Return the record that ``document`` holds, which obeys the schema."""
    return Record(
        name=document["name"],
        source=document["source"],
        error=document["error"],
        rows=tuple(map(_row, document["rows"])),
        warnings=tuple(document["warnings"]),
        remarks=tuple(document["remarks"]),
        key=document["key"],
        inputs=document["inputs"],
        outputs=document["outputs"],
        length_m=float(document["length_m"]),
        effort=Effort(**_known(document["effort"], Effort)),
    )


def write_record(record: Record, path: Path) -> None:
    """Write ``record`` to ``path`` in place of what is there; folders are made.

    Raises InputError if it cannot be written.
    """
    document = as_document(record)
    make_folder_of(path)
    with replacing_file(path, overwrite=True) as beside:
        write_document(document, beside)


def as_document(record: Record) -> dict[str, Any]:
    """Return ``record`` in plain JSON values, NaN as None; InputError if it has an infinity."""
    described = asdict(record)
    del described["skipped"]
    return {**plain({"format": FORMAT, **described}, "record")}


def make_folder_of(path: Path) -> None:
    """Make the folder that ``path`` is to lie in; InputError if that cannot be done."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(
            f"{path.parent}: no such folder can be made ({reason}); choose another --out"
        ) from error


def _row(entry: Mapping[str, Any]) -> Row:
    known = _known(entry, Row)
    return Row(**known | {name: nan for name, value in known.items() if value is None})


def _known(entry: Mapping[str, Any], kind: type[Row] | type[Effort]) -> dict[str, Any]:
    """Return what in ``entry`` is a field of ``kind``, numbers that are no counts as floats."""
    found = {f.name: (entry[f.name], f.type) for f in fields(kind)}
    return {
        name: float(value) if kind is float and value is not None else value
        for name, (value, kind) in found.items()
    }
