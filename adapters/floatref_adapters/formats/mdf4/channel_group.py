"""A channel group of an MDF 4 file and its records."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from floatref_adapters.formats.mdf4.data_blocks import Bytes, parts_of, pieces_of, rows_of
from floatref_adapters.formats.mdf4.expansion import Part
from floatref_adapters.formats.mdf4.record_fields import Field
from floatref_adapters.shared.piece_rows import MOST_ROWS

PIECE_BYTES = 1 << 23


@dataclass(frozen=True, eq=False)
class Group:
    """A channel group of a file: its records and what is in them; ``origin`` is asammdf's."""

    source: Path
    mdf: Any
    origin: Any
    name: str

    @property
    def width(self) -> int:
        """Bytes of a record, without its number but with the marks of invalid values."""
        made = self.origin.channel_group
        return int(made.samples_byte_nr + made.invalidation_bytes_nr)

    @property
    def arranged(self) -> bool:
        """Whether asammdf has sorted its records, or finished what the recorder had not."""
        return bool(self.origin.data_group.record_id_len) or Path(self.mdf.name) != self.source

    def field(self, index: int) -> Field:
        """Return channel ``index``."""
        made = self.origin.channel_group
        channel = self.origin.channels[index]
        return Field(channel, made.samples_byte_nr, made.invalidation_bytes_nr)

    def parts(self) -> list[Part]:
        """Return the parts of its data; of no use where asammdf has arranged them."""
        with self.source.open("rb") as file:
            size = file.seek(0, 2)
            return parts_of(file, self.origin.data_group.data_block_addr, size)

    def held(self) -> int:
        """Return how many records there are."""
        if self.arranged:
            stored = sum(block.original_size for block in self.origin.get_data_blocks())
        else:
            stored = sum(part.bytes for part in self.parts())
        return int(stored) // self.width

    def records(self, count: int) -> Iterator[tuple[int, Bytes]]:
        """Yield the first ``count`` records in pieces, each with the number of its first."""
        rows = min(max(PIECE_BYTES // self.width, 1), MOST_ROWS)
        first = 0
        for piece in rows_of(self._pieces(rows), self.width, rows):
            piece = piece[: count - first]
            if not len(piece):
                return
            yield first, piece
            first += len(piece)

    def _pieces(self, rows: int) -> Iterator[bytes]:
        if not self.arranged:
            with self.source.open("rb") as file:
                yield from pieces_of(file, self.parts())
            return
        self.origin.read_split_count = rows
        for fragment in self.mdf._mdf._load_data(self.origin):
            yield fragment.data
