"""Record batches of an Arrow IPC file or stream, seen through a map of the file.

A file is a stream between two magic words and a list of its batches; it is read as the stream,
so that one which was cut short still gives its whole batches.
"""

import mmap
import struct
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from floatref import InputError
from floatref_adapters.libraries import library

ROWS = 1 << 16
MAGIC = b"ARROW1"
MOST_COMPRESSED = 1 << 25
"""Rows of a compressed batch, which has to be unpacked as a whole."""
_LENGTH, _COMPRESSION = 4, 10
"""Where the table of a record batch tells its length and compression, in its list of fields."""


class IpcSource:
    """The whole record batches of an IPC file or stream."""

    def __init__(self, path: Path) -> None:
        """Count the batches of the file at ``path``; none of their columns is touched."""
        self._path, self._arrow = path, library("pyarrow", "reading Arrow")
        self.told: tuple[str, ...] = ()
        self.rows = self._batches = 0
        with self._mapped() as (buffer, _):
            with self._arrow.ipc.open_stream(self._arrow.BufferReader(buffer)) as opened:
                self.schema = opened.schema
            self._count(buffer)

    def _count(self, buffer: Any) -> None:
        try:
            for message in self._arrow.ipc.MessageReader.open_stream(
                self._arrow.BufferReader(buffer)
            ):
                if message.type == "record batch":
                    self.rows += _rows(bytes(message.metadata))
                    self._batches += 1
        except (self._arrow.ArrowInvalid, OSError) as error:
            if not self._batches:
                raise
            self.told = (f"behind row {self.rows}: {str(error)[:80]}; the file was cut short",)

    def arrays(self, places: Sequence[int]) -> Iterator[list[Any]]:
        """Yield the columns at ``places``, ascending, at most `ROWS` rows of them at once."""
        options = self._arrow.ipc.IpcReadOptions(included_fields=list(places), use_threads=False)
        with self._mapped() as (buffer, mapped):
            reader = self._arrow.ipc.open_stream(self._arrow.BufferReader(buffer), options=options)
            for _ in range(self._batches):
                batch = reader.read_next_batch()
                batch.validate()
                for first in range(0, batch.num_rows, ROWS):
                    yield batch.slice(first, ROWS).columns
                    _let_go(mapped)

    @contextmanager
    def _mapped(self) -> Iterator[tuple[Any, mmap.mmap]]:
        """Yield the bytes of the stream, and the map that they are seen through."""
        with self._path.open("rb") as stream:
            mapped = mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ)
        try:
            yield self._arrow.py_buffer(mapped).slice(8 if mapped[:6] == MAGIC else 0), mapped
        finally:
            # Arrays that are still in use keep the map open until they are gone.
            with suppress(BufferError):
                mapped.close()


def _let_go(mapped: mmap.mmap) -> None:
    """Give back the memory of the pages that were read; they are still in the file."""
    if hasattr(mmap, "MADV_DONTNEED"):
        mapped.madvise(mmap.MADV_DONTNEED)


def _rows(message: bytes) -> int:
    """Return the length of the record batch whose metadata, a flatbuffer, is ``message``.

    InputError if it is compressed and too long to be unpacked.
    """
    try:
        root = struct.unpack_from("<i", message)[0]
        header = root + _place(message, root, 8)
        table = header + struct.unpack_from("<i", message, header)[0]
        at = _place(message, table, _LENGTH)
        length = struct.unpack_from("<q", message, table + at)[0] if at else 0
        packed = _place(message, table, _COMPRESSION) != 0
    except struct.error as error:
        raise InputError("a record batch without its length; copy the file again") from error
    if length < 0 or (packed and length > MOST_COMPRESSED):
        raise InputError(
            f"a compressed batch of {length} rows; write batches of at most {MOST_COMPRESSED}"
        )
    return int(length)


def _place(message: bytes, table: int, field: int) -> int:
    """Return where ``field`` of a flatbuffer's ``table`` is, 0 if it has none."""
    fields = table - struct.unpack_from("<i", message, table)[0]
    if field >= struct.unpack_from("<H", message, fields)[0]:
        return 0
    return int(struct.unpack_from("<H", message, fields + field)[0])


__all__ = ["IpcSource"]
