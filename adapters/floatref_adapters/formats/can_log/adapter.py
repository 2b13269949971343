"""CAN logs (Vector ASC and BLF, candump, PEAK TRC, CSV of python-can), with or without a DBC.

With the option `dbc`, the path of a database that cantools reads, each message that the log has is
a stream and each of its signals a column, scaled, in the unit of the database; a multiplexed signal
is NaN while it is absent. Without one every id is a stream, listed with its count, that cannot be
mapped. The clock counts ns: since 1970 in candump and CSV, else since the start of the log, whose
date is local time or unsaid. Where a log has several buses, streams are called `Wheels bus 2`.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path

from floatref import Column, Epoch, InputError, NativeClock, NativeFile, Rows, Stream
from floatref_adapters.formats.can_log.can_database import Database, Message
from floatref_adapters.formats.can_log.can_frames import Frame, Frames
from floatref_adapters.formats.can_log.log_formats import find_format
from floatref_adapters.shared.record_spool import Spool
from floatref_adapters.shared.row_pieces import pile_rows

MOST_IDS = 20_000
SHOWN = 8
NS = Fraction(1, 10**9)
YEAR_2001_NS = 10**18
"""Times since 1970 below this are times since some start."""
DATA = Column("data", note="the bytes; give a database of the bus in option dbc", numeric=False)
WARNINGS = {
    "error": "error frames: not read",
    "remote": "remote frames: not read",
    "overload": "overload frames: not read",
    "event": "events that are no data frames: not read",
    "line": "lines that python-can cannot read: dropped",
    "cut": "frames with fewer bytes than they declare: dropped",
    "range": "frames with an id or a time that cannot be: dropped",
    "container": "containers that are damaged or unpack to more than 16 MiB: dropped",
    "objects": "objects that are damaged or cut off: dropped",
    "rest": "ends of the log that are cut off or damaged: dropped",
    "back": "times the time goes back",
}


class CanLog:
    """The adapter of such a log."""

    name = "can"
    summary = "CAN log (ASC, BLF, candump, TRC, CSV of python-can); option dbc: its database"

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` begins as such a log does."""
        return find_format(source) is not None

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return what ``source`` holds; ``options`` may have `dbc`, the path of a database.

        Raises InputError in one line if there is no data frame, if the log or the database
        cannot be read, or if python-can or cantools is not installed.
        """
        database = Database(Path(options["dbc"])) if options.get("dbc") else None
        survey = Survey(source, database)
        if not survey.seen:
            survey.close()
            raise InputError(f"{source}: no CAN data frame that is sound; copy the log again")
        return NativeFile(survey.streams(), warnings=survey.list_warnings(), close=survey.close)


Key = tuple[str, int, bool]
"""Bus, id, and whether the id is an extended one."""


class Survey:
    """What one pass over a log finds: its ids, the count of frames of each, the faults."""

    def __init__(self, source: Path, database: Database | None) -> None:
        self._source = source
        self._frames = Frames(source)
        self._database = database
        self._messages: dict[tuple[int, bool], Message | None] = {}
        self._faults: Counter[str] = Counter()
        self._short: Counter[str] = Counter()
        self.seen: Counter[Key] = Counter()
        self._counts: Counter[Key] = Counter()
        self._first = self._last = 0
        self._spool = Spool()
        self.close = self._spool.close
        for frame in self._frames.read(self._faults):
            self._count(frame)

    def _count(self, frame: Frame) -> None:
        key = (frame.bus, frame.number, frame.extended)
        if not self.seen:
            self._first = self._last = frame.tick
        if frame.tick < self._last:
            self._faults["back"] += 1
        self._last = frame.tick
        self.seen[key] += 1
        if len(self.seen) > MOST_IDS:
            raise InputError(f"{self._source}: more than {MOST_IDS} ids; it is no CAN log")
        message = self._message(key)
        if message is not None and not message.fits(frame.data):
            self._short[message.name] += 1
        else:
            self._counts[key] += 1
            self._spool.add(key, frame.tick, frame.data if message is not None else b"")

    def _message(self, key: Key) -> Message | None:
        number = key[1:]
        if self._database is None:
            return None
        if number not in self._messages:
            self._messages[number] = self._database.message(*number)
        return self._messages[number]

    def streams(self) -> tuple[Stream, ...]:
        """Return the streams: of messages in the database, or of every id without one."""
        keys = sorted(self.seen)
        if self._database is not None:
            keys = [key for key in keys if self._message(key) is not None]
        named = Counter(self._name(key) for key in keys)
        streams = []
        for key in keys:
            name = self._name(key)
            # Databases of several buses may call two ids the same.
            streams.append(self._stream(key, name if named[name] == 1 else f"{name} {_id(key)}"))
        return tuple(streams)

    def _name(self, key: Key) -> str:
        message = self._message(key)
        name = _id(key) if message is None else message.name
        alone = len({bus for bus, _, _ in self.seen}) == 1
        return name if alone else f"{name} bus {key[0]}"

    def _stream(self, key: Key, name: str) -> Stream:
        message = self._message(key)

        def read(names: Sequence[str]) -> Iterator[Rows]:
            return pile_rows(self._rows(key, message, names), names)

        columns = (DATA,) if message is None else message.columns
        return Stream(name, columns, self._counts[key], self._clock(), read)

    def _clock(self) -> NativeClock:
        dated = self._frames.dated and self._first > YEAR_2001_NS
        return NativeClock(tick_s=NS, epoch=Epoch.UTC if dated else Epoch.LOCAL, name="CAN")

    def _rows(
        self, key: Key, message: Message | None, names: Sequence[str]
    ) -> Iterator[tuple[int, Sequence[float]]]:
        for tick, data in self._spool.records(key):
            yield tick, () if message is None else message.values(data, names)

    def list_warnings(self) -> tuple[str, ...]:
        """Return one line for each kind of fault."""
        lines = [
            f"{self._faults[what]} {WARNINGS[what]}" for what in WARNINGS if self._faults[what]
        ]
        lines += [
            f"{name}: {n} frames that are too short or have an unknown multiplexer: dropped"
            for name, n in sorted(self._short.items())
        ]
        if self._database is not None:
            lines += self._unknown()
        return tuple(lines)

    def _unknown(self) -> list[str]:
        keys = [key for key in sorted(self.seen) if self._message(key) is None]
        if not keys:
            return []
        frames = sum(self.seen[key] for key in keys)
        ids = sorted({_id(key) for key in keys}, key=lambda text: (len(text), text))
        shown = ", ".join(ids[:SHOWN]) + (", ..." if len(ids) > SHOWN else "")
        return [f"{frames} frames of {len(ids)} ids not in the database: not decoded ({shown})"]


def _id(key: Key) -> str:
    return f"0x{key[1]:08X}" if key[2] else f"0x{key[1]:03X}"


__all__ = ["CanLog"]
