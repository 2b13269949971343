"""A channel group of an MDF 4 file and its records, in pieces.

Records of a sorted file are read by `data_blocks`. Those that asammdf has sorted itself, into a
temporary file of its own, come through `MDF.select`, which streams from there. Of an unfinished
recording asammdf says where the records are, in a copy that it has made.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, BinaryIO, Protocol

import numpy as np

from floatref import open_bytes
from floatref_adapters.formats.mdf4.data_blocks import (
    Bytes,
    Part,
    find_parts,
    read_parts,
    split_records,
)
from floatref_adapters.formats.mdf4.mdf_opening import OpenedMdf
from floatref_adapters.formats.mdf4.record_fields import Field, Marks, Numbers
from floatref_adapters.shared.row_pieces import MOST_ROWS

PIECE_BYTES = 1 << 23
METHODS = (None, 0, 1, 4, 5, 2, 3)
"""Of compression, by the types of block in asammdf."""


class Piece(Protocol):
    """Successive records of a group."""

    @property
    def count(self) -> int:
        """How many records there are."""

    def read(self, field: Field) -> tuple[Numbers, Marks | None]:
        """Return the stored numbers of ``field``, and which are marked invalid, if it has marks."""


@dataclass(frozen=True, eq=False)
class RecordPiece:
    """Records as bytes; the first is record ``first`` of the group."""

    first: int
    rows: Bytes

    @property
    def count(self) -> int:
        """How many records there are."""
        return len(self.rows)

    def read(self, field: Field) -> tuple[Numbers, Marks | None]:
        """Return the stored numbers of ``field``, and which are marked invalid, if it has marks."""
        if field.virtual:
            return _count_records(self), field.read_marks(self.rows)
        return field.read(self.rows), field.read_marks(self.rows)


@dataclass(frozen=True, eq=False)
class SelectedPiece:
    """Records as asammdf's signals by the numbers of their channels."""

    first: int
    count: int
    signals: Mapping[int, Any]

    def read(self, field: Field) -> tuple[Numbers, Marks | None]:
        """Return the stored numbers of ``field``, and which are marked invalid, if it has marks."""
        signal = self.signals[field.index]
        marks = signal.invalidation_bits
        raw = _count_records(self) if field.virtual else np.asarray(signal.samples)
        return raw, None if marks is None else np.asarray(marks, np.bool_)


def _count_records(piece: RecordPiece | SelectedPiece) -> Numbers:
    return np.arange(piece.first, piece.first + piece.count, dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Group:
    """Channel group ``number`` of an opened file and its records; ``origin`` is asammdf's."""

    opened: OpenedMdf
    number: int
    origin: Any
    name: str

    @property
    def width(self) -> int:
        """Bytes of a record, without its number but with the marks of invalid values."""
        made = self.origin.channel_group
        return int(made.samples_byte_nr + made.invalidation_bytes_nr)

    @property
    def mixed(self) -> bool:
        """Whether its records lie among those of other groups, so that asammdf sorts them."""
        return bool(self.origin.data_group.record_id_len)

    def field(self, index: int) -> Field:
        """Return channel ``index``."""
        made = self.origin.channel_group
        channel = self.origin.channels[index]
        return Field(index, channel, made.samples_byte_nr, made.invalidation_bytes_nr)

    def count_stored(self) -> int:
        """Return how many records the file holds."""
        if self.mixed:
            stored = sum(block.original_size for block in self.origin.get_data_blocks())
        else:
            with open_bytes(self.opened.records) as file:
                stored = sum(part.bytes for part in self._find_parts(file))
        return int(stored) // self.width

    def read(self, count: int, fields: Sequence[Field]) -> Iterator[Piece]:
        """Yield the first ``count`` records in pieces that have at least ``fields``."""
        rows = min(max(PIECE_BYTES // self.width, 1), MOST_ROWS)
        return self._select(count, rows, fields) if self.mixed else self._read(count, rows)

    def _read(self, count: int, rows: int) -> Iterator[Piece]:
        first = 0
        with open_bytes(self.opened.records) as file:
            parts = self._find_parts(file)
            for piece in split_records(read_parts(file, parts), self.width, rows):
                piece = piece[: count - first]
                if not len(piece):
                    return
                yield RecordPiece(first, piece)
                first += len(piece)

    def _find_parts(self, file: BinaryIO) -> list[Part]:
        if not self.opened.unfinished:
            return find_parts(file, self.origin.data_group.data_block_addr, file.seek(0, 2))
        return [
            Part(
                block.address,
                block.compressed_size,
                block.original_size,
                METHODS[block.block_type],
                block.param,
            )
            for block in self.origin.get_data_blocks()
        ]

    def _select(self, count: int, rows: int, fields: Sequence[Field]) -> Iterator[Piece]:
        indices = sorted({field.index for field in fields})
        wanted = [(None, self.number, index) for index in indices]
        for first in range(0, count, rows):
            held = min(rows, count - first)
            found = self.opened.mdf.select(
                wanted, record_offset=first, record_count=held, raw=True, copy_master=False
            )
            yield SelectedPiece(first, held, dict(zip(indices, found, strict=True)))
