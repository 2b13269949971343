"""ASAM MDF 4 files, through asammdf: each channel group is a stream, its master the clock.

asammdf reads the metadata, sorts records of several groups and converts; `data_blocks` reads the
records of sorted files.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from floatref import Column, InputError, NativeClock, NativeFile, Rows, Stream, read_start
from floatref_adapters.formats.mdf4.channel_group import Group, Piece
from floatref_adapters.formats.mdf4.master_clock import Timing, find_timing, is_clock, start_of
from floatref_adapters.formats.mdf4.mdf_opening import MAGIC, OpenedMdf, first_line, open_mdf, quiet
from floatref_adapters.formats.mdf4.record_fields import Field, find_unit
from floatref_adapters.shared.numbered_names import number_repeats
from floatref_adapters.shared.refusals import prefix_errors

WIDEST_RECORD = 1 << 24
LENGTHS, BUS_EVENTS, REMOTE_MASTER = 1, 2, 8
"""Flags of a channel group: values of varying length of another one, frames of a bus, and one
whose master is in another group."""


class Mdf4:
    """The adapter of MDF 4."""

    name = "mdf4"
    summary = "ASAM MDF 4 (.mf4): a stream per channel group, its master channel the clock"

    def recognises(self, source: Path) -> bool:
        """Tell from its first bytes whether ``source`` is an MDF file, of any version."""
        return read_start(source, 8) in MAGIC

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return the channel groups of ``source``; InputError if it cannot be read.

        Close it: asammdf keeps the file open.
        """
        with prefix_errors(source):
            opened = open_mdf(source)
        try:
            return _native(opened)
        except Exception as error:
            opened.close()
            fault = str(error) if isinstance(error, InputError) else first_line(error)
        raise InputError(f"{source}: {fault}; the file is damaged")


def _native(opened: OpenedMdf) -> NativeFile:
    mdf = opened.mdf
    start, about_start = start_of(mdf.header)
    warnings = [about_start] if about_start else []
    names = number_repeats([_name(origin, k) for k, origin in enumerate(mdf.groups)])
    streams = []
    for number, (origin, name) in enumerate(zip(mdf.groups, names, strict=True)):
        group = Group(opened, number, origin, name)
        left_out = _explain_omission(group)
        if left_out:
            warnings.append(f"{name}: {left_out}")
        elif not origin.channel_group.flags & LENGTHS:
            streams.append(_stream(group, start, warnings))
    return NativeFile(tuple(streams), tuple(warnings), close=opened.close)


def _name(origin: Any, number: int) -> str:
    made = origin.channel_group
    source = getattr(made.acq_source, "name", "")
    return (made.acq_name or source or f"group {number}").strip() or f"group {number}"


def _explain_omission(group: Group) -> str:
    """Return why the records of ``group`` are not delivered; "" if they are."""
    made, channels = group.origin.channel_group, len(group.origin.channels)
    if made.flags & LENGTHS:
        return ""
    if made.flags & REMOTE_MASTER or group.origin.uses_ld:
        return f"{channels} channels stored by column are not read; save the file as MDF 4.10"
    if group.width == 0 or channels == 0:
        return f"{channels} channels without a record of their own"
    if group.width > WIDEST_RECORD:
        return f"records of {group.width} bytes, {WIDEST_RECORD} at most; the file is damaged"
    return ""


def _stream(group: Group, start: NativeClock, warnings: list[str]) -> Stream:
    fields = [group.field(index) for index in range(len(group.origin.channels))]
    clocks = [field for field in fields if is_clock(field.origin) and not field.unreadable()]
    timing = find_timing(start, clocks[0] if clocks else None)
    if not clocks:
        warnings.append(
            f"{group.name}: no time; its clock is called unknown, give its rate in the map"
        )
    fields = [field for field in fields if field not in clocks[:1]]
    names = number_repeats([field.origin.name for field in fields])
    faults = [field.unreadable() for field in fields]
    columns = tuple(map(_column, fields, names, faults))
    warnings.extend(_count_undecoded(group, faults))
    count = _count(group, warnings)
    usable = {n: f for n, f, fault in zip(names, fields, faults, strict=True) if not fault}
    return Stream(group.name, columns, count, timing.clock, Reader(group, timing, usable, count))


def _column(field: Field, name: str, fault: str) -> Column:
    notes = list(filter(None, [fault or field.note()]))
    if name != field.origin.name:
        notes.append("a name given more than once")
    return Column(name, find_unit(field.origin), "; ".join(notes), numeric=not fault)


def _count_undecoded(group: Group, faults: list[str]) -> Iterator[str]:
    bad = [fault for fault in faults if fault]
    for fault in dict.fromkeys(bad):
        yield f"{group.name}: {bad.count(fault)} channels are {fault}"
    if group.origin.channel_group.flags & BUS_EVENTS:
        frames = group.origin.channel_group.cycles_nr
        yield f"{group.name}: {frames} frames of a bus, not decoded"


def _count(group: Group, warnings: list[str]) -> int:
    """Return how many records are delivered: what the file says, if it holds as many."""
    stated, held = int(group.origin.channel_group.cycles_nr), group.count_stored()
    if stated > held:
        warnings.append(
            f"{group.name}: {stated - held} of {stated} rows are missing; the file is cut off"
        )
    return min(stated, held)


@dataclass(frozen=True, eq=False)
class Reader:
    """Reads rows of a group; ``fields`` by the names of the columns that are numbers."""

    group: Group
    timing: Timing
    fields: Mapping[str, Field]
    count: int

    def __call__(self, names: Sequence[str]) -> Iterator[Rows]:
        """Yield the rows of the columns ``names``; InputError if they cannot be expanded."""
        for name in names:
            if name not in self.fields:
                raise self._fault(f"{name}: not a column of numbers; see floatref channels")
        wanted = [self.fields[name] for name in names]
        time = [self.timing.field] if self.timing.field else []
        pieces = self.group.read(self.count, [*wanted, *time])
        while True:
            with quiet():
                rows = self._read_next(pieces, names)
            if rows is None:
                return
            yield rows

    def _read_next(self, pieces: Iterator[Piece], names: Sequence[str]) -> Rows | None:
        try:
            piece = next(pieces, None)
            if piece is None:
                return None
            fields = {name: self.fields[name] for name in names}
            values = {n: field.to_values(*piece.read(field)) for n, field in fields.items()}
            time = self.timing.field
            ticks = self.timing.to_ticks(time, piece.read(time)[0]) if time else None
            return Rows(values, ticks)
        except InputError as error:
            raise self._fault(str(error)) from error
        except Exception as error:
            raise self._fault(f"{first_line(error)}; the file is damaged") from error

    def _fault(self, text: str) -> InputError:
        return InputError(f"{self.group.opened.source}: {self.group.name}: {text}")
