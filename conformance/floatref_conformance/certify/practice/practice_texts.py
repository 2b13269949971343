"""Texts of a practice: a worksheet, a page and a terminal show them, each on one line."""

from collections.abc import Iterator
from typing import Any

from floatref.errors import InputError
from floatref.files.document import show
from floatref_conformance.render.text import printable


def check_texts(document: Any) -> None:
    """Raise InputError, which names the field, for a text with what cannot be shown on one line.

    These are line breaks, control characters, halves of a pair, and what turns the direction of
    writing: a clause with one of them reads as another, or cannot be written to a file.
    """
    for where, text in _texts(document, ""):
        if printable(text) != text or text.splitlines() not in ([], [text]):
            raise InputError(
                f"{where} is {show(text)}; leave out line breaks and what cannot be shown"
            )


def _texts(value: Any, where: str) -> Iterator[tuple[str, str]]:
    """Yield every text within ``value``, a JSON value, with the path to it."""
    if isinstance(value, str):
        yield where, value
    elif isinstance(value, dict):
        for key, each in value.items():
            yield from _texts(each, f"{where}.{key}".lstrip("."))
    elif isinstance(value, list):
        for index, each in enumerate(value):
            yield from _texts(each, f"{where}[{index}]")
