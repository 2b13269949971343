"""JSON documents: strict reading within a size limit, and writing without NaN."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from floatref.errors import InputError
from floatref.files.sources import open_bytes

LARGEST_BYTES = 4 << 20
"""Largest JSON file that is read; samples belong in separate files."""


def read_document(path: Path, most_bytes: int = LARGEST_BYTES) -> Any:
    """Return the content of the JSON file ``path``.

    Raises InputError for a file that is missing, empty, above ``most_bytes``, not UTF-8, not JSON
    or truncated, and for numbers beyond float64. The last of repeated keys counts.
    """
    with open_bytes(path) as stream:
        text = stream.read(most_bytes + 1)
    if len(text) > most_bytes:
        raise InputError(
            f"{path}: larger than {most_bytes >> 20} MiB; "
            "keep samples in files of their own beside it"
        )
    try:
        return parse_document(text.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: byte {error.start} is not UTF-8 text; give the JSON file of the directory"
        ) from error
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def write_document(document: Mapping[str, Any], path: Path) -> None:
    """Write ``document``, which holds plain JSON values only, to ``path``."""
    text = json.dumps(document, indent=1, allow_nan=False)
    path.write_text(text + "\n", encoding="ascii")


def plain(value: Any, where: str) -> Any:
    """Return ``value`` as JSON values: NaN becomes None, numpy and tuples become Python's own.

    Raises InputError naming ``where`` for infinities and for objects that JSON cannot hold.
    """
    if isinstance(value, Mapping):
        return {str(key): plain(item, f"{where}.{key}") for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist(), where)
    if isinstance(value, list | tuple):
        return [plain(item, f"{where}[{index}]") for index, item in enumerate(value)]
    if isinstance(value, float):
        return _number(value, where)
    if value is None or isinstance(value, str | int):
        return value
    kind = type(value).__name__
    raise InputError(f"{where} is a {kind}; give a number, a string, a list or a mapping")


def show(value: Any) -> str:
    """Return ``value`` as JSON in at most 60 printable characters, for an error text."""
    text = json.dumps(value, ensure_ascii=False, default=str)
    text = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text[:61])
    return text if len(text) <= 60 else text[:57] + "..."


def _number(value: float, where: str) -> float | None:
    if math.isinf(value):
        raise InputError(f"{where} is {value}; JSON holds finite numbers only")
    return None if math.isnan(value) else float(value)


def parse_document(text: str, keys_once: bool = False) -> Any:
    """Return the content of a JSON ``text``; InputError if it is empty, truncated or no JSON.

    The last of repeated keys counts; with ``keys_once`` they are an InputError.
    """
    if not text.strip():
        raise InputError("empty; copy the complete file")
    try:
        return json.loads(
            text,
            parse_constant=_refuse_constant,
            parse_float=_parse_float,
            parse_int=_parse_integer,
            object_pairs_hook=_refuse_repeated if keys_once else None,
        )
    except json.JSONDecodeError as error:
        cut = error.pos >= len(text.rstrip()) or error.msg.startswith("Unterminated")
        advice = "the file is cut short, copy it again" if cut else "correct it there"
        where = f"line {error.lineno}, column {error.colno}"
        raise InputError(f"not JSON at {where} ({error.msg}); {advice}") from error
    except RecursionError as error:
        raise InputError("lists or objects nested too deeply; flatten them") from error


def _refuse_repeated(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in pairs:
        if key in found:
            raise InputError(f"has the key {show(key)} twice in one object; give it once")
        found[key] = value
    return found


def _refuse_constant(literal: str) -> NoReturn:
    raise InputError(f"holds {literal}, which is not JSON; write null for a missing value")


def _parse_float(literal: str) -> float:
    value = float(literal)
    if math.isinf(value):
        raise InputError(f"holds the number {show(literal)[1:-1]}; float64 ends at 1.8e308")
    return value


def _parse_integer(literal: str) -> int | float:
    return int(literal) if len(literal) <= 18 else _parse_float(literal)
