"""Logs of NovAtel OEM receivers, ASCII and binary, long and short headers, in one file.

One stream per kind of log, with every field of fixed place that is a number as a column, called as
novatel_edie calls it; where two antennas have the same log, that of the second is `BESTPOS_1`.
Beside them `quality`, in the numbers of NMEA GGA, and `ellipsoidal_height`. The clock counts ms of
GPS time. A log of a receiver that did not know the time (UNKNOWN, APPROXIMATE) is dropped: its time
would lie years away. One whose time was coarse or drifting is delivered and counted.
"""

import re
import struct
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from floatref import Column, Epoch, InputError, NativeClock, NativeFile, Rows, Stream, read_start
from floatref_adapters.formats.novatel.decoder import Decoder
from floatref_adapters.formats.novatel.log_frames import WEEK_MS, Frames, Log, is_sound
from floatref_adapters.formats.novatel.log_layouts import LogLayout
from floatref_adapters.shared.record_spool import Spool
from floatref_adapters.shared.row_pieces import pile_rows

HEAD = 1 << 16
NAN = float("nan")
BEGINS = re.compile(
    rb"\xaaD\x12[\x1c-\x40][\s\S]{9}[\x14-\xf0]|(?P<short>\xaaD\x13)"
    rb"|#[A-Z][A-Z0-9_]{2,31}A(?:_\d+)?,[A-Z0-9_]+,\d+,[\d.]+,[A-Z]+,\d+,[\d.]+,"
    rb"|%[A-Z][A-Z0-9_]{2,31}A,\d+,[\d.]+;"
)
COARSE = 140
"""A time status of less is a coarse one."""
ROLLED_MS = 1024 * WEEK_MS
LATENCY = "latency"
CLOCK = NativeClock(
    tick_s=Fraction(1, 1000), epoch=Epoch.GPS, name="GPS", turn_s=Fraction(ROLLED_MS, 1000)
)
"""Of receivers that keep ten bits of the week, which begins again at 0."""
WARNINGS = {
    "damaged": "beginnings of a log that is cut off or has a wrong checksum: dropped",
    "bytes": "bytes between logs (prompts, answers, damaged logs): not read",
    "nmea": "of these are NMEA 0183 sentences; read them with the adapter nmea",
    "abbreviated": "of these are abbreviated ASCII logs, without a checksum; log them as ASCII",
    "response": "answers to commands: not read",
}
FAULTS = {
    "unknown": "logs that novatel_edie does not know: not decoded",
    "timeless": "logs without GPS time (status below coarse, or week 0): dropped",
    "rolled": "logs of a GPS week below 1024: a receiver that missed a week roll-over is years off",
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
        head = read_start(source, HEAD)
        # Three bytes are found by chance in one compressed file in a few hundred.
        return any(not f["short"] or is_sound(head, f.start()) for f in BEGINS.finditer(head))

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return what ``source`` holds, one stream per kind of log and antenna.

        Raises InputError in one line if there is no sound log, the file cannot be read or
        novatel_edie is not installed.
        """
        survey = Survey(source)
        if not survey.counts:
            survey.close()
            raise InputError(f"{source}: no NovAtel log that is sound; copy the file again")
        return NativeFile(survey.streams(), survey.list_warnings(), "NovAtel", close=survey.close)


Key = tuple[str, int]
PLACE = struct.Struct("<H")


class Survey:
    """What one pass over a file tells: how many logs of each kind, their columns, the faults."""

    def __init__(self, source: Path) -> None:
        self._decoder = Decoder(source)
        self._spool = Spool()
        self.close = self._spool.close
        self.counts: Counter[Key] = Counter()
        self._columns: dict[Key, dict[str, Column]] = {}
        self._layouts: dict[LogLayout, bytes] = {}
        self._seen: set[tuple[Key, LogLayout]] = set()
        self._last: dict[Key, int] = {}
        self._late: dict[str, float] = {}
        self._frames: Counter[str] = Counter()
        self._faults: Counter[tuple[str, str]] = Counter()
        for log in Frames(source, self._frames):
            self._count(log)

    def _count(self, log: Log) -> None:
        if log.response:
            self._frames["response"] += 1
            return
        name = self._decoder.name_of(log)
        fault = self._decoder.fault_of(log)
        if fault is not None:
            self._faults[name, fault] += 1
            if fault != "lists":
                return
        key = (name, log.antenna)
        self.counts[key] += 1
        if log.time_status is not None and log.time_status < COARSE:
            self._faults[name, "coarse"] += 1
        if log.gps_ms < self._last.get(key, log.gps_ms):
            self._faults[name, "back"] += 1
        self._faults[name, "rolled"] += log.gps_ms < ROLLED_MS
        self._last[key] = log.gps_ms
        self._keep(log, key)

    def _keep(self, log: Log, key: Key) -> None:
        """Keep a log behind the number of its layout."""
        layout = self._decoder.find_layout(log)
        columns = self._columns.setdefault(key, {})
        if layout not in self._layouts:
            self._layouts[layout] = PLACE.pack(len(self._layouts))
        if (key, layout) not in self._seen:
            self._seen.add((key, layout))
            columns.update({c.name: c for c in layout.columns if c.name not in columns})
        if LATENCY in layout.values:
            late = layout.values[LATENCY](self._decoder.decode(log.content))
            # NaN is not later.
            self._late[key[0]] = max(self._late.get(key[0], 0.0), late)
        content = log.content if layout.columns else b""
        self._spool.add(key, log.gps_ms, self._layouts[layout] + content)

    def streams(self) -> tuple[Stream, ...]:
        """Return the streams, by name."""
        return tuple(self._stream(key) for key in sorted(self.counts))

    def _stream(self, key: Key) -> Stream:
        def read(names: Sequence[str]) -> Iterator[Rows]:
            return pile_rows(self._rows(key, names), names)

        alone = sum(name == key[0] for name, _ in self.counts) == 1
        name = key[0] if alone or not key[1] else f"{key[0]}_{key[1]}"
        columns = tuple(self._columns[key].values())
        return Stream(name, columns, self.counts[key], CLOCK, read)

    def _rows(self, key: Key, names: Sequence[str]) -> Iterator[tuple[int, Sequence[float]]]:
        getters = [[layout.values.get(name, _absent) for name in names] for layout in self._layouts]
        for gps_ms, kept in self._spool.records(key):
            message = self._decoder.decode(kept[PLACE.size :]) if names else None
            yield gps_ms, [value(message) for value in getters[PLACE.unpack_from(kept)[0]]]

    def list_warnings(self) -> tuple[str, ...]:
        """Return one line for each kind of fault."""
        lines = [
            f"{self._frames[what]} {WARNINGS[what]}" for what in WARNINGS if self._frames[what]
        ]
        for (name, fault), n in sorted(self._faults.items()):
            if n and fault == "back":
                lines.append(f"{name}: time goes back {n} times")
            elif n:
                lines.append(f"{name}: {n} {FAULTS[fault]}")
        lines += [
            f"{name}: velocities of up to {late:.3g} s before their time stamps; state a delay_s"
            for name, late in sorted(self._late.items())
            if late > 0
        ]
        return tuple(lines)


def _absent(message: Any) -> float:
    """Return NaN: the log's definition has no such field."""
    return NAN


__all__ = ["NovAtel"]
