"""HDF5 files read in this process: what is in them, and rows of it, through h5py."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, NativeFile, Rows, Stream
from floatref_adapters.formats.hdf5.clock_tables import Table, find_tables
from floatref_adapters.formats.hdf5.object_tree import decode_text, open_hdf5, read_tree
from floatref_adapters.formats.hdf5.series import MOST_HELD, Held, Series, choose
from floatref_adapters.shared.row_pieces import MOST_ROWS, count_piece_rows, keep_freed_memory


def native_file(source: Path, options: Mapping[str, str]) -> NativeFile:
    """Return the datasets of each group and clock; InputError if the file cannot be used."""
    with open_hdf5(source) as file:
        tree = read_tree(file)
        tables, warnings = find_tables(tree, options)
    if not tables:
        raise InputError("holds no datasets of two samples or more")
    streams = [
        Stream(
            table.name,
            tuple(series.column for series in table.series),
            table.count,
            table.clock,
            _Reader(source, table),
        )
        for table in tables
    ]
    return NativeFile(
        tuple(streams),
        (*(f"{count} {kind}: left alone" for kind, count in tree.left.items()), *warnings),
        decode_text(tree.attributes.get("vendor", "")),
        decode_text(tree.attributes.get("model", "")),
    )


def list_streams(source: Path, options: Mapping[str, str]) -> Iterator[NativeFile]:
    """Yield `native_file` once, with readers that read nothing, as another process takes it."""
    native = native_file(source, options)
    bare = [replace(stream, read=_read_nothing) for stream in native.streams]
    yield replace(native, streams=tuple(bare))


def read_stream(
    source: Path, options: Mapping[str, str], stream: int, names: Sequence[str]
) -> Iterator[Rows]:
    """Yield the rows of the columns ``names`` of one stream of `native_file`, by its number."""
    yield from native_file(source, options).streams[stream].read(names)


def _read_nothing(names: Sequence[str]) -> Iterator[Rows]:
    """Stand for the reader of a stream on its way to another process."""
    return iter(())


@dataclass(frozen=True, eq=False)
class _Reader:
    """Reads columns of one table, as `Stream.read` does."""

    path: Path
    table: Table

    def __call__(self, names: Sequence[str]) -> Iterator[Rows]:
        """Yield the rows of the columns ``names``."""
        named = {s.column.name: s for s in self.table.series if s.column.numeric}
        for name in names:
            if name not in named:
                raise InputError(f"{name}: no such column of numbers")
        wanted = {name: named[name] for name in names}
        keep_freed_memory()
        with open_hdf5(self.path) as file:
            time = self.table.time
            held = _open_datasets(file, [*wanted.values(), *([time] if time else [])])
            rows = min([MOST_ROWS, *(each.step for each in held.values())])
            for first in range(0, self.table.count if held else 0, rows):
                stop = min(first + rows, self.table.count)
                values = {
                    name: _samples(series, held[series.dataset.path], first, stop)
                    for name, series in wanted.items()
                }
                yield Rows(
                    values,
                    _ticks(time, held[time.dataset.path], first, stop) if time else None,
                )


def _open_datasets(file: Any, wanted: Sequence[Series]) -> dict[str, Held]:
    """Return the opened datasets of the series ``wanted``, each once; InputError for too much."""
    by_dataset: dict[str, list[Series]] = {}
    for series in wanted:
        by_dataset.setdefault(series.dataset.path, []).append(series)
    rows = count_piece_rows(len(wanted))
    held = {path: Held(file[path], several, rows) for path, several in by_dataset.items()}
    together = sum(each.bytes for each in held.values())
    if together > MOST_HELD:
        raise InputError(
            f"chunks of {together} bytes in {len(held)} datasets; repack them in smaller ones, "
            "as by h5repack -l CHUNK=65536"
        )
    return held


def _samples(series: Series, held: Held, first: int, stop: int) -> NDArray[np.float64]:
    values = series.samples(choose(series, held.rows(first, stop)))
    absent = held.absent(first, stop)
    if absent is not None:
        values[absent] = np.nan
    return values


def _ticks(
    time: Series, held: Held, first: int, stop: int
) -> NDArray[np.int64] | NDArray[np.float64]:
    """Return the times of rows, integers where the file has integers."""
    values = _samples(time, held, first, stop)
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        row = int(bad[0])
        raise InputError(
            f"{time.dataset.path}: time {first + row} is {values[row]}; every row needs its time"
        )
    if not time.integral:
        return values
    raw = choose(time, held.rows(first, stop))
    if raw.size and int(raw.max()) > np.iinfo(np.int64).max:
        raise InputError(f"{time.dataset.path}: time {int(raw.max())}; it is beyond 64 bits")
    ticks: NDArray[np.int64] = raw.astype(np.int64)
    return ticks
