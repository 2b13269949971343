"""From native files and a channel map to a recording, and warnings for its user."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from floatref.engine.recordings.readers import guard
from floatref.errors import one_line
from floatref.files.sources import name_errors
from floatref.mapping.channel_map.column_names import find, full_name, map_of_ours
from floatref.mapping.channel_map.conversion import Conversion
from floatref.mapping.channel_map.entries import SOURCE, ChannelEntry, ChannelMap
from floatref.mapping.channel_map.map_document import read_map
from floatref.mapping.channel_map.unit_limits import TOLERANCES, check_limits
from floatref.mapping.clocks.aligning import Places, Token, align_clocks, auxiliaries
from floatref.mapping.clocks.clock_keys import Key
from floatref.mapping.clocks.columns import Convert, Shown, Taken, Wanted, as_they_are, take
from floatref.mapping.clocks.sensor_skews import skews_of
from floatref.mapping.clocks.shared_time import cut_to_shared
from floatref.mapping.clocks.stream_clock import Aligned
from floatref.mapping.native_files import Opened
from floatref.mapping.spool import Spool
from floatref.values.arrays import FloatArray
from floatref.values.native import Stream
from floatref.values.recording import Channel, Recording

BASES = ("vertical_specific_force", *TOLERANCES)
"""Accelerometers whose clock is the time base, the first that is mapped."""


@dataclass(frozen=True, eq=False)
class Reading:
    """A recording from native files, with its origin and warnings.

    ``files`` are the files that were read, by their labels in the map, ``databases`` those that
    they were decoded with; ``origins`` has the native name of every channel, ``clocks`` one object
    for each clock that was aligned, ``warnings`` one warning for each possible fault.
    """

    recording: Recording
    files: Mapping[str, Path]
    databases: tuple[Path, ...]
    adapters: Mapping[str, str]
    origins: tuple[str, ...]
    clocks: tuple[Mapping[str, Any], ...]
    skews: tuple[Mapping[str, Any], ...]
    warnings: tuple[str, ...]

    def name_natively(self, line: str) -> str:
        """Return ``line``, a warning about a channel, with the channel's native name."""
        for channel, origin in zip(self.recording.channels, self.origins, strict=True):
            prefix = f"channel {channel.id}:"
            if line.startswith(prefix) and origin != str(channel.id):
                return f"channel {channel.id} ({origin}):{line.removeprefix(prefix)}"
        return line


def read_native(
    source: Path | str,
    channel_map: Path | str | ChannelMap | None = None,
    adapter: str | None = None,
    progress: Callable[[float], None] | None = None,
) -> Reading:
    """Return the recording in the native file ``source`` by ``channel_map``.

    Without a map the file's names have to be ours: `height` or `left.height`, in a known unit.
    ``progress`` is called with the part of all rows that was read. Raises InputError with one
    line naming file, channel and value for anything that cannot be used.
    """
    source = Path(source)
    chart = read_map(Path(channel_map)) if isinstance(channel_map, Path | str) else channel_map
    with ExitStack() as stack:
        opened = Opened(source, adapter, chart, stack)
        if chart is None:
            with name_errors(source):
                chart = map_of_ours(opened.file(SOURCE), source)
        return _Mapping(opened, chart, stack.enter_context(Spool()), progress).reading()


@dataclass(frozen=True, eq=False)
class _Planned:
    """An entry of the map, the stream it is in, and its conversion."""

    entry: ChannelEntry
    key: Key
    stream: Stream
    column: str
    name: str
    conversion: Conversion


class _Mapping:
    """One reading: its plan, and what was taken."""

    def __init__(
        self,
        opened: Opened,
        chart: ChannelMap,
        spool: Spool,
        progress: Callable[[float], None] | None,
    ) -> None:
        self._opened, self._chart, self._spool = opened, chart, spool
        self._progress = progress
        self._warnings: list[str] = []

    def reading(self) -> Reading:
        plan = [self._plan(entry) for entry in self._chart.channels]
        for entry in self._chart.clocks:
            self._opened.check_clock(entry)
        base = next((p for name in BASES for p in plan if p.entry.channel == name), plan[0])
        extra = list(auxiliaries(self._chart.clocks, base.key[0], self._opened.file))
        taken, places = self._take_all(plan, extra)
        clocks = align_clocks(taken, places, self._chart.clocks, base.key, self._spool)
        whole = [self._channel(p, taken, places, clocks) for p in plan]
        with name_errors(self._opened.paths[SOURCE]):
            of = [clocks[p.key].alignment for p in plan]
            channels, cut = cut_to_shared(whole, of, plan.index(base))
        warnings = [*self._opened.warnings(), *self._warnings]
        warnings += [line for c in clocks.values() for line in c.warnings] + list(cut)
        for planned in plan:
            planned.conversion.finish()
            warnings += [f"{self._where(planned)}: {line}" for line in planned.conversion.warnings]
        native = self._opened.file(base.key[0])
        vendor, model = self._chart.vendor or native.vendor, self._chart.model or native.model
        recording = Recording(channels, self._chart.setup, vendor, model)
        skews, late = skews_of(recording)
        return Reading(
            recording=recording,
            files={label: self._opened.paths[label] for label in self._opened.adapters},
            databases=tuple(self._opened.databases),
            adapters=dict(self._opened.adapters),
            origins=tuple(self._origin(p) for p in plan),
            clocks=tuple(report for c in clocks.values() if (report := c.report) is not None),
            skews=skews,
            warnings=tuple(dict.fromkeys(map(one_line, [*warnings, *late]))),
        )

    def _plan(self, entry: ChannelEntry) -> _Planned:
        native = self._opened.file(entry.file)
        with name_errors(self._opened.paths[entry.file]):
            stream, column = find(native, entry.native)
            name = full_name(stream, column)
            with name_errors(f"{name} as {entry.channel}"):
                conversion = Conversion(entry, column)
        return _Planned(entry, (entry.file, stream.name), stream, column.name, name, conversion)

    def _take_all(
        self, plan: Sequence[_Planned], extra: Sequence[tuple[Key, Stream, str]]
    ) -> tuple[dict[Key, Taken], Places]:
        """Read every stream once; also return the column of each conversion's samples in it."""
        wanted: dict[Key, list[Wanted]] = {}
        streams: dict[Key, Stream] = {}
        places: dict[tuple[Key, Token], int] = {}
        jobs: list[tuple[Key, Stream, str, Convert, Token]] = [
            (p.key, p.stream, p.column, self._guard(p), p.entry) for p in plan
        ]
        jobs += [(key, stream, column, as_they_are, column) for key, stream, column in extra]
        for key, stream, column, convert, token in jobs:
            streams[key] = stream
            places[key, token] = len(wanted.setdefault(key, []))
            wanted[key].append(Wanted(column, convert))
        shown = Shown(self._progress, sum(s.count for s in streams.values()))
        taken = {key: self._take(key, streams[key], wanted[key], shown) for key in wanted}
        return taken, places

    def _take(self, key: Key, stream: Stream, wanted: Sequence[Wanted], shown: Shown) -> Taken:
        stated = {(c.file, c.stream): c for c in self._chart.clocks if c.rate is not None}
        clock = stated.get(key) or stated.get((key[0], None))
        path = self._opened.paths[key[0]]
        with name_errors(path), guard(self._opened.adapters[key[0]], path):
            taken = take(stream, wanted, self._spool, clock, shown.of(stream.count))
        name = f"{path.name}: stream {stream.name!r}: "
        self._warnings += [f"{name}{line}" for line in taken.warnings]
        return taken

    def _guard(self, planned: _Planned) -> Convert:
        """Return the conversion of ``planned``, whose errors name the channel."""

        def convert(values: FloatArray, times_s: FloatArray) -> FloatArray:
            with name_errors(self._where(planned)):
                return planned.conversion(values, times_s)

        return convert

    def _channel(
        self,
        planned: _Planned,
        taken: Mapping[Key, Taken],
        places: Places,
        clocks: Mapping[Key, Aligned],
    ) -> Channel:
        entry = planned.entry
        values = taken[planned.key].columns[places[planned.key, entry]]
        with name_errors(self._opened.paths[entry.file]), name_errors(self._where(planned)):
            clock = clocks[planned.key].clock(entry.delay_s)
            if entry.skips_empty_rows:
                values, clock = clocks[planned.key].sparse(values, clock)
            channel = Channel.of(entry.channel, values, clock, entry.track)
            check_limits(channel)
            return channel

    def _origin(self, planned: _Planned) -> str:
        label = planned.entry.file
        return f"{label}: {planned.name}" if label else planned.name

    def _where(self, planned: _Planned) -> str:
        track = f"{planned.entry.track}." if planned.entry.track else ""
        return f"{planned.name} as {track}{planned.entry.channel}"


__all__ = ["Reading", "read_native"]
