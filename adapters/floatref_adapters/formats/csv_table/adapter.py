"""Tables as text: one row per sample, one column per quantity, and mostly one of time.

Delimiter, decimal mark, header and units are found from the first lines, or stated by the options
`delimiter` and `decimal`. The clock is a column that is named like time (`time_s`, `Time (ms)`,
`Zeit [s]`, `timestamp`) or that the option `time` names: numbers as integer ticks of their last
decimal, ISO 8601 or 22.11.2026 10:00:00 in ns UTC, or the time of a day in ns.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np

from floatref import InputError, NativeClock, NativeFile, Rows, Stream, read_start
from floatref_adapters.formats.csv_table.table_layout import Layout, find_layout
from floatref_adapters.formats.csv_table.table_rows import Piece, is_cut_short, pieces
from floatref_adapters.formats.csv_table.text_pieces import find_encoding
from floatref_adapters.formats.csv_table.written_times import Times, Writing, find_writing
from floatref_adapters.shared.refusals import prefix_errors
from floatref_adapters.shared.time_columns import UNKNOWN, of_epoch, time_column
from floatref_adapters.shared.time_texts import has_zone

SUFFIXES = (".csv", ".tsv", ".txt")
LISTED = 1024
"""Bytes by which a table is recognised."""
_OTHERS = re.compile(
    r"\s*(\$[A-Z]{2}|[#%][A-Z0-9]+,|ERDFILE|date \w+ |base (hex|dec)|[{\[]"
    r'|"?distance_m"?,.*_elevation_m|timestamp,arbitration_id,'
    r"|(?P<channel>[^\t\r\n]+?) *- *(?i:distance) *\([^()\t\r\n]*\) *\t[^\t\r\n]*(?P=channel))"
)
"""How NMEA, NovAtel ASCII, ERD, Vector ASC, JSON, our profiles, CSV of python-can and the profiles
of viewers begin."""


class CsvTable:
    """The adapter of such a table."""

    name = "csv"
    summary = "CSV and other tables of text: a column of time, and columns of samples"

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` is a .csv, .tsv or .txt file whose first lines are a table."""
        if source.suffix.lower() not in SUFFIXES or not source.is_file():
            return False
        start = read_start(source, LISTED)
        try:
            text = start.decode(find_encoding(start), "replace")
            if _OTHERS.match(text.removeprefix("\ufeff")):
                return False
            return len(find_layout(source, {}).columns) > 1
        except InputError:
            # A .csv that is not a table gets its error from reading it.
            return source.suffix.lower() != ".txt" and b"\0" not in start
        except OSError:
            return False

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return the one stream `table` of the file; InputError if it is no table.

        ``options`` are `time`, `epoch`, `delimiter` and `decimal`. The file is read once to count
        its rows and the decimals of their times.
        """
        if not source.is_file():
            raise InputError(f"{source}: not a file; give a table as text")
        with prefix_errors(source), _readable():
            layout = find_layout(source, options)
            times, warnings = _times(layout, options.get("time"))
            extent, times = _measure(source, layout, times)
            unknown = NativeClock(Fraction(1), name="unknown")
            clock = of_epoch(times.clock(), options) if times else unknown
        stream = Stream(
            "table",
            tuple(c for k, c in enumerate(layout.columns) if times is None or k != times.column),
            extent.rows,
            clock,
            _Reader(source, layout, times, extent),
        )
        return NativeFile((stream,), (*_list_warnings(layout, times, extent), *warnings))


@dataclass(frozen=True)
class _Extent:
    """How many rows there are, without a last line that was cut short."""

    rows: int
    cut: bool


@dataclass(frozen=True, eq=False)
class _Reader:
    """Reads columns of the table, as `Stream.read` does."""

    source: Path
    layout: Layout
    times: Times | None
    extent: _Extent

    def __call__(self, names: Sequence[str]) -> Iterator[Rows]:
        """Yield the rows of the columns ``names``."""
        places = {column.name: k for k, column in enumerate(self.layout.columns)}
        with _readable():
            for name in names:
                if name not in places:
                    raise InputError(f"{name}: no such column; there are {', '.join(places)}")
            columns = sorted({places[name] for name in names} | self._times())
            for piece in _complete(self.source, self.layout, self.extent.cut):
                values = np.ascontiguousarray(piece.numbers(columns).T)
                found = dict(zip(columns, values, strict=True))
                ticks = None
                if self.times:
                    ticks = self.times.ticks(piece, found.get(self.times.column))
                yield Rows({name: found[places[name]] for name in names}, ticks)

    def _times(self) -> set[int]:
        """Return the column of time if it holds numbers."""
        numbers = self.times and self.times.writing is Writing.NUMBER
        return {self.times.column} if self.times and numbers else set()


def _complete(source: Path, layout: Layout, cut: bool) -> Iterator[Piece]:
    """Yield the rows, those of a last line without an end too unless it was ``cut`` short."""
    for piece in pieces(source, layout):
        if piece.text.endswith(b"\n"):
            yield piece
        elif not cut:
            yield Piece(layout, piece.first, piece.text + b"\n")


def _measure(source: Path, layout: Layout, times: Times | None) -> tuple[_Extent, Times | None]:
    rows, cut, before = 0, False, b""
    for piece in pieces(source, layout):
        ended = piece.text.endswith(b"\n")
        if not ended:
            cut = bool(before) and is_cut_short(piece, before)
            piece = Piece(layout, piece.first, piece.text + b"\n")
        if ended or not cut:
            rows += piece.rows
            times = times.measure(piece) if times else None
        before = piece.text[:-1].rpartition(b"\n")[2]
    return _Extent(rows, cut), times


def _times(layout: Layout, option: str | None) -> tuple[Times | None, tuple[str, ...]]:
    """Return the column of time, and warnings about it."""
    found = time_column(layout.columns, option)
    if found is None:
        return None, (UNKNOWN,)
    column = layout.columns[found.index]
    texts = [row[found.index] for row in layout.body]
    writing = find_writing(texts, layout.decimal)
    if writing is None:
        if option is not None:
            raise InputError(f"time = {option!r}: holds {texts[0]!r}, no time; name another column")
        return None, (f"{column.name}: {texts[0][:40]!r} is no time that is read", UNKNOWN)
    warnings = found.list_others(layout.columns)
    if writing is Writing.ISO and not has_zone(texts[0]):
        warnings += (f"{column.name}: states no time zone; taken as UTC",)
    return Times(found.index, column.name, writing, found.unit_s, layout.decimal), warnings


def _list_warnings(layout: Layout, times: Times | None, extent: _Extent) -> tuple[str, ...]:
    warnings = []
    if layout.skipped:
        warnings.append(f"{layout.skipped} lines above the table: skipped")
    if extent.cut:
        warnings.append("1 row at the end, cut short: dropped")
    texts = sum(not c.numeric for k, c in enumerate(layout.columns) if not _is(times, k))
    if texts:
        warnings.append(f"{texts} columns of text: not read")
    return tuple(warnings)


def _is(times: Times | None, column: int) -> bool:
    return times is not None and times.column == column


@contextmanager
def _readable() -> Iterator[None]:
    """Turn a refusal of the operating system into one line."""
    try:
        yield
    except OSError as error:
        raise InputError(f"{error.strerror or error}; make the file readable") from error


__all__ = ["CsvTable"]
