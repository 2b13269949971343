"""The header of an ERD file: its second line, and keyword lines up to END.

Sources of the layout are in docs/erd.md. A keyword fills the first eight characters of a line;
a line that begins with & goes on with the keyword above it.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from floatref import InputError

MARK = b"ERDFILE"
VERSION = b"ERDFILEV2"
BYTE_ORDER_MARK = b"\xef\xbb\xbf"
LONGEST_HEADER = 1 << 20
"""Bytes in which END has to turn up: 87 channels of a vehicle model take 10 KB."""
MOST_CHANNELS = 10_000
MOST_DIGITS = 18
KEYWORD = 8
SHORT_FIELD, LONG_FIELD = 8, 32
"""Characters of a name or unit of one channel, and of a long name."""
TEXT, REAL = 5, 1
"""KEYNUM of numbers as text in the file itself, and of 4-byte reals in a file of their own."""

_LINE = re.compile(rb"([^\r\n]*)(\r\n|\r|\n|\Z)")
Entries = dict[str, list[list[str]]]


@dataclass(frozen=True)
class ErdChannel:
    """One channel as the header names it; "" is what it does not say."""

    short: str
    long: str
    unit: str

    @property
    def title(self) -> str:
        """How an error text calls the channel."""
        return self.short or self.long or "without a name"


@dataclass(frozen=True)
class ErdHeader:
    """What a header says; `samples` is None where it leaves the count open.

    `step` and `start` are in `x_unit`; `data_at` is the byte after the line END.
    """

    channels: tuple[ErdChannel, ...]
    samples: int | None
    record_bytes: int
    key: int
    step: float
    start: float
    x_unit: str
    title: str
    history: tuple[str, ...]
    data_at: int


def parse_header(raw: bytes) -> ErdHeader:
    """Return the header in ``raw``, the first `LONGEST_HEADER` bytes of a file.

    Raises InputError, without the file's name, for bytes that are not a header or a header
    that cannot be used.
    """
    if not raw.removeprefix(BYTE_ORDER_MARK).startswith(VERSION):
        start = raw[:24].decode("latin-1")
        raise InputError(f"begins with {start!r}; an ERD file begins with ERDFILEV2.00")
    lines, data_at = _lines(raw)
    if len(lines) < 2:
        raise InputError("the second line, with the number of channels, is missing; copy it again")
    numbers = re.split(r"[,\s]+", lines[1].decode("latin-1").strip(", \t"))
    if len(numbers) < 6:
        raise InputError(
            f"second line has {len(numbers)} numbers; it needs NCHAN, NSAMP, NRECS, NBYTES, KEYNUM "
            "and STEP"
        )
    count = _integer(numbers[0], "NCHAN")
    if not 1 <= count <= MOST_CHANNELS:
        raise InputError(f"NCHAN is {count}; a profile has 1 to {MOST_CHANNELS} channels")
    samples = _integer(numbers[1], "NSAMP")
    entries = _entries(_printable(line) for line in lines[2:])
    return ErdHeader(
        channels=_channels(entries, count),
        samples=samples if samples >= 0 else None,
        record_bytes=_integer(numbers[3], "NBYTES"),
        key=_integer(numbers[4], "KEYNUM"),
        step=_real(numbers[5], "STEP"),
        start=_real(_text(entries, "XSTART") or "0", "XSTART"),
        x_unit=_text(entries, "XUNITS"),
        title=_text(entries, "TITLE"),
        history=tuple("".join(pieces).strip() for pieces in entries.get("HISTORY", [])),
        data_at=data_at,
    )


def _lines(raw: bytes) -> tuple[list[bytes], int]:
    """Return the lines before END, and the byte after it."""
    lines: list[bytes] = []
    first = len(BYTE_ORDER_MARK) if raw.startswith(BYTE_ORDER_MARK) else 0
    for found in _LINE.finditer(raw, first):
        if found[1].strip() == b"END" and lines:
            return lines, found.end()
        if found.end() == len(raw):
            break
        lines.append(found[1])
    if len(raw) >= LONGEST_HEADER:
        raise InputError(f"no line END in the first {LONGEST_HEADER >> 20} MiB; is this ERD?")
    raise InputError("no line END after the header; the file is truncated, copy it again")


def _printable(line: bytes) -> str:
    return "".join(c if c.isprintable() else " " for c in line.decode("latin-1"))


def _entries(lines: Iterator[str]) -> Entries:
    """Return what stands behind every keyword: for each of its lines, that and its &-lines."""
    entries: Entries = {}
    pieces: list[str] = []
    for line in lines:
        keyword, text = line[:KEYWORD], line[KEYWORD:]
        if keyword.startswith("&"):
            pieces.append(text)
        elif keyword.strip():
            pieces = [text]
            entries.setdefault(keyword.strip().upper(), []).append(pieces)
    return entries


def _text(entries: Entries, keyword: str) -> str:
    return "".join(entries.get(keyword, [[]])[0]).strip()


def _channels(entries: Entries, count: int) -> tuple[ErdChannel, ...]:
    short = _fields(entries, "SHORTNAM", SHORT_FIELD, count)
    long = _fields(entries, "LONGNAME", LONG_FIELD, count)
    units = _text(entries, "UNITSNAM").split()
    if len(units) != count:
        units = _fields(entries, "UNITSNAM", SHORT_FIELD, count)
    return tuple(map(ErdChannel, short, long, units))


def _fields(entries: Entries, keyword: str, width: int, count: int) -> list[str]:
    fields = [
        piece[first : first + width].strip()
        for piece in entries.get(keyword, [[]])[0]
        for first in range(0, len(piece), width)
    ]
    return (fields + [""] * count)[:count]


def _integer(text: str, name: str) -> int:
    if not re.fullmatch(rf"[+-]?[0-9]{{1,{MOST_DIGITS}}}", text):
        raise InputError(f"{name} is {text[:40]!r}; it must be a whole number")
    return int(text)


def _real(text: str, name: str) -> float:
    if not re.fullmatch(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eEdD][+-]?[0-9]+)?", text):
        raise InputError(f"{name} is {text[:40]!r}; it must be a number with a decimal point")
    return float(re.sub("[dD]", "e", text))
