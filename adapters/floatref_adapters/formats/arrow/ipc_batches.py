"""Record batches of an Arrow IPC file or stream, seen through a map of the file.

A file is a stream between two magic words and a list of its batches; it is read as the stream,
so that one which was cut short still gives its whole batches.
"""

import mmap
import struct
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from floatref import InputError, map_bytes
from floatref_adapters.shared.refusals import library
from floatref_adapters.shared.row_pieces import MOST_ROWS, count_piece_rows

MAGIC = b"ARROW1"
MOST_COMPRESSED, MOST_TOGETHER = 1 << 25, 1 << 26
"""Rows of a compressed batch, which has to be unpacked as a whole, and samples of all columns."""
MOST_UNPACKED = 1 << 27
"""Bytes of all compressed dictionaries of a file, which have to be kept."""
ALWAYS_UNPACKED, WIDEST, LARGEST_RATIO = 1 << 24, 16, 100
"""Bytes that a buffer may unpack to, whatever it is of; per row; and per byte that it has."""
_LENGTH, _BUFFERS, _COMPRESSION = 4, 8, 10
"""Where the table of a record batch tells these, in its list of fields."""
_DATA = 6
"""Where that of a dictionary tells the record batch with its values."""


class _Batch(NamedTuple):
    """Rows of a batch, whether it is compressed, and bytes if it is a compressed dictionary."""

    rows: int
    packed: bool
    bytes: int


class IpcSource:
    """The whole record batches of an IPC file or stream."""

    def __init__(self, path: Path) -> None:
        """Count the batches of the file at ``path``; their columns are not touched."""
        self._path, self._arrow = path, library("pyarrow", "reading Arrow")
        self.warnings: tuple[str, ...] = ()
        self.rows = self._batches = self._packed = self._kept = 0
        with self._map_bytes() as (buffer, _):
            with self._arrow.ipc.open_stream(self._arrow.BufferReader(buffer)) as opened:
                self.schema = opened.schema
            self._count(buffer)

    def _count(self, buffer: Any) -> None:
        try:
            for message in self._arrow.ipc.MessageReader.open_stream(
                self._arrow.BufferReader(buffer)
            ):
                self._add(message)
        except (self._arrow.ArrowInvalid, OSError) as error:
            if not self._batches:
                raise
            self.warnings = (f"behind row {self.rows}: {str(error)[:80]}; the file was cut short",)

    def _add(self, message: Any) -> None:
        """Take the next batch or dictionary into account."""
        dictionary = message.type == "dictionary"
        if message.type not in ("dictionary", "record batch"):
            return
        batch = _check(bytes(message.metadata), message.body, dictionary)
        self._kept += batch.bytes
        if self._kept > MOST_UNPACKED:
            raise InputError(f"compressed dictionaries of {self._kept} bytes; write plain columns")
        if not dictionary:
            self.rows, self._batches = self.rows + batch.rows, self._batches + 1
            self._packed = max(self._packed, batch.rows if batch.packed else 0)

    def arrays(self, places: Sequence[int]) -> Iterator[list[Any]]:
        """Yield the columns at ``places``, ascending, a piece of their rows at a time."""
        if self._packed * len(places) > MOST_TOGETHER:
            raise InputError(
                f"compressed batches of {self._packed} rows for {len(places)} columns at once; "
                f"write batches of at most {MOST_ROWS} rows"
            )
        options = self._arrow.ipc.IpcReadOptions(included_fields=list(places), use_threads=False)
        rows = count_piece_rows(len(places))
        with self._map_bytes() as (buffer, mapped):
            reader = self._arrow.ipc.open_stream(self._arrow.BufferReader(buffer), options=options)
            for _ in range(self._batches):
                batch = reader.read_next_batch()
                batch.validate()
                for first in range(0, batch.num_rows, rows):
                    yield batch.slice(first, rows).columns
                    _let_go(mapped)

    @contextmanager
    def _map_bytes(self) -> Iterator[tuple[Any, mmap.mmap]]:
        """Yield the bytes of the stream, and the map that they are seen through."""
        content = map_bytes(self._path)
        mapped = content.base
        assert isinstance(mapped, mmap.mmap)
        # Arrays that are still in use keep the map open until they are gone.
        yield self._arrow.py_buffer(content).slice(8 if mapped[:6] == MAGIC else 0), mapped


def _let_go(mapped: mmap.mmap) -> None:
    """Give back the memory of the pages that were read; they are still in the file."""
    if hasattr(mmap, "MADV_DONTNEED"):
        mapped.madvise(mmap.MADV_DONTNEED)


def _check(message: bytes, body: Any, dictionary: bool) -> _Batch:
    """Return what the metadata of a batch or a dictionary, a flatbuffer, say of it.

    InputError if they are unsound, or it is too long to be unpacked.
    """
    try:
        table = _table(message, struct.unpack_from("<i", message)[0], 8)
        table = _table(message, table, _DATA) if dictionary else table
        at = _place(message, table, _LENGTH)
        rows = struct.unpack_from("<q", message, table + at)[0] if at else 0
        packed = _place(message, table, _COMPRESSION) != 0
        sizes = list(_measure_unpacked(message, table, body)) if packed else []
    except struct.error as error:
        raise InputError("a record batch without its length; copy the file again") from error
    if rows < 0 or (packed and rows > MOST_COMPRESSED):
        raise InputError(
            f"a compressed batch of {rows} rows; write batches of at most {MOST_COMPRESSED}"
        )
    kept = sum(unpacked for _, unpacked in sizes) if dictionary else 0
    # What is too much in any case has another remedy than a damaged length.
    if kept <= MOST_UNPACKED:
        _check_buffers(sizes, rows)
    return _Batch(rows, packed, kept)


def _check_buffers(sizes: Iterable[tuple[int, int]], rows: int) -> None:
    """Raise InputError for a buffer that says it unpacks to more than its rows or bytes can be."""
    for stored, unpacked in sizes:
        if unpacked > max(ALWAYS_UNPACKED, WIDEST * rows, LARGEST_RATIO * stored):
            raise InputError(
                f"a buffer of {stored} bytes that unpacks to {unpacked}, in a batch of {rows} "
                "rows; copy the complete file again"
            )


def _measure_unpacked(message: bytes, table: int, body: Any) -> Iterator[tuple[int, int]]:
    """Yield the bytes of each buffer of a compressed batch, and those when it is unpacked."""
    vector = table + _place(message, table, _BUFFERS)
    vector += struct.unpack_from("<I", message, vector)[0]
    for k in range(struct.unpack_from("<I", message, vector)[0]):
        start, length = struct.unpack_from("<qq", message, vector + 4 + 16 * k)
        if length >= 8:
            size = struct.unpack_from("<q", body, start)[0]
            yield length, (length if size < 0 else size)


def _table(message: bytes, table: int, field: int) -> int:
    """Return where the table is that ``field`` of a flatbuffer's ``table`` leads to."""
    at = table + _place(message, table, field)
    return int(at + struct.unpack_from("<i", message, at)[0])


def _place(message: bytes, table: int, field: int) -> int:
    """Return where ``field`` of a flatbuffer's ``table`` is, 0 if it is missing."""
    fields = table - struct.unpack_from("<i", message, table)[0]
    if field >= struct.unpack_from("<H", message, fields)[0]:
        return 0
    return int(struct.unpack_from("<H", message, fields + field)[0])
