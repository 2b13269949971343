"""Reading files of the RoadLogger: their contents, with its own names, units and ticks."""

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from acme_roadlogger import layout
from acme_roadlogger.blocks import Counts, Skipped, sound_blocks
from acme_roadlogger.header import read_header
from acme_roadlogger.layout import Header
from floatref import Column, Epoch, NativeClock, NativeFile, Rows, Stream

ROWS = 1 << 16
"""Rows delivered at a time, and at most a block more."""


class RoadLogger:
    """The adapter."""

    name = "acme-roadlogger"
    summary = "ACME RoadLogger, version 1"

    def recognises(self, source: Path) -> bool:
        """Return whether the file has the magic number."""
        if not source.is_file():
            return False
        with source.open("rb") as stream:
            return stream.read(len(layout.MAGIC)) == layout.MAGIC

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return one stream for each channel, each sample with its tick, so that gaps remain gaps.

        The whole file is read once: rows are counted, damage is found. Raises
        InputError, in one line, for a header that cannot be used.
        """
        header, begin = read_header(source)
        rows, skipped = [0] * len(header.channels), Skipped()
        for number, _, counts in sound_blocks(source, header, begin, skipped):
            rows[number] += counts.size
        streams = [_stream(source, header, begin, n, count) for n, count in enumerate(rows)]
        return NativeFile(tuple(streams), skipped.warnings(), "ACME", f"RoadLogger {header.device}")


def _stream(source: Path, header: Header, begin: int, number: int, count: int) -> Stream:
    channel = header.channels[number]
    column = Column(channel.name, channel.unit, f"{float(channel.rate):g} Hz")
    clock = NativeClock(
        tick_s=Fraction(1, header.ticks_per_s),
        epoch=Epoch.UTC if header.start_ns else Epoch.LOCAL,
        origin_ns=header.start_ns,
    )
    read = partial(_rows, source, header, begin, number)
    return Stream(f"ch{number}", (column,), count, clock, read)


def _rows(
    source: Path, header: Header, begin: int, number: int, names: Sequence[str]
) -> Iterator[Rows]:
    """Yield the rows of channel ``number``, in its unit; dropouts are NaN."""
    step = header.ticks_per_s / header.channels[number].rate
    places = range(layout.MOST_SAMPLES)
    offsets = np.array([k * step.numerator // step.denominator for k in places])
    ticks, values, held = list[NDArray[np.int64]](), list[NDArray[np.float64]](), 0
    for found, tick, counts in sound_blocks(source, header, begin, Skipped()):
        if found != number:
            continue
        ticks.append(tick + offsets[: counts.size])
        values.append(_values(header, number, counts))
        held += counts.size
        if held >= ROWS:
            yield _joined(names, ticks, values)
            ticks, values, held = [], [], 0
    if held:
        yield _joined(names, ticks, values)


def _values(header: Header, number: int, counts: Counts) -> NDArray[np.float64]:
    channel = header.channels[number]
    values = channel.scale * counts.astype(np.float64) + channel.offset
    if channel.dropout is not None:
        values[counts == channel.dropout] = np.nan
    return values


def _joined(
    names: Sequence[str], ticks: list[NDArray[np.int64]], values: list[NDArray[np.float64]]
) -> Rows:
    return Rows({name: np.concatenate(values) for name in names}, np.concatenate(ticks))
