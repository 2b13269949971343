"""Where in a TDMS file the values of its channels lie."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any, Literal

import numpy as np

INTERLEAVED, BIG_ENDIAN = 1 << 5, 1 << 6
"""Flags of a segment."""


@dataclass(frozen=True)
class Extent:
    """Values of a channel in ``chunks`` chunks of ``total`` bytes, one every ``stride`` bytes.

    The first chunk is at ``base``; in each, ``per_chunk`` values lie ``offset`` bytes from its
    start, without gaps.
    """

    base: int
    offset: int
    total: int
    stride: int
    chunks: int
    per_chunk: int
    dtype: np.dtype[Any]

    @property
    def count(self) -> int:
        """How many values there are."""
        return self.chunks * self.per_chunk


@dataclass
class Run:
    """Segments alike, as the first of them: ``chunks`` of ``total`` bytes every ``stride``."""

    segment: Any
    base: int
    total: int
    stride: int
    chunks: int

    @classmethod
    def of(cls, segment: Any) -> "Run":
        """Return the whole chunks of ``segment``."""
        total = sum(item.data_size for item in _objects(segment))
        if _is_interleaved(segment):
            total = sum(item.data_type.size * item.number_values for item in _objects(segment))
        whole = segment.num_chunks - (segment.final_chunk_lengths_override is not None)
        return cls(segment, segment.data_position, total, total, whole)

    def takes(self, segment: Any) -> bool:
        """Add the chunks of ``segment`` and return True, if it goes on as this began."""
        last = self.segment.final_chunk_lengths_override, segment.final_chunk_lengths_override
        stride = segment.data_position - self.base if self.chunks == 1 else self.stride
        even = segment.data_position == self.base + self.chunks * stride and stride >= self.total
        split = segment.num_chunks > 1 or _is_interleaved(segment)
        if last != (None, None) or not even or (split and stride != self.total):
            return False
        if not _alike(self.segment, segment):
            return False
        self.stride, self.chunks = stride, self.chunks + segment.num_chunks
        return True

    def extents(self) -> Iterator[tuple[str, Extent]]:
        """Yield the extents of its channels, by their paths."""
        lay = self._lay_interleaved if _is_interleaved(self.segment) else self._lay_contiguous
        yield from lay(_objects(self.segment))
        if self.segment.final_chunk_lengths_override and not _is_interleaved(self.segment):
            yield from _lay_cut_off(self.segment, self.base + self.chunks * self.stride)

    def _lay_contiguous(self, objects: Sequence[Any]) -> Iterator[tuple[str, Extent]]:
        offsets = [0, *accumulate(item.data_size for item in objects)]
        for item, offset in zip(objects, offsets, strict=False):
            if item.data_type.size and item.number_values and self.chunks:
                place = (self.base, offset, self.total, self.stride, self.chunks)
                yield item.path, Extent(*place, item.number_values, _dtype(item, self.segment))

    def _lay_interleaved(self, objects: Sequence[Any]) -> Iterator[tuple[str, Extent]]:
        width = sum(item.data_type.size for item in objects)
        last = self.segment.final_chunk_lengths_override or {}
        offset = 0
        for item in objects:
            rows = item.number_values * self.chunks + last.get(item.path, 0)
            if rows:
                place = (self.base, offset, width, width, rows, 1)
                yield item.path, Extent(*place, _dtype(item, self.segment))
            offset += item.data_type.size


def find_extents(segments: Iterable[Any], paths: Iterable[str]) -> dict[str, list[Extent]]:
    """Return where the values of the channels ``paths`` are, in the order of npTDMS's segments."""
    found: dict[str, list[Extent]] = {path: [] for path in paths}
    for run in _runs(segments):
        for path, extent in run.extents():
            if path in found:
                found[path].append(extent)
    return found


def _runs(segments: Iterable[Any]) -> Iterator[Run]:
    run = None
    for segment in segments:
        if not segment.num_chunks or (run and run.takes(segment)):
            continue
        if run:
            yield run
        run = Run.of(segment)
    if run:
        yield run


def _objects(segment: Any) -> list[Any]:
    return [item for item in segment.ordered_objects if item.has_data]


def _is_interleaved(segment: Any) -> bool:
    return bool(segment.toc_mask & INTERLEAVED) and len(_objects(segment)) > 1


def _alike(one: Any, other: Any) -> bool:
    if (one.toc_mask ^ other.toc_mask) & (INTERLEAVED | BIG_ENDIAN):
        return False
    if one.ordered_objects is other.ordered_objects:
        return True
    return [_place(item) for item in _objects(one)] == [_place(item) for item in _objects(other)]


def _place(item: Any) -> tuple[Any, ...]:
    return item.path, item.number_values, item.data_size, item.data_type


def _lay_cut_off(segment: Any, base: int) -> Iterator[tuple[str, Extent]]:
    offset = 0
    for item in _objects(segment):
        count = segment.final_chunk_lengths_override.get(item.path, 0)
        size = count * item.data_type.size
        if count:
            yield item.path, Extent(base + offset, 0, size, size, 1, count, _dtype(item, segment))
        offset += size


def _dtype(item: Any, segment: Any) -> np.dtype[Any]:
    order: Literal[">", "<"] = ">" if segment.toc_mask & BIG_ENDIAN else "<"
    native = item.data_type.nptype
    if native is not None:
        ordered: np.dtype[Any] = np.dtype(native).newbyteorder(order)
        return ordered
    # Time stamps; values of other kinds without a number type are never read.
    parts = [("second_fractions", f"{order}u8"), ("seconds", f"{order}i8")]
    return np.dtype(parts if order == "<" else parts[::-1])
