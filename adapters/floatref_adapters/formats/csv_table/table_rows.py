"""The rows of a table in pieces: fast where every field is plain, field by field where not."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floatref import InputError
from floatref_adapters.formats.csv_table.delimiters import COMMENTS
from floatref_adapters.formats.csv_table.field_grid import Grid
from floatref_adapters.formats.csv_table.table_fields import SPACES, numbers, split
from floatref_adapters.formats.csv_table.table_layout import Layout
from floatref_adapters.formats.csv_table.text_pieces import Block, blocks


@dataclass(frozen=True, eq=False)
class Piece:
    """Successive rows of a table, the first of them line ``first`` of the file."""

    layout: Layout
    first: int
    text: bytes

    @property
    def rows(self) -> int:
        """How many rows there are."""
        return self.text.count(b"\n")

    @cached_property
    def grid(self) -> Grid | None:
        """Return the fields as places, or None unless all rows are plain and of one width."""
        layout, text = self.layout, self.text
        if layout.trailing:
            mark = layout.delimiter.encode() + b"\n"
            if text.count(mark) != self.rows:
                return None
            text = text.replace(mark, b"\n")
        return Grid.of(text, len(layout.columns), layout.delimiter, layout.decimal)

    def fields(self) -> list[tuple[str, ...]]:
        """Return the fields by column; InputError for a row of another width."""
        encoding = "latin-1" if self.layout.encoding == "latin-1" else "utf-8"
        lines = self.text.decode(encoding, "replace").split("\n")[:-1]
        rows = []
        width = len(self.layout.columns)
        for number, line in enumerate(lines, self.first):
            try:
                row = next(split([line], self.layout.delimiter))
            except InputError as error:
                raise InputError(f"row {number}: {error}") from error
            if self.layout.trailing and len(row) > width and not row[-1]:
                row.pop()
            if len(row) != width:
                raise InputError(_other_width(number, line, len(row), width))
            rows.append(row)
        return list(zip(*rows, strict=True))

    def numbers(self, columns: Sequence[int]) -> NDArray[np.float64]:
        """Return the samples of ``columns``, ascending, of shape (rows, columns).

        InputError with the row, the column and the text if one is no number.
        """
        grid = self.grid
        found = grid.numbers(columns) if grid else None
        if found is not None:
            return found
        fields = self.fields()
        named = self.layout.columns
        parts = [
            numbers(fields[k], named[k].name, self.first, self.layout.decimal) for k in columns
        ]
        return np.stack(parts, axis=1) if parts else np.empty((self.rows, 0))

    def texts(self, column: int) -> Sequence[str]:
        """Return the fields of one column."""
        # Bytes beyond ASCII mean what the encoding says, which the fields know.
        grid = self.grid if self.text.isascii() else None
        return grid.texts(column) if grid else self.fields()[column]


def _other_width(number: int, line: str, width: int, expected: int) -> str:
    if line.startswith(COMMENTS):
        return f"row {number} is a remark, {line[:40]!r}; take it out"
    advice = "the file is truncated, or a line is empty"
    if width > expected:
        advice = "write decimal points, not decimal commas, and nothing behind the last field"
    return f"row {number} has {width} fields, the header {expected}; {advice}"


def pieces(path: Path, layout: Layout) -> Iterator[Piece]:
    """Yield the rows of the table at ``path``; those of a last line without an end come alone."""
    for first, text in blocks(path, layout.encoding, layout.delimiter):
        above = layout.above + 1 - first
        if above > 0:
            first, text = _below(above, first, text)
        if text:
            yield Piece(layout, first, text)


def _below(above: int, first: int, text: bytes) -> Block:
    """Return ``text`` without its first ``above`` lines."""
    at = 0
    for _ in range(above):
        at = text.find(b"\n", at) + 1
    return first + above, text[at:]


def is_cut_short(piece: Piece, before: bytes) -> bool:
    """Tell whether the last line, which has no end, was cut: fields or decimals are missing.

    ``before`` is the line before it.
    """
    delimiter = piece.layout.delimiter
    mark = None if delimiter == SPACES else delimiter.encode()
    fields, expected = piece.text.split(mark), before.split(mark)
    if not fields or len(fields) < len(expected):
        return bool(expected)
    if not expected:
        return False
    decimals = [line[-1].partition(piece.layout.decimal.encode())[2] for line in (fields, expected)]
    return len(decimals[0].strip()) < len(decimals[1].strip())
