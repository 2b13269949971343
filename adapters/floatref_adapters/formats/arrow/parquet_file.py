"""Columns of a Parquet file, a piece of a row group at a time."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from floatref import InputError, check_file, open_bytes
from floatref_adapters.formats.arrow.parquet_pages import check_pages
from floatref_adapters.shared.refusals import library
from floatref_adapters.shared.row_pieces import count_piece_rows

BUFFER = 1 << 20
"""Bytes of a column chunk that are read at once, however long it is."""


def count_rows(footer: Any) -> int:
    """Return the rows of a file; InputError unless its row groups have as many as it says."""
    held = sum(footer.row_group(group).num_rows for group in range(footer.num_row_groups))
    if held != footer.num_rows:
        raise InputError(
            f"the footer counts {footer.num_rows} rows, its row groups hold {held}; copy the "
            "complete file"
        )
    return int(held)


def all_batches(file: Any, rows: int, columns: Sequence[str]) -> Iterator[Any]:
    """Yield ``columns`` of an opened file, up to ``rows`` rows at a time.

    pyarrow ends silently where a column holds fewer values than its row group counts; this
    raises InputError behind them.
    """
    expected, found = count_rows(file.metadata), 0
    for batch in file.iter_batches(rows, columns=list(columns), use_threads=False):
        found += batch.num_rows
        yield batch
    if found != expected:
        raise InputError(
            f"the footer counts {expected} rows, its columns hold {found}; copy the complete file"
        )


class ParquetSource:
    """An opened Parquet file; it is opened again for every pass."""

    warnings: tuple[str, ...] = ()

    def __init__(self, path: Path) -> None:
        """Read the footer of the file at ``path``."""
        self._path = path
        with self._open() as opened:
            self.schema = opened.schema_arrow
            self.rows = count_rows(opened.metadata)

    def arrays(self, places: Sequence[int]) -> Iterator[list[Any]]:
        """Yield the columns at ``places``, ascending, a piece of their rows at a time."""
        names = self.schema.names
        wanted = [names[place] for place in places]
        # A name can be that of several columns: all of them are read, in the order of the file.
        turns = [names[:place].count(names[place]) for place in places]
        rows = count_piece_rows(len(places))
        with self._open() as opened:
            with open_bytes(self._path) as file:
                check_pages(file, wanted)
            for batch in all_batches(opened, rows, wanted):
                found = batch.schema.get_all_field_indices
                yield [
                    batch.column(found(name)[turn])
                    for name, turn in zip(wanted, turns, strict=True)
                ]

    def _open(self) -> Any:
        return library("pyarrow.parquet", "reading Parquet").ParquetFile(
            check_file(self._path),
            buffer_size=BUFFER,
            pre_buffer=False,
            page_checksum_verification=True,
        )
