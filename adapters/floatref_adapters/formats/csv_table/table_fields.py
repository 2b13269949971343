"""The fields of a table: how a line is split, what is a number, and what is missing."""

import csv
import io
import re
from collections.abc import Iterator, Sequence

import numpy as np

from floatref import InputError

MISSING = frozenset(
    ("", "-", "--", "na", "n/a", "#n/a", "nan", "null", "none", "#div/0!", "#num!", "#value!")
)
"""Fields of missing samples, in small letters, those of spreadsheets' errors among them."""
SPACES = " "
"""The delimiter of columns that runs of spaces or tabs part."""
_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?|[+-]?inf(inity)?", re.ASCII | re.I)


def is_missing(text: str) -> bool:
    """Tell whether the field ``text`` stands for no sample."""
    return text.strip().lower() in MISSING


def is_number(text: str, decimal: str = ".") -> bool:
    """Tell whether the field ``text`` is a number with the mark ``decimal``."""
    return parse(text, decimal) is not None


def is_numeral(text: str) -> bool:
    """Tell whether the field ``text`` is a number with one decimal mark or the other."""
    return is_number(text) or is_number(text, ",")


def parse(text: str, decimal: str = ".") -> float | None:
    """Return the number in ``text``; None if it is not a number, or has points of thousands."""
    plain = text.strip()
    if decimal == ",":
        if "." in plain:
            return None
        plain = plain.replace(",", ".", 1)
    return float(plain) if _NUMBER.fullmatch(plain) else None


def split(lines: Sequence[str], delimiter: str) -> Iterator[list[str]]:
    """Yield the fields of every line without the spaces around them.

    InputError for a quote that is not closed on its line, or a field of 128 KiB.
    """
    if delimiter == SPACES and not any('"' in line for line in lines):
        yield from (line.split() for line in lines)
        return
    if delimiter == SPACES:
        lines = [" ".join(line.split()) for line in lines]
    for line in lines:
        yield _fields(line, delimiter)


def _fields(line: str, delimiter: str) -> list[str]:
    source = io.StringIO(line, newline="\n")
    try:
        rows = list(csv.reader(source, delimiter=delimiter, skipinitialspace=True, strict=True))
    except csv.Error as error:
        raise InputError(f"{line[:40]!r} is no row ({error}); export the table again") from error
    return [field.strip() for field in rows[0]] if rows else []


def numbers(
    texts: Sequence[str], name: str, first: int, decimal: str = "."
) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Return the samples in ``texts``, fields of column ``name`` from row ``first`` on.

    InputError with the row, the column and the text if one is no number.
    """
    found = np.empty(len(texts))
    for k, text in enumerate(texts):
        number = parse(text, decimal)
        if number is None and not is_missing(text):
            raise InputError(f"row {first + k}: {name} is {text[:40]!r}; {advice(text, decimal)}")
        found[k] = np.nan if number is None else number
    return found


def advice(text: str, decimal: str) -> str:
    """Return what to do about a field that is no number."""
    mark, other = ("comma", "point") if decimal == "," else ("point", "comma")
    if "," in text and "." in text:
        return f"write a decimal {mark} and no sign between thousands"
    if any(is_number(text, d) or is_number(text.replace(d, ""), d) for d in ".,"):
        return f"write a decimal {mark}, not a decimal {other}, and no sign between thousands"
    return f"write a number with a decimal {mark}, or leave a missing sample empty"
