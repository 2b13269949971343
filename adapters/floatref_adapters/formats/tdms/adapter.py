"""NI TDMS files, through npTDMS: the channels of a group that share a clock are a stream.

npTDMS reads the metadata of each segment, and scales; values are read by rows in `channel_values`.
An index file beside the file is not used.
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from floatref import Column, Epoch, InputError, NativeClock, NativeFile, Stream, read_start
from floatref_adapters.formats.tdms.group_rows import Reader, Source
from floatref_adapters.formats.tdms.tdms_channel import TdmsChannel
from floatref_adapters.formats.tdms.tdms_opening import MAGIC, first_line, quiet, read_metadata
from floatref_adapters.formats.tdms.waveform_clock import NS, UNKNOWN, Waveforms
from floatref_adapters.shared.numbered_names import number_repeats
from floatref_adapters.shared.refusals import prefix_errors
from floatref_adapters.shared.time_columns import time_column


class Tdms:
    """The adapter of TDMS."""

    name = "tdms"
    summary = "NI TDMS (.tdms): a stream per group and clock, from its waveform properties"

    def recognises(self, source: Path) -> bool:
        """Tell from its first bytes whether ``source`` is a TDMS file, not its index."""
        return read_start(source, len(MAGIC)) == MAGIC

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return the groups of ``source``; InputError if it cannot be read."""
        with prefix_errors(source):
            contents = read_metadata(source)
        try:
            with quiet():
                return _native(Source(source, contents))
        except Exception as error:
            fault = str(error) if isinstance(error, InputError) else first_line(error)
            raise InputError(f"{source}: {fault}; the file is damaged") from error


def _native(source: Source) -> NativeFile:
    warnings = list(_describe_cut_off(source))
    found: list[tuple[str, Timed]] = []
    for number, (stated, (properties, objects)) in enumerate(source.contents.groups().items()):
        name = stated.strip() or f"group {number}"
        inherited = (properties, source.contents.properties)
        channels = [TdmsChannel(item, inherited) for item in objects]
        empty = sum(not channel.origin.count for channel in channels)
        if empty:
            warnings.append(f"{name}: {empty} channels hold no values")
        held = [channel for channel in channels if channel.origin.count]
        found += [(name, timed) for timed in _group_by_clock(source, held)]
    names = number_repeats([name for name, _ in found])
    streams = [
        _stream(source, name, timed, warnings)
        for name, (_, timed) in zip(names, found, strict=True)
    ]
    return NativeFile(tuple(streams), tuple(warnings))


def _describe_cut_off(source: Source) -> Iterator[str]:
    lost = sum(source.lost.values())
    if lost or source.contents.cut_off:
        channels = len(source.lost)
        yield f"the last segment is cut off: {lost} values of {channels} channels are missing"


@dataclass(frozen=True, eq=False)
class Timed:
    """Channels on one clock, and the channel that holds their ticks or their waveforms, if any.

    ``others`` are warnings about channels that could have been the time as well.
    """

    channels: list[TdmsChannel]
    clock: NativeClock
    time: TdmsChannel | None = None
    waves: Waveforms | None = None
    others: tuple[str, ...] = ()


def _group_by_clock(source: Source, channels: Sequence[TdmsChannel]) -> Iterator[Timed]:
    """Yield ``channels`` of a group by clocks: those of one waveform, then the others."""
    waves: dict[object, list[TdmsChannel]] = defaultdict(list)
    others: dict[int, list[TdmsChannel]] = defaultdict(list)
    for channel in channels:
        length = source.length(channel)
        if channel.waveforms is None:
            others[length].append(channel)
        else:
            waves[channel.waveforms, length].append(channel)
    for shared in waves.values():
        wave = shared[0].waveforms
        if wave is not None:
            yield Timed(shared, wave.clock(), waves=wave)
    for alike in others.values():
        yield _by_channel(alike)


def _by_channel(channels: list[TdmsChannel]) -> Timed:
    """Return ``channels`` with the first of time stamps as the time, else one called like it."""
    stamped = [channel for channel in channels if channel.stamps]
    if stamped:
        rest = [channel for channel in channels if channel is not stamped[0]]
        return Timed(rest, NativeClock(tick_s=NS, epoch=Epoch.UTC), stamped[0])
    usable = [channel for channel in channels if not channel.unreadable()]
    columns = [Column(channel.origin.name, channel.unit) for channel in usable]
    found = time_column(columns, None)
    if found is None:
        return Timed(channels, UNKNOWN)
    time = usable[found.index]
    rest = [channel for channel in channels if channel is not time]
    return Timed(rest, NativeClock(tick_s=found.unit_s), time, others=found.list_others(columns))


def _stream(source: Source, name: str, timed: Timed, warnings: list[str]) -> Stream:
    channels = timed.channels
    if timed.clock is UNKNOWN:
        warnings.append(f"{name}: no time; its clock is called unknown, give its rate in the map")
    if timed.waves and len(timed.waves.parts) > 1:
        warnings.append(f"{name}: {len(timed.waves.parts)} waveforms one after the other")
    warnings.extend(f"{name}: {line}" for line in timed.others)
    faults = [channel.unreadable() for channel in channels]
    bad = [fault for fault in faults if fault]
    warnings.extend(f"{name}: {bad.count(f)} channels are {f}" for f in dict.fromkeys(bad))
    every = [*channels, timed.time] if timed.time else channels
    count = min(channel.origin.count for channel in every)
    spare = sum(channel.origin.count - count for channel in every)
    if spare:
        warnings.append(f"{name}: {spare} values after the last complete row")
    columns = [
        Column(channel.origin.name, channel.unit, fault, numeric=not fault)
        for channel, fault in zip(channels, faults, strict=True)
    ]
    usable = {c.origin.name: c for c, fault in zip(channels, faults, strict=True) if not fault}
    reader = Reader(source, name, usable, timed.time, count, timed.waves)
    return Stream(name, tuple(columns), count, timed.clock, reader)
