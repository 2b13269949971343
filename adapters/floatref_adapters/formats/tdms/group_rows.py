"""Rows of the channels of a TDMS group, in pieces."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, Rows, open_bytes
from floatref_adapters.formats.tdms.channel_values import Values, Window
from floatref_adapters.formats.tdms.extents import find_extents
from floatref_adapters.formats.tdms.tdms_channel import TdmsChannel
from floatref_adapters.formats.tdms.tdms_objects import Contents
from floatref_adapters.formats.tdms.tdms_opening import first_line, open_guarded, quiet
from floatref_adapters.formats.tdms.waveform_clock import Waveforms, to_unix_ns
from floatref_adapters.shared.row_pieces import MOST_ROWS, count_piece_rows, keep_freed_memory

PIECE_BYTES = 1 << 24
Numbers = NDArray[Any]


@dataclass(eq=False)
class Source:
    """A file by its path, and what it says of its channels."""

    path: Path
    contents: Contents

    @cached_property
    def lost(self) -> dict[str, int]:
        """How many values of the last chunk are missing, by the paths of the channels."""
        return self.contents.count_lost()

    def length(self, channel: TdmsChannel) -> int:
        """Return how many values ``channel`` would have if the file were complete."""
        return channel.origin.count + self.lost.get(channel.origin.path, 0)


@dataclass(frozen=True, eq=False)
class Reader:
    """Reads rows of a stream: ``channels`` by column.

    The ticks are in the channel ``time``, or those of ``waves``; one with a rate has neither.
    """

    source: Source
    name: str
    channels: Mapping[str, TdmsChannel]
    time: TdmsChannel | None
    count: int
    waves: Waveforms | None = None

    def __call__(self, names: Sequence[str]) -> Iterator[Rows]:
        """Yield the rows of the columns ``names``; InputError if the file is not as it says."""
        for name in names:
            if name not in self.channels:
                raise self._fault(f"{name}: not a column of numbers; see floatref channels")
        every = [self.channels[name] for name in names] + ([self.time] if self.time else [])
        through = self._read_buffered if any(c.daqmx for c in every) else self._direct
        pieces = through(every) if every else self._nothing()
        first = 0
        keep_freed_memory()
        while True:
            with quiet():
                values = self._next(pieces)
            if values is None:
                return
            last = first + len(values[0]) if values else min(first + MOST_ROWS, self.count)
            ticks = values.pop() if self.time else self._ticks(first, last)
            yield Rows(dict(zip(names, values, strict=True)), ticks)
            first = last

    def _nothing(self) -> Iterator[list[Numbers]]:
        """Yield no values of no channels, where the ticks are all that is asked for."""
        if self.waves and len(self.waves.parts) > 1:
            yield from ([] for _ in range(0, self.count, MOST_ROWS))

    def _ticks(self, first: int, last: int) -> Numbers | None:
        return self.waves.ticks(first, last) if self.waves else None

    def _next(self, pieces: Iterator[list[Numbers]]) -> list[Numbers] | None:
        try:
            return next(pieces, None)
        except InputError as error:
            raise self._fault(str(error)) from error
        except Exception as error:
            raise self._fault(f"{first_line(error)}; the file is damaged") from error

    def _fault(self, text: str) -> InputError:
        return InputError(f"{self.source.path}: {self.name}: {text}")

    def _direct(self, channels: list[TdmsChannel]) -> Iterator[list[Numbers]]:
        """Yield the values of ``channels``, which lie in the file one by one or row by row."""
        paths = [channel.origin.path for channel in channels]
        extents = find_extents(self.source.contents.segments, paths)
        lying = [Values(extents[path]) for path in paths]
        makers = [self._maker(channel) for channel in channels]
        widest = max(values.row_bytes for values in lying)
        rows = min(max(PIECE_BYTES // widest, 1), count_piece_rows(len(channels)))
        with open_bytes(self.source.path) as file:
            window = Window(file)
            for first in range(0, self.count, rows):
                last = min(first + rows, self.count)
                raws = [values.read(window, first, last) for values in lying]
                yield [make(raw) for make, raw in zip(makers, raws, strict=True)]

    def _maker(self, channel: TdmsChannel) -> Callable[[Numbers], Numbers]:
        """Return what makes values, or ticks, of raw numbers of ``channel``."""
        if channel.stamps:
            return to_unix_ns
        scaling = channel.scaling()
        if (
            channel is self.time
            and scaling is None
            and channel.origin.data_type.nptype.kind in "iu"
        ):
            return lambda raw: raw.astype(np.int64, copy=False)
        return channel.make_scale()

    def _read_buffered(self, channels: list[TdmsChannel]) -> Iterator[list[Numbers]]:
        """Yield the values of ``channels``, some of which npTDMS has to find in buffers.

        It reads the chunks of the file one after the other, for all channels at once.
        """
        from nptdms import TdmsFile

        held = [np.empty(0)] * len(channels)
        left = self.count
        with (
            open_guarded(self.source.path) as file,
            TdmsFile.open(file, raw_timestamps=True) as tdms,
        ):
            for chunk in tdms.data_chunks():
                held = [_join(h, chunk, c) for h, c in zip(held, channels, strict=True)]
                while (rows := min(left, MOST_ROWS)) and min(map(len, held)) >= rows:
                    yield [part[:rows] for part in held]
                    held, left = [part[rows:] for part in held], left - rows


def _join(held: Numbers, chunk: Any, channel: TdmsChannel) -> Numbers:
    """Return ``held`` and what ``chunk`` has of ``channel`` behind it."""
    more = chunk[channel.origin.group][channel.origin.name][:]
    if not len(more):
        return held
    more = to_unix_ns(more) if channel.stamps else np.asarray(more, np.float64)
    return np.concatenate([held, more]) if len(held) else more
