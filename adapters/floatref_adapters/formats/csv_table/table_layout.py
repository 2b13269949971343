"""How a table is laid out: its delimiter, its decimal mark, its header, and where rows begin."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from floatref import Column, InputError
from floatref_adapters.formats.csv_table.column_names import is_unit_row, make_columns
from floatref_adapters.formats.csv_table.delimiters import (
    FEW,
    find_decimal,
    find_delimiter,
    has_number,
    tolerant,
)
from floatref_adapters.formats.csv_table.table_fields import (
    SPACES,
    is_missing,
    is_number,
    is_numeral,
)
from floatref_adapters.formats.csv_table.text_pieces import read_sample

BODY = 1000
"""Lines from which the columns are judged."""
LONGEST_QUOTE = 4
"""Lines that a quoted name may go over."""


@dataclass(frozen=True)
class Layout:
    """What the first lines of a table show.

    ``above`` lines come before the rows, ``skipped`` of them hold neither names nor units;
    ``trailing`` is a delimiter behind the last field of every row; ``body`` are fields of rows.
    """

    encoding: str
    delimiter: str
    decimal: str
    columns: tuple[Column, ...]
    above: int
    skipped: int
    trailing: bool
    body: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class _Lines:
    """The filled lines of the sample: their numbers and fields, and the width of a row."""

    numbers: list[int]
    fields: list[list[str]]
    width: int

    def rows(self) -> list[list[str]]:
        """Return the fields of those lines that are as wide as a row and hold a number."""
        return [
            fields for fields in self.fields if len(fields) == self.width and has_number(fields)
        ]


def find_layout(path: Path, options: Mapping[str, str]) -> Layout:
    """Return the layout of the table at ``path``.

    ``options`` may state `delimiter` and `decimal`. InputError if the first lines are not those
    of a table, or could be read in two ways.
    """
    encoding, sample = read_sample(path)
    filled = list(islice(_find_filled(sample), BODY))
    if not filled:
        raise InputError("holds no rows; copy the complete file")
    texts = [line for _, line in filled]
    delimiter = find_delimiter(texts, options.get("delimiter"))
    fields = [tolerant(text, delimiter) for text in texts]
    trailing = delimiter != SPACES and _has_trailing(fields)
    if trailing:
        fields = [row[:-1] if row and not row[-1] else row for row in fields]
    lines = _Lines([number for number, _ in filled], fields, _width(fields))
    decimal = find_decimal(lines.rows(), delimiter, options.get("decimal"))
    numeric = _numeric(lines.rows())
    first = _first_row(lines, numeric, decimal)
    names, units, used = _header(lines, first, numeric, decimal)
    _check_header(lines, first, used, delimiter, "delimiter" in options)
    return Layout(
        encoding,
        delimiter,
        decimal,
        make_columns(names, units, numeric),
        lines.numbers[first] - 1,
        first - used,
        trailing,
        tuple(tuple(row) for row in fields[first:] if len(row) == lines.width),
    )


def _find_filled(sample: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Yield the lines that hold anything with their numbers, one that a quote goes over as one."""
    held: list[str] = []
    for number, line in enumerate(sample, 1):
        held.append(line)
        closed = sum(text.count('"') for text in held) % 2 == 0
        if not closed and number < len(sample) and len(held) < LONGEST_QUOTE:
            continue
        first = number - len(held) + 1
        lines = [" ".join(held)] if closed else held
        yield from ((first + k, text) for k, text in enumerate(lines) if text.strip())
        held = []


def _has_trailing(fields: Sequence[Sequence[str]]) -> bool:
    """Tell whether every line of a row's width ends in a delimiter, that with the names too."""
    width = _width(fields)
    rows = [row for row in fields if len(row) >= width - 1]
    return width > 2 and all(not row[-1] or len(row) == width - 1 for row in rows)


def _width(fields: Sequence[Sequence[str]]) -> int:
    """Return how many fields most lines with a number have, the latter half of many lines."""
    tail = fields[len(fields) // 2 :] if len(fields) > FEW else fields
    rows = [row for row in tail if has_number(row)] or tail
    return Counter(len(row) for row in rows).most_common(1)[0][0]


def _numeric(rows: Sequence[Sequence[str]]) -> list[bool]:
    """Return for every column whether half of its samples are numbers, or all are missing."""
    found = []
    for texts in zip(*rows, strict=True):
        there = [text for text in texts if not is_missing(text)]
        found.append(2 * sum(is_numeral(text) for text in there) >= len(there))
    return found


def _first_row(lines: _Lines, numeric: Sequence[bool], decimal: str) -> int:
    """Return the index of the first row: the first without text in a column of numbers.

    Lines above it that are mostly numbers are rows as well, and will be refused as such.
    """
    clean = [k for k, row in enumerate(lines.fields) if _clean(row, numeric, decimal)] or [
        k for k, row in enumerate(lines.fields) if _numerals(row) * 2 >= len(row) > 0
    ]
    if not clean or not any(numeric):
        raise InputError("no rows of numbers below the header; copy the complete file")
    first = clean[0]
    while first and 2 * _numerals(lines.fields[first - 1]) >= len(lines.fields[first - 1]):
        first -= 1
    return first


def _clean(row: Sequence[str], numeric: Sequence[bool], decimal: str) -> bool:
    """Tell whether ``row`` has a number, and nothing else in the columns of numbers."""
    if len(row) != len(numeric):
        return False
    fields = [text for text, is_numeric in zip(row, numeric, strict=True) if is_numeric]
    there = [text for text in fields if not is_missing(text)]
    return bool(there) and all(is_number(text, decimal) for text in there)


def _numerals(row: Sequence[str]) -> int:
    return sum(is_numeral(text) for text in row)


def _header(
    lines: _Lines, first: int, numeric: Sequence[bool], decimal: str
) -> tuple[Sequence[str], Sequence[str], int]:
    """Return names, units, and how many lines above the first row they take."""
    nothing = [""] * lines.width

    def names_at(index: int) -> bool:
        row = lines.fields[index] if index >= 0 else []
        pairs = zip(row, numeric, strict=False)
        return len(row) == lines.width and not any(n and is_number(t, decimal) for t, n in pairs)

    if not names_at(first - 1):
        return nothing, nothing, 0
    above = lines.fields[first - 1]
    if is_unit_row(above) and names_at(first - 2):
        return lines.fields[first - 2], above, 2
    return above, nothing, 1


def _check_header(lines: _Lines, first: int, used: int, delimiter: str, stated: bool) -> None:
    """Refuse names that do not fit the rows, and rows of commas that may be decimal ones."""
    above = lines.fields[first - 1] if first and not used else []
    row = lines.fields[first]
    if len(above) > 1 and delimiter != SPACES:
        raise InputError(
            f"row {lines.numbers[first]} has {len(row)} fields, the header {len(above)}; "
            "write decimal points, not decimal commas, and a name for every column"
        )
    pairs = lines.width % 2 == 0 and delimiter == "," and not used and not stated
    if pairs and all(_halves(fields) for fields in lines.fields[first:]):
        text = ",".join(row[:2])
        raise InputError(
            f"row {lines.numbers[first]}: {text!r} may be two columns, or a number with a decimal "
            "comma; write decimal points or state the delimiter in the map"
        )


def _halves(row: Sequence[str]) -> bool:
    """Tell whether the fields may be whole numbers, each with the decimals behind it."""
    whole = all(text.lstrip("+-").isdigit() for text in row[::2])
    return whole and all(text.isdigit() for text in row[1::2])
