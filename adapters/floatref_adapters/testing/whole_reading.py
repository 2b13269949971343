"""What a native adapter delivers, read as a whole, for tests."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, NativeFile, Stream

Table = dict[str, NDArray[np.float64]]
Whole = tuple[Table, Any]
"""All numbers of a stream by column, and its ticks; None where its clock is uniform."""


class Opener(Protocol):
    """A native adapter."""

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return what ``source`` holds."""


def stream_of(file: NativeFile, name: str) -> Stream:
    """Return the stream ``name`` of ``file``; KeyError if it is missing."""
    return {stream.name: stream for stream in file.streams}[name]


def table_of(stream: Stream) -> tuple[Table, NDArray[np.int64]]:
    """Return every column of ``stream`` that holds numbers, and the integer ticks, of all rows."""
    names = [column.name for column in stream.columns if column.numeric]
    parts = list(stream.read(names))
    ticks = [np.zeros(0, np.int64), *(np.asarray(p.ticks, np.int64) for p in parts)]
    none = np.zeros(0)
    values = {name: np.concatenate([none, *(p.values[name] for p in parts)]) for name in names}
    return values, np.concatenate(ticks)


def whole(stream: Stream) -> Whole:
    """Return every column of ``stream`` that holds numbers, and its ticks, of all rows."""
    numeric = [column.name for column in stream.columns if column.numeric]
    pieces = list(stream.read(numeric))
    values = {n: np.concatenate([p.values[n] for p in pieces] or [np.empty(0)]) for n in numeric}
    ticks = [piece.ticks for piece in pieces if piece.ticks is not None]
    return values, np.concatenate(ticks) if ticks else None


def read_whole(opener: Opener, source: Path) -> tuple[NativeFile, list[Whole]]:
    """Return what ``source`` holds, closed, and the numbers and ticks of every stream."""
    with opener.streams(source, {}) as native:
        return native, [whole(stream) for stream in native.streams]


def open_content(opener: Opener, source: Path, content: bytes | str, **options: str) -> NativeFile:
    """Write ``content`` to ``source`` and return what ``opener`` finds in it."""
    source.write_bytes(content if isinstance(content, bytes) else content.encode())
    return opener.streams(source, options)


def make_columns(native: NativeFile) -> dict[str, list[float]]:
    """Return the samples of every column of numbers of the only stream, by its name.

    AssertionError if a column has another count of rows than the stream says.
    """
    (stream,) = native.streams
    values, _ = whole(stream)
    lengths = {len(column) for column in values.values()}
    if lengths - {stream.count}:
        raise AssertionError(f"{stream.name}: {stream.count} rows declared, {lengths} read")
    return {name: column.tolist() for name, column in values.items()}


def ticks_of(native: NativeFile) -> NDArray[Any]:
    """Return the ticks of every row of the first stream; ValueError if it has no rows."""
    return np.concatenate([np.asarray(rows.ticks) for rows in native.streams[0].read([])])


def refusal(opener: Opener, source: Path) -> str:
    """Return why ``source`` is refused, in one line that names it; AssertionError otherwise."""
    try:
        read_whole(opener, source)
    except InputError as error:
        line = str(error)
    else:
        raise AssertionError(f"{source.name} is read")
    if "\n" in line or source.name not in line:
        raise AssertionError(f"not one line that names {source.name}: {line}")
    return line


def read_or_refused(opener: Opener, source: Path, options: Mapping[str, str]) -> bool:
    """Tell whether ``source`` was read; False if it was refused with InputError in one line.

    AssertionError if a stream has another count of rows than it says.
    """
    try:
        file = opener.streams(source, options)
    except InputError as error:
        if "\n" in str(error):
            raise AssertionError(f"more than a line: {error}") from error
        return False
    for stream in file.streams:
        values, ticks = table_of(stream)
        lengths = {len(ticks), *(len(column) for column in values.values())}
        if lengths != {stream.count}:
            raise AssertionError(f"{stream.name}: {stream.count} rows declared, {lengths} read")
    return True


__all__ = [
    "Opener",
    "Table",
    "Whole",
    "make_columns",
    "open_content",
    "read_or_refused",
    "read_whole",
    "refusal",
    "stream_of",
    "table_of",
    "ticks_of",
    "whole",
]
