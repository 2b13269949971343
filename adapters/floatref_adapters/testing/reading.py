"""What a native adapter delivers, read as a whole, for tests."""

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, NativeFile, Stream

Table = dict[str, NDArray[np.float64]]


class Opener(Protocol):
    """A native adapter."""

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return what ``source`` holds."""


def stream_of(file: NativeFile, name: str) -> Stream:
    """Return the stream ``name`` of ``file``; KeyError if there is none."""
    return {stream.name: stream for stream in file.streams}[name]


def table_of(stream: Stream) -> tuple[Table, NDArray[np.int64]]:
    """Return every column of ``stream`` that holds numbers, and the integer ticks, of all rows."""
    names = [column.name for column in stream.columns if column.numeric]
    parts = list(stream.read(names))
    ticks = [np.zeros(0, np.int64), *(np.asarray(p.ticks, np.int64) for p in parts)]
    none = np.zeros(0)
    values = {name: np.concatenate([none, *(p.values[name] for p in parts)]) for name in names}
    return values, np.concatenate(ticks)


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


__all__ = ["Opener", "Table", "read_or_refused", "stream_of", "table_of"]
