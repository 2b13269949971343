"""Telling a profile in Parquet from a recording in Parquet, by the schema in its footer."""

from pathlib import Path
from typing import Any

from floatref import InputError, check_file, read_start
from floatref_adapters.shared.profile_columns import DISTANCE, ELEVATION
from floatref_adapters.shared.refusals import library

MARK = b"PAR1"
FORMAT = "floatref-profile/1"
"""What the schema's metadata says of a profile that floatref wrote."""
PROFILES = b"floatref-profile/"
"""How that begins in any version."""


def begins_as_parquet(path: Path) -> bool:
    """Return whether ``path`` is a file that begins as a Parquet file does."""
    return read_start(path, len(MARK)) == MARK


def holds_profile(path: Path) -> bool | None:
    """Return whether the footer of ``path`` is that of a profile; None if it cannot be read.

    It is one by its metadata, or by the names of its columns if another program wrote it.
    """
    schema = _read_schema(path)
    if schema is None:
        return None
    stated: bytes = (schema.metadata or {}).get(b"format", b"")
    names = schema.names
    by_name = DISTANCE in names and any(name.endswith(ELEVATION) for name in names)
    return stated.startswith(PROFILES) or by_name


def _read_schema(path: Path) -> Any | None:
    """Return the schema of ``path``; None where it is damaged, or pyarrow is missing."""
    try:
        arrow = library("pyarrow", "reading Parquet")
        parquet = library("pyarrow.parquet", "reading Parquet")
    except InputError:
        return None
    try:
        return parquet.read_schema(check_file(path))
    except (arrow.ArrowException, OSError, ValueError, OverflowError):
        return None
