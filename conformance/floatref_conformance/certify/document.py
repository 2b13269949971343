"""The worksheet as one JSON object, ``conformance-worksheet/1``."""

from pathlib import Path
from typing import Any

from floatref_conformance.certify.worksheet import Worksheet

FORMAT = "conformance-worksheet/1"
SCHEMA = "conformance-worksheet-1"


def as_json(worksheet: Worksheet) -> dict[str, Any]:
    """Return the JSON object of ``worksheet``; SuiteError if it breaks its own schema."""
    raise NotImplementedError


def write_worksheet(worksheet: Worksheet, path: Path) -> None:
    """Write `as_json` of ``worksheet`` to the file ``path``, replacing an older one whole."""
    raise NotImplementedError
