"""Logs of a NovAtel OEM receiver, found in a stream of bytes and sound by their checksum.

A log is ASCII (`#NAMEA,...;...*crc`, `%NAMESA,...;...*crc` with the short header) or binary
(AA 44 12, or AA 44 13 with the short header); a CRC-32 ends each. Whatever lies between is
counted. Nothing here needs the receiver's list of logs.

By hand, for the `Framer` of novatel_edie finds the same logs (0.5 s of 8 s for 20 MB, here 0.8 s)
but does not tell damaged logs, which are counted here, from other bytes. Its `FileParser` decodes
at once, also a log shorter than its definition, beyond whose end it reads.
"""

import re
import struct
import zlib
from collections import Counter
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import NamedTuple

from floatref import InputError
from floatref_adapters.shared.text_lines import BLOCK, blocks

START = re.compile(rb"\xaaD[\x12\x13]|[#%][A-Z][A-Z0-9_]{2,31},")
LINE_END = re.compile(rb"[\r\n]")
TEXT = re.compile(
    rb"(?P<sync>[#%])(?P<name>[A-Z0-9_]+?)(?P<kind>[AR])(?P<antenna>_\d{1,2})?,"
    rb"(?P<header>[^;#%]{3,160});(?P<body>[^\r\n]*)\*(?P<sum>[0-9a-fA-F]{8})[ \t]*$"
)
NMEA = re.compile(rb"\$[A-Z]{2}[A-Z0-9]{3,6},[^\r\n$]{0,400}\*[0-9A-Fa-f]{2}")
ABBREVIATED = re.compile(rb"<[A-Z][A-Z0-9_]{3,31} [^\r\n]{0,30} \d+ [\d.]+ [A-Z]+ \d+ [\d.]+ ")
LONGEST = 1 << 15
"""Bytes of a log; the receivers write no longer one."""
NEEDED = 64
WASTE = 64
"""Bytes that may be looked at in vain for each byte of the file."""
LONG_HEADER = struct.Struct("<3sBHBBHHBBHIIHH")
SHORT_HEADER = struct.Struct("<3sBHHI")
WEEK_MS = 604_800_000
TIME_STATUS = {
    b"UNKNOWN": 20,
    b"APPROXIMATE": 60,
    b"COARSEADJUSTING": 80,
    b"COARSE": 100,
    b"COARSESTEERING": 120,
    b"FREEWHEELING": 130,
    b"FINEADJUSTING": 140,
    b"FINE": 160,
    b"FINEBACKUPSTEERING": 170,
    b"FINESTEERING": 180,
    b"SATTIME": 200,
    b"EXTERN": 220,
    b"EXACT": 240,
}


class Log(NamedTuple):
    """A sound log: ``key`` is its name, or its number if it is binary; ``gps_ms`` since 1980.

    ``antenna`` is 0 for the primary one. ``definition`` tells which definition of its fields it
    follows, None in a short header, ``time_status`` how well the receiver knew the time, None if
    the log does not say. ``room`` is how many bytes its fields have, of text how many fields.
    """

    key: str | int
    antenna: int
    gps_ms: int
    time_status: int | None
    definition: int | None
    response: bool
    binary: bool
    room: int
    content: bytes


def crc32(content: bytes) -> int:
    """Return NovAtel's CRC-32: that of zlib, begun and ended with zeros."""
    return zlib.crc32(content, 0xFFFFFFFF) ^ 0xFFFFFFFF


class Frames:
    """The logs of ``source``; ``faults`` counts everything else. InputError on no file."""

    def __init__(self, source: Path, faults: Counter[str]) -> None:
        self._source = source
        self._faults = faults
        self._line_end = -1
        self._read = 0
        self._wasted = 0

    def __iter__(self) -> Iterator[Log]:
        """Yield the logs."""
        kept = b""
        for block in blocks(self._source):
            self._read += len(block)
            kept += block
            kept = kept[(yield from self._find_logs(kept, False)) :]
        yield from self._find_logs(kept, True)

    def _find_logs(self, data: bytes, last: bool) -> Generator[Log, None, int]:
        """Yield the logs in ``data``; return up to where nothing more can be had from it."""
        at = done = 0
        self._line_end = -1
        while start := START.search(data, at):
            at = start.start()
            end = self._end(data, at)
            if end > len(data) and not last:
                break
            log = _log(data[at:end], end - at)
            if log is None:
                self._waste(end - at)
                at = start.end()
                continue
            _count_left(data[done:at], self._faults)
            yield log
            at = done = end
        else:
            at = max(at, len(data) if last else _whole_lines(data, at))
        _count_left(data[done:at], self._faults)
        return at

    def _waste(self, size: int) -> None:
        self._faults["damaged"] += 1
        self._wasted += size
        if self._wasted > WASTE * (self._read + BLOCK):
            raise InputError(f"{self._source}: beginnings of NovAtel logs throughout, and no log")

    def _end(self, data: bytes, at: int) -> int:
        """Return where the log that begins at ``at`` ends if it is one, beyond ``data`` if cut."""
        if data[at] == 0xAA:
            return at + _length(data[at : at + LONG_HEADER.size])
        if self._line_end <= at:
            found = LINE_END.search(data, at)
            self._line_end = found.start() if found else len(data) + 1
        return min(self._line_end, at + LONGEST)


def _whole_lines(data: bytes, at: int) -> int:
    """Return up to where no log can begin; sentences between logs are left whole."""
    cut = max(at, len(data) - NEEDED)
    return max(at, data.rfind(b"\n", at, cut) + 1) if cut - at < LONGEST else cut


def _length(header: bytes) -> int:
    """Return how long a binary log is by its header, `NEEDED` if that is cut, 0 if not valid."""
    if len(header) < SHORT_HEADER.size:
        return NEEDED
    if header[2] == 0x13:
        return SHORT_HEADER.size + header[3] + 4
    length = int.from_bytes(header[8:10], "little")
    fits = length <= LONGEST and header[3] >= LONG_HEADER.size
    return header[3] + length + 4 if fits else 0


def is_sound(data: bytes, at: int) -> bool:
    """Tell whether a whole binary log with a right checksum begins at ``at``."""
    size = _length(data[at : at + LONG_HEADER.size])
    return _log(data[at : at + size], size) is not None


def _count_left(data: bytes, faults: Counter[str]) -> None:
    rest = data.strip(b"\r\n \0")
    if rest:
        faults["nmea"] += len(NMEA.findall(rest))
        faults["abbreviated"] += len(ABBREVIATED.findall(rest))
        faults["bytes"] += len(rest)


def _log(data: bytes, size: int) -> Log | None:
    """Return the log that ``data`` is, None if its checksum, size or header is wrong."""
    if data[:1] in (b"#", b"%"):
        return _text(data)
    if not size or len(data) < size or crc32(data[:-4]) != int.from_bytes(data[-4:], "little"):
        return None
    if data[2] == 0x13:
        _, length, number, week, ms = SHORT_HEADER.unpack_from(data)
        return Log(number, 0, week * WEEK_MS + ms, None, None, False, True, length, data)
    _, _, number, kind, _, length, _, _, status, week, ms, _, definition, _ = (
        LONG_HEADER.unpack_from(data)
    )
    answer, antenna = bool(kind & 0x80), kind & 0x1F
    when = week * WEEK_MS + ms
    return Log(number, antenna, when, status, definition, answer, True, length, data)


def _text(data: bytes) -> Log | None:
    found = TEXT.match(data)
    if found is None or crc32(data[1 : found.start("sum") - 1]) != int(found["sum"], 16):
        return None
    header = found["header"].split(b",")
    status, definition = None, None
    try:
        if found["sync"] == b"#":
            status = TIME_STATUS.get(header[3], 20)
            definition = int(header[7], 16)
            header = header[4:]
        when = int(header[0]) * WEEK_MS + round(float(header[1]) * 1000)
    except (IndexError, ValueError, OverflowError):
        return None
    if not 0 <= when < 1 << 50:
        return None
    antenna = int(found["antenna"][1:]) if found["antenna"] else 0
    fields = _fields(found["body"])
    name = found["name"].decode("ascii")
    answer = found["kind"] == b"R"
    return Log(name, antenna, when, status, definition, answer, False, fields, data + b"\r\n")


def _fields(body: bytes) -> int:
    """Return how many fields ``body`` has; commas in quotes separate nothing."""
    if b'"' not in body:
        return body.count(b",") + 1
    return sum(part.count(b",") for part in body.split(b'"')[::2]) + 1
