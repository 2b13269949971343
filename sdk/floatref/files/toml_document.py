"""Reading a TOML file within limits of size, memory and time."""

import math
import re
import tomllib
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.document import show
from floatref.files.sources import name_errors, open_bytes

LARGEST_BYTES = 1 << 20
DEEPEST = 16
MOST_PARTS = 32
"""Parts of a dotted key; the parser's memory grows with their square."""
DOTTED = re.compile(
    r"""(?:(?:(?<!\\)"(?:[^"\\\n]|\\.){0,200}+"|'[^'\n]{0,200}+'|(?<![\w-])[A-Za-z0-9_-]++)"""
    rf"""[ \t]*+\.[ \t]*+){{{MOST_PARTS}}}"""
)


def read_toml(path: Path, kind: str) -> dict[str, Any]:
    """Return the content of the TOML file ``path``: tables, lists, strings, numbers, truth values.

    Raises InputError with one line, in which ``kind`` is the expected kind of file, such as
    "channel map", if it cannot be read, is above 1 MiB, not UTF-8 or not TOML, and for dates,
    numbers beyond float64 and 64 bits, and deep nesting.
    """
    with open_bytes(path) as stream:
        content = stream.read(LARGEST_BYTES + 1)
    with name_errors(path):
        if len(content) > LARGEST_BYTES:
            raise InputError(f"larger than 1 MiB; give a {kind} in TOML")
        document = _parse(_decode(content, kind), kind)
        _check_plain(document, "")
    return document


def _decode(content: bytes, kind: str) -> str:
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"byte {error.start} is not UTF-8; save the {kind} as UTF-8") from error


def _parse(text: str, kind: str) -> dict[str, Any]:
    if DOTTED.search(text):
        raise InputError(
            f"has a name of {MOST_PARTS} parts or more, as in a.b.c; shorten it, or write \\u002E "
            "for the points in a string"
        )
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"not TOML: {error}; correct it there") from error
    except (RecursionError, ValueError) as error:
        # Nesting without end, or an integer of thousands of digits.
        raise InputError(f"no {kind} ({type(error).__name__}); shorten it") from error


def _check_plain(value: Any, where: str, depth: int = 0) -> None:
    """Refuse numbers that are not finite, dates, and nesting deeper than any valid file."""
    if depth > DEEPEST:
        raise InputError(f"{where[:60]}: nested too deeply; there is no such entry")
    if isinstance(value, dict):
        for key, item in value.items():
            _check_plain(item, f"{where}.{show(key)[1:-1]}".lstrip("."), depth + 1)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            _check_plain(item, f"{where}[{index}]", depth + 1)
    else:
        _check_value(value, where)


def _check_value(value: Any, where: str) -> None:
    if isinstance(value, float) and not math.isfinite(value):
        raise InputError(f"{where} is {value}; give a finite number")
    if isinstance(value, int) and abs(value) > 1 << 63:
        raise InputError(f"{where} is an integer beyond 64 bits; give a number")
    if not isinstance(value, str | int | float):
        raise InputError(f"{where} is a date or a time; give a number or a string")
