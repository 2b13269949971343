"""Columns of HDF5 datasets: which numbers of a dataset are a column, and reading them."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import Column, InputError
from floatref_adapters.formats.hdf5.object_tree import Dataset, decode_text
from floatref_adapters.shared.stated_clock import number

MOST_WIDE = 64
"""Columns of a table without names."""
LARGEST_CHUNK = 1 << 27
"""Bytes of a chunk, which has to be unpacked as a whole."""
MOST_HELD = 1 << 29
"""Bytes of all chunks that are unpacked at once."""


@dataclass(frozen=True, eq=False)
class Series:
    """A column: number ``place`` of a dataset, or its field ``part``; ``across`` if it is a row."""

    dataset: Dataset
    column: Column
    count: int
    place: int | None = None
    part: str | None = None
    across: bool = False

    @property
    def integral(self) -> bool:
        """Tell whether the file holds integers, without an offset."""
        kind = self.dataset.dtype[self.part] if self.part else self.dataset.dtype
        attributes = self.dataset.attributes
        return kind.kind in "iu" and not number(attributes.get("add_offset", 0))

    @property
    def scale(self) -> Fraction:
        """By what the numbers of the file are to be multiplied."""
        factor = number(self.dataset.attributes.get("scale_factor", 1))
        return factor if factor and factor > 0 else Fraction(1)

    def samples(self, raw: NDArray[Any]) -> NDArray[np.float64]:
        """Return what the numbers ``raw`` of the file stand for; missing ones are NaN."""
        attributes = self.dataset.attributes
        values = raw.astype(np.float64)
        for word in ("_FillValue", "missing_value"):
            fill = attributes.get(word)
            if fill is not None and np.size(fill) == 1 and np.asarray(fill).dtype.kind in "iuf":
                values[raw == np.asarray(fill).ravel()[0]] = np.nan
        factor, offset = (number(attributes.get(w)) for w in ("scale_factor", "add_offset"))
        if factor is not None:
            values *= float(factor)
        if offset is not None:
            values += float(offset)
        return values


def find_series(dataset: Dataset) -> tuple[Series, ...]:
    """Return the columns of ``dataset``; one that cannot be mapped for what holds no numbers."""
    if dataset.dtype is None or prod(dataset.shape) < 2:
        return ()
    rows, across, wide = _layout(dataset)
    unit = decode_text(dataset.attributes.get("unit", dataset.attributes.get("units", "")))
    note = _hindrance(dataset, wide)
    if note:
        return (Series(dataset, Column(dataset.name, unit, note, numeric=False), rows),)
    if dataset.dtype.names:
        return tuple(
            Series(
                dataset,
                Column(part, "", "" if numeric else str(kind)[:40], numeric),
                rows,
                part=part,
                across=across,
            )
            for part, kind in ((p, dataset.dtype[p]) for p in dataset.dtype.names)
            for numeric in (kind.kind in "iufb",)
        )
    if len(dataset.shape) == 1 or wide == 1:
        place = 0 if len(dataset.shape) == 2 else None
        return (Series(dataset, Column(dataset.name, unit), rows, place, across=across),)
    return tuple(
        Series(dataset, Column(f"{dataset.name}[{k}]", unit), rows, k, across=across)
        for k in range(wide)
    )


def _layout(dataset: Dataset) -> tuple[int, bool, int]:
    """Return how many rows there are, whether they lie along the second axis, and columns.

    MATLAB writes the columns of a matrix one after the other; so do others who write a few long
    rows.
    """
    if len(dataset.shape) != 2:
        return dataset.shape[0], False, 1
    first, second = dataset.shape
    matlab = "MATLAB_class" in dataset.attributes
    across = second > 1 and first <= MOST_WIDE and (matlab or first == 1 or second > MOST_WIDE)
    return (second, True, first) if across else (first, False, second)


def _hindrance(dataset: Dataset, wide: int) -> str:
    """Return why ``dataset`` gives no columns of numbers, "" if it does."""
    if dataset.elsewhere:
        return "its data are in other files"
    if not dataset.stored:
        return "no data were written"
    if len(dataset.shape) > 2 or wide > MOST_WIDE:
        return f"{' by '.join(map(str, dataset.shape))} numbers"
    if dataset.dtype.names:
        return "" if wide == 1 else "a table of tables"
    text = decode_text(dataset.attributes.get("MATLAB_class", "")) in ("char", "cell")
    return str(dataset.dtype)[:40] if text or dataset.dtype.kind not in "iufb" else ""


class Held:
    """The rows of a dataset, read in whole chunks and given out in any pieces, in order."""

    def __init__(self, item: Any, series: Sequence[Series], rows: int) -> None:
        """Look at how ``item``, the opened dataset of ``series``, is stored.

        Its rows are read ``rows`` at a time, if a chunk has no more.
        """
        self._item, self._across = item, series[0].across
        self._parts = [s.part for s in series if s.part is not None]
        self._count = series[0].count
        chunk = item.chunks[1 if self._across else 0] if item.chunks else 1
        if prod(item.chunks or ()) * item.dtype.itemsize > LARGEST_CHUNK:
            raise InputError(
                f"{item.name}: chunks of {item.chunks} numbers; repack it in smaller ones, as by "
                "h5repack -l CHUNK=65536"
            )
        self.step = max(rows // chunk, 1) * chunk
        self._first = 0
        self._block: NDArray[Any] | None = None
        self._written = _find_written(item, self._across)

    @property
    def bytes(self) -> int:
        """How much of the memory the rows take that are read at a time."""
        wide = prod(self._item.shape) // max(self._count, 1)
        return int(min(self.step, self._count) * wide * self._item.dtype.itemsize)

    def rows(self, first: int, stop: int) -> NDArray[Any]:
        """Return rows ``first`` to ``stop``, along the first axis."""
        pieces = []
        while first < stop:
            block = self._block
            if block is None or first >= self._first + len(block):
                block = self._load(first // self.step * self.step)
            piece = block[first - self._first : stop - self._first]
            pieces.append(piece)
            first += len(piece)
        return pieces[0] if len(pieces) == 1 else np.concatenate(pieces)

    def _load(self, first: int) -> NDArray[Any]:
        stop = min(first + self.step, self._count)
        rows = slice(first, stop)
        source = self._item.fields(self._parts) if self._parts else self._item
        block = source[:, rows].T if self._across else source[rows]
        if len(block) != stop - first:
            raise InputError(f"{self._item.name}: {len(block)} rows at {first}; copy it again")
        self._first, self._block = first, block
        return self._block

    def absent(self, first: int, stop: int) -> NDArray[np.bool_] | None:
        """Return which of rows ``first`` to ``stop`` were never written; None if all were."""
        if self._written is None:
            return None
        high, written = self._written
        return ~np.isin(np.arange(first, stop) // high, written)


def _find_written(item: Any, across: bool) -> tuple[int, NDArray[np.int64]] | None:
    """Return the rows in a chunk, and the numbers of the written ones; None if all were."""
    if not item.chunks:
        return None
    grid = [-(-size // chunk) for size, chunk in zip(item.shape, item.chunks, strict=True)]
    if item.id.get_num_chunks() >= prod(grid):
        return None
    axis = 1 if across else 0
    high, beside = item.chunks[axis], prod(grid) // grid[axis]
    there: Counter[int] = Counter()
    item.id.chunk_iter(lambda chunk: there.update([chunk.chunk_offset[axis] // high]))
    return high, np.array([k for k, count in there.items() if count == beside], np.int64)


def choose(series: Series, rows: NDArray[Any]) -> NDArray[Any]:
    """Return the numbers of ``series`` in ``rows`` of its dataset, shape (n,)."""
    if series.part is not None:
        rows = rows[series.part]
    return rows.reshape(len(rows), -1)[:, series.place or 0]
