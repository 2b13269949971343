"""HDF5 files: NetCDF 4, MATLAB 7.3 and those of many loggers.

One-dimensional datasets are columns, those of two dimensions one for each of up to 64 columns,
compound ones one for each field. Those of one group with one length and one clock are a stream.
The clock of a dataset is the first of: its attributes `rate_hz` (or `sampling_rate`, `fs`, `dt`)
and `start_s`; a dataset of its length in the group that is named like time, or that the option
`time` names; its dimension scale; the attributes of the group, or single values in it.
`unit` or `units`, `_FillValue`, `scale_factor` and `add_offset` mean what they do in CF.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, NativeFile, Rows, Stream
from floatref_adapters.hdf5_series import ROWS, Held, Series, chosen
from floatref_adapters.hdf5_streams import Table, tables_of
from floatref_adapters.hdf5_tree import opened, text_of, tree_of
from floatref_adapters.refusals import naming

SIGNATURE = b"\x89HDF\r\n\x1a\n"
OFFSETS = (0, 512, 1024, 2048, 4096, 8192)
"""Where the signature may be: what comes before it is for other programs."""


class Hdf5:
    """The adapter of HDF5 files."""

    name = "hdf5"
    summary = "HDF5, NetCDF 4 and MATLAB 7.3"

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` has the signature of an HDF5 file."""
        try:
            with source.open("rb") as stream:
                start = stream.read(OFFSETS[-1] + len(SIGNATURE))
        except OSError:
            return False
        return any(start.startswith(SIGNATURE, offset) for offset in OFFSETS)

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return the datasets of each group and clock; InputError if the file cannot be used.

        ``options`` are `time`, the name of a dataset or its path, and `epoch`.
        """
        if not source.is_file():
            raise InputError(f"{source}: not a file; give an HDF5 file")
        with naming(source), opened(source) as file:
            tree = tree_of(file)
            tables, told = tables_of(tree, options)
        if not tables:
            raise InputError(f"{source}: holds no datasets of two samples or more")
        return NativeFile(
            tuple(
                Stream(
                    table.name,
                    tuple(series.column for series in table.series),
                    table.count,
                    table.clock,
                    _Reader(source, table),
                )
                for table in tables
            ),
            (*(f"{count} {kind}: left alone" for kind, count in tree.left.items()), *told),
            text_of(tree.attributes.get("vendor", "")),
            text_of(tree.attributes.get("model", "")),
        )


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
        with opened(self.path) as file:
            held = _held(file, [*wanted.values(), *([self.table.time] if self.table.time else [])])
            for first in range(0, self.table.count if held else 0, ROWS):
                stop = min(first + ROWS, self.table.count)
                values = {
                    name: _samples(series, held[series.dataset.path], first, stop)
                    for name, series in wanted.items()
                }
                time = self.table.time
                yield Rows(
                    values,
                    _ticks(time, held[time.dataset.path], first, stop) if time else None,
                )


def _held(file: Any, wanted: Sequence[Series]) -> dict[str, Held]:
    """Return the opened datasets of the series ``wanted``, each once."""
    by_dataset: dict[str, list[Series]] = {}
    for series in wanted:
        by_dataset.setdefault(series.dataset.path, []).append(series)
    return {path: Held(file[path], several) for path, several in by_dataset.items()}


def _samples(series: Series, held: Held, first: int, stop: int) -> NDArray[np.float64]:
    values = series.samples(chosen(series, held.rows(first, stop)))
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
    raw = chosen(time, held.rows(first, stop))
    if raw.size and int(raw.max()) > np.iinfo(np.int64).max:
        raise InputError(f"{time.dataset.path}: time {int(raw.max())}; it is beyond 64 bits")
    ticks: NDArray[np.int64] = raw.astype(np.int64)
    return ticks


__all__ = ["Hdf5"]
