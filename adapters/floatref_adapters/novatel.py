"""Logs of NovAtel OEM receivers, ASCII and binary, long and short headers, in one file.

One stream per kind of log, with every field of fixed place that is a number as a column, called as
novatel_edie calls it; where two antennas have the same log, that of the second is `BESTPOS_1`.
Beside them `quality`, in the numbers of NMEA GGA, and `ellipsoidal_height`. The clock counts ms of
GPS time. A log of a receiver that did not know the time (UNKNOWN, APPROXIMATE) is dropped: its time
would lie years away. One whose time was coarse or drifting is delivered and counted.
"""

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from floatref import Column, Epoch, InputError, NativeClock, NativeFile, Rows, Stream
from floatref_adapters.libraries import library
from floatref_adapters.novatel_frames import Frames, Log
from floatref_adapters.novatel_layouts import LogLayout, layout_of
from floatref_adapters.piled_rows import piled
from floatref_adapters.text_lines import first_bytes

HEAD = 1 << 16
NAN = float("nan")
BEGINS = re.compile(
    rb"\xaaD\x12[\x1c-\x40][\s\S]{10}[\x14-\xf0]|\xaaD\x13"
    rb"|#[A-Z][A-Z0-9_]{2,31}A(?:_\d+)?,[A-Z0-9_]+,\d+,[\d.]+,[A-Z]+,\d+,[\d.]+,"
    rb"|%[A-Z][A-Z0-9_]{2,31}A,\d+,[\d.]+;"
)
COARSE = 140
TIMELESS = 80
"""A time status of less than `TIMELESS` is no time, of less than `COARSE` a coarse one."""
PADDING = bytes(64)
"""Behind a binary log, so that the decoder cannot read beyond it."""
CLOCK = NativeClock(tick_s=Fraction(1, 1000), epoch=Epoch.GPS, name="GPS")
TOLD = {
    "damaged": "beginnings of a log that is cut off or has a wrong checksum: dropped",
    "bytes": "bytes between logs (prompts, answers, damaged logs): not read",
    "nmea": "of these are NMEA 0183 sentences; read them with the adapter nmea",
    "abbreviated": "of these are abbreviated ASCII logs, without a checksum; log them as ASCII",
    "response": "answers to commands: not read",
}
FAULTS = {
    "unknown": "logs that novatel_edie does not know: not decoded",
    "timeless": "logs without GPS time (status below coarse): dropped",
    "coarse": "logs with a coarse or drifting time: taken as they are",
    "unfit": "logs that do not fit their definition: dropped",
    "lists": "logs with lists of varying length: not decoded",
}


class NovAtel:
    """The adapter of such a file."""

    name = "novatel"
    summary = "NovAtel OEM logs, ASCII and binary (BESTPOS, BESTVEL, INSPVAX, ...)"

    def recognises(self, source: Path) -> bool:
        """Tell whether the first bytes of ``source`` hold the beginning of a log."""
        return BEGINS.search(first_bytes(source, HEAD)) is not None

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return what ``source`` holds, one stream per kind of log and antenna.

        Raises InputError in one line if there is no sound log, the file cannot be read or
        novatel_edie is not installed.
        """
        survey = Survey(source)
        if not survey.counts:
            raise InputError(f"{source}: no NovAtel log that is sound; copy the file again")
        return NativeFile(survey.streams(), told=survey.told(), vendor="NovAtel")


Key = tuple[str, int]


class Survey:
    """What one pass over a file tells: how many logs of each kind, their columns, the faults."""

    def __init__(self, source: Path) -> None:
        self._source = source
        self._decoder = Decoder(source)
        self.counts: Counter[Key] = Counter()
        self._columns: dict[Key, dict[str, Column]] = {}
        self._last: dict[Key, int] = {}
        self._frames: Counter[str] = Counter()
        self._faults: Counter[tuple[str, str]] = Counter()
        for log in Frames(source, self._frames):
            self._count(log)

    def _count(self, log: Log) -> None:
        if log.response:
            self._frames["response"] += 1
            return
        name = self._decoder.name_of(log)
        fault, _ = self._decoder.opened(log)
        if fault is not None:
            self._faults[name, fault] += 1
            if fault != "lists":
                return
        key = (name, log.antenna)
        self.counts[key] += 1
        self._faults[name, "coarse"] += log.time_status in range(TIMELESS, COARSE)
        self._faults[name, "back"] += log.gps_ms < self._last.get(key, log.gps_ms)
        self._last[key] = log.gps_ms
        columns = self._columns.setdefault(key, {})
        for column in self._decoder.layout_of(log).columns:
            columns.setdefault(column.name, column)

    def streams(self) -> tuple[Stream, ...]:
        """Return the streams, by name."""
        return tuple(self._stream(key) for key in sorted(self.counts))

    def _stream(self, key: Key) -> Stream:
        def read(names: Sequence[str]) -> Iterator[Rows]:
            return piled(self._rows(key, names), names)

        alone = sum(name == key[0] for name, _ in self.counts) == 1
        name = key[0] if alone or not key[1] else f"{key[0]}_{key[1]}"
        columns = tuple(self._columns[key].values())
        return Stream(name, columns, self.counts[key], CLOCK, read)

    def _rows(self, key: Key, names: Sequence[str]) -> Iterator[tuple[int, Sequence[float]]]:
        for log in Frames(self._source, Counter()):
            if log.response or (self._decoder.name_of(log), log.antenna) != key:
                continue
            fault, message = self._decoder.opened(log)
            if fault in (None, "lists"):
                values = self._decoder.layout_of(log).values
                yield log.gps_ms, [values[n](message) if n in values else NAN for n in names]

    def told(self) -> tuple[str, ...]:
        """Return one line for each kind of fault."""
        lines = [f"{self._frames[what]} {TOLD[what]}" for what in TOLD if self._frames[what]]
        for (name, fault), n in sorted(self._faults.items()):
            if n and fault == "back":
                lines.append(f"{name}: time goes back {n} times")
            elif n:
                lines.append(f"{name}: {n} {FAULTS[fault]}")
        return tuple(lines)


class Decoder:
    """The decoder of novatel_edie, which gets sound logs of the right size only.

    It reads beyond the end of any other one. InputError if it is not installed.
    """

    def __init__(self, source: Path) -> None:
        novatel_edie = library("novatel_edie", f"{source}: reading NovAtel logs")
        oem = library("novatel_edie.oem", f"{source}: reading NovAtel logs")
        novatel_edie.disable_internal_logging()
        self._database = oem.get_builtin_database()
        self._decode = oem.Decoder(self._database).decode
        self._trouble = novatel_edie.NovatelEdieException
        self._definitions: dict[str | int, Any] = {}
        self._layouts: dict[tuple[str | int, int | None], LogLayout] = {}

    def name_of(self, log: Log) -> str:
        """Return the name of ``log``, or its number where the list of logs has none."""
        definition = self._definition(log.key)
        return str(log.key) if definition is None else str(definition.name)

    def layout_of(self, log: Log) -> LogLayout:
        """Return the columns of ``log``."""
        key = (log.key, log.definition)
        if key not in self._layouts:
            self._layouts[key] = layout_of(self._definition(log.key), log.definition)
        return self._layouts[key]

    def opened(self, log: Log) -> tuple[str | None, Any]:
        """Return why ``log`` cannot be used, None if it can, and the decoded log."""
        if self._definition(log.key) is None:
            return "unknown", None
        if log.time_status is not None and log.time_status < TIMELESS:
            return "timeless", None
        layout = self.layout_of(log)
        if not layout.columns:
            return "lists", None
        message = self._message(log, layout)
        return ("unfit" if message is None else None), message

    def _definition(self, key: str | int) -> Any:
        if key not in self._definitions:
            self._definitions[key] = self._database.get_msg_def(key)
        return self._definitions[key]

    def _message(self, log: Log, layout: LogLayout) -> Any:
        """Return the decoded log, None if it does not fit."""
        if log.room < (layout.size if log.binary else layout.fields):
            return None
        try:
            message = self._decode(log.content + PADDING if log.binary else log.content)
        except (self._trouble, RuntimeError, ValueError):
            return None
        return message if hasattr(message, "get_field_names") else None


__all__ = ["NovAtel"]
