"""Parquet files, and Arrow IPC files and streams (Feather version 2 is such a file).

The schema states the columns and their clocks, see `arrow_schema`. The clock of a
column that states no clock is the column that is named like time, that the option `time` names,
or the first of a temporal type: its integers are ticks. A time zone makes them UTC; without one
they are the logger's own unless the option `epoch` says what they count from.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, NativeFile, Rows, Stream, read_start
from floatref_adapters.formats.arrow.arrow_schema import (
    Table,
    decode_text,
    find_tables,
    is_temporal,
)
from floatref_adapters.formats.arrow.parquet_footer import MARK, holds_profile
from floatref_adapters.shared.refusals import library, prefix_errors
from floatref_adapters.shared.row_pieces import keep_freed_memory

CONTINUED = b"\xff\xff\xff\xff"
"""How an IPC stream begins."""
ENCRYPTED = b"PARE"
"""How a Parquet file begins whose footer is encrypted."""


class Source(Protocol):
    """A file of Arrow columns."""

    schema: Any
    rows: int
    warnings: tuple[str, ...]

    def arrays(self, places: Sequence[int]) -> Iterator[list[Any]]:
        """Yield the columns at ``places``, as many rows at once as `rows_for` says."""


class Parquet:
    """The adapter of Parquet files."""

    name = "parquet"
    summary = "Apache Parquet, with times as a column or a rate as metadata"

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` begins as a Parquet file does, and is no profile."""
        start = _start(source)
        return start.startswith(ENCRYPTED) or (start.startswith(MARK) and not holds_profile(source))

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return the columns of each clock; InputError if the file cannot be used.

        ``options`` are `time` and `epoch`.
        """
        return _streams(source, options, "Parquet", _open_parquet)


class ArrowIpc:
    """The adapter of Arrow IPC files and streams."""

    name = "arrow"
    summary = "Arrow IPC file or stream, Feather version 2"

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` begins as an IPC file, or is a stream with a suffix of one."""
        start = _start(source)
        streamed = source.suffix.lower() in (".arrow", ".arrows", ".ipc", ".feather")
        return start.startswith(b"ARROW1") or (streamed and start.startswith(CONTINUED))

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return the columns of each clock; InputError if the file cannot be used.

        ``options`` are `time` and `epoch`. Of a file that was cut short the whole batches are read.
        """
        return _streams(source, options, "Arrow", _open_ipc)


def _open_parquet(source: Path) -> Source:
    from floatref_adapters.formats.arrow.parquet_file import ParquetSource

    return ParquetSource(source)


def _open_ipc(source: Path) -> Source:
    from floatref_adapters.formats.arrow.ipc_batches import IpcSource

    return IpcSource(source)


def _start(source: Path) -> bytes:
    return read_start(source, 8)


def _streams(
    source: Path, options: Mapping[str, str], kind: str, open_source: Callable[[Path], Source]
) -> NativeFile:
    if not source.is_file():
        raise InputError(f"{source}: not a file; give a file of {kind}")
    with prefix_errors(source), _reading(kind):
        opened = open_source(source)
        tables, warnings = find_tables(opened.schema, opened.rows, options)
        stated = decode_text(opened.schema.metadata)
    if not tables:
        raise InputError(f"{source}: holds no columns beside that of time; give another file")
    return NativeFile(
        tuple(
            Stream(
                table.name,
                tuple(field.column for field in table.fields),
                table.count,
                table.clock,
                _Reader(kind, opened, table),
            )
            for table in tables
        ),
        (*opened.warnings, *warnings),
        stated.get("vendor", ""),
        stated.get("model", ""),
    )


@dataclass(frozen=True, eq=False)
class _Reader:
    """Reads columns of one table, as `Stream.read` does."""

    kind: str
    source: Source
    table: Table

    def __call__(self, names: Sequence[str]) -> Iterator[Rows]:
        """Yield the rows of the columns ``names``."""
        places = {f.column.name: f.index for f in self.table.fields if f.column.numeric}
        for name in names:
            if name not in places:
                raise InputError(f"{name}: no such column of numbers")
        time = [] if self.table.time is None else [self.table.time]
        wanted = sorted({places[name] for name in names}.union(time))
        first = 0
        keep_freed_memory()
        with _reading(self.kind):
            for arrays in self.source.arrays(wanted) if wanted else ():
                count = min(len(arrays[0]), self.table.count - first)
                found = {k: a.slice(0, count) for k, a in zip(wanted, arrays, strict=True)}
                ticks = None if not time else _ticks(found[time[0]], first)
                yield Rows({name: _samples(found[places[name]]) for name in names}, ticks)
                first += count
                if first == self.table.count:
                    return


def _samples(array: Any) -> NDArray[np.float64]:
    """Return an Arrow array as float64, nulls as NaN."""
    pa = library("pyarrow", "reading Arrow")
    array = _decode(array)
    found: NDArray[np.float64] = array.cast(pa.float64(), safe=False).to_numpy(zero_copy_only=False)
    # What is read from a mapped file must outlive the map.
    return np.array(found)


def _decode(array: Any) -> Any:
    """Return the numbers that are meant where an Arrow array holds places in a dictionary."""
    if not library("pyarrow.types", "reading Arrow").is_dictionary(array.type):
        return array
    # A place beyond the dictionary would be read from where nothing is.
    array.validate(full=True)
    return array.dictionary_decode()


def _ticks(array: Any, first: int) -> NDArray[np.int64] | NDArray[np.float64]:
    """Return the times in an Arrow array, integers where it has integers."""
    pa = library("pyarrow", "reading Arrow")
    array = _decode(array)
    if array.null_count:
        row = first + int(np.argmax(array.is_null().to_numpy(zero_copy_only=False)))
        raise InputError(f"row {row}: its time is missing; every row needs its time")
    if is_temporal(array.type):
        array = array.view(pa.int64() if array.type.bit_width == 64 else pa.int32())
    if pa.types.is_integer(array.type):
        ticks: NDArray[np.int64] = np.array(array.cast(pa.int64()).to_numpy(zero_copy_only=False))
        return ticks
    times = _samples(array)
    if not np.isfinite(times).all():
        row = first + int(np.argmin(np.isfinite(times)))
        raise InputError(f"row {row}: its time is {times[row - first]}; every row needs its time")
    return times


@contextmanager
def _reading(kind: str) -> Iterator[None]:
    """Turn what goes wrong in reading a file into one line."""
    pa = library("pyarrow", f"reading {kind}")
    try:
        yield
    except InputError:
        raise
    except (pa.ArrowMemoryError, MemoryError) as error:
        raise InputError("more than the memory holds; write smaller batches") from error
    except (pa.ArrowException, OSError, ValueError, TypeError, LookupError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        crypt = re.search("decrypt|encrypt", reason, re.IGNORECASE)
        advice = "write it without encryption" if crypt else "copy the complete file again"
        raise InputError(f"no sound {kind} ({reason[:120]}); {advice}") from error


__all__ = ["ArrowIpc", "Parquet", "Source"]
