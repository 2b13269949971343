"""The marks of a table: what stands between its fields, and between units and tenths."""

from collections import Counter
from collections.abc import Mapping, Sequence

from floatref import InputError
from floatref_adapters.formats.csv_table.table_fields import (
    SPACES,
    is_missing,
    is_number,
    is_numeral,
    split,
)

DELIMITERS = ("\t", ";", "|", ",", SPACES)
"""Those looked for; of two that part the lines equally well the first is taken."""
COMMENTS = ("#", "%", "//")
FEW = 20
"""Lines up to which all are looked at, not the latter half of them alone."""
SPELLINGS: Mapping[str, str] = {
    "comma": ",",
    "semicolon": ";",
    "tab": "\t",
    "\\t": "\t",
    "pipe": "|",
    "space": SPACES,
    "spaces": SPACES,
}
"""Words for the option `delimiter`."""
DECIMALS: Mapping[str, str] = {".": ".", "point": ".", ",": ",", "comma": ","}


def find_delimiter(lines: Sequence[str], stated: str | None) -> str:
    """Return the delimiter of ``lines``; the comma if they have no delimiter."""
    if stated is not None:
        found = SPELLINGS.get(stated, stated)
        if found not in DELIMITERS:
            raise InputError(f"delimiter = {stated!r}; give comma, semicolon, tab, pipe or space")
        return found
    found = max(DELIMITERS, key=lambda delimiter: _rate(lines, delimiter))
    return found if _rate(lines, found) > 0 else ","


def _rate(lines: Sequence[str], delimiter: str) -> float:
    """Return how well ``delimiter`` parts the lines with numbers, from 0 to 1.

    That is the part of them that has as many fields as most, times the part of numbers and
    missing samples among their fields; 0 if most have a single field.
    """
    tail = lines[len(lines) // 2 :] if len(lines) > FEW else lines
    rows = [row for row in (tolerant(line, delimiter) for line in tail) if has_number(row)]
    if not rows:
        return 0.0
    width, count = Counter(len(row) for row in rows).most_common(1)[0]
    fields = [text for row in rows for text in row]
    numbers = sum(is_numeral(text) or is_missing(text) for text in fields)
    return count / len(rows) * numbers / len(fields) if width > 1 else 0.0


def tolerant(line: str, delimiter: str) -> list[str]:
    """Return the fields of ``line``; a line that is no row, as above a table, is one field."""
    try:
        return next(split([line], delimiter)) or [line]
    except InputError:
        return [line]


def has_number(row: Sequence[str]) -> bool:
    """Tell whether a field of ``row``, no comment, is a number, whatever its decimal mark."""
    if not row or row[0].startswith(COMMENTS):
        return False
    return any(is_numeral(text) for text in row)


def find_decimal(rows: Sequence[Sequence[str]], delimiter: str, stated: str | None) -> str:
    """Return the decimal mark of the fields in ``rows``, "." or ",".

    InputError if fields have different ones, or if the mark stated is the delimiter.
    """
    if stated is not None:
        if stated not in DECIMALS or DECIMALS[stated] == delimiter:
            raise InputError(f"decimal = {stated!r}; give point or comma, other than the delimiter")
        return DECIMALS[stated]
    if delimiter == ",":
        return "."
    fields = [text for row in rows for text in row if not is_missing(text)]
    commas = [text for text in fields if "," in text and is_number(text, ",")]
    points = [text for text in fields if "." in text and is_number(text)]
    if commas and points:
        raise InputError(
            f"numbers such as {commas[0]!r} and {points[0]!r}; write one decimal mark only, "
            "or state decimal in the map"
        )
    return "," if commas else "."
