"""Files of settings, which commands read and write."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.document import read_document


def read_settings(path: Path | None) -> Mapping[str, Any]:
    """Return the settings by name in ``path``, {} for None; InputError unless it is an object."""
    if path is None:
        return {}
    document = read_document(path)
    if not isinstance(document, dict):
        raise InputError(f"{path}: expected one JSON object of settings by name")
    return document
