"""The formats of CAN logs: how each is recognised, which reader it has, where its times are."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Any

from floatref import InputError, read_start
from floatref_adapters.shared.text_lines import MARK

HEAD = 1 << 13
LATEST_NS = 1 << 62
SECONDS = re.compile(r"\s*(\d{1,10})\.(\d+)\s", re.ASCII)
BRACKETED = re.compile(r"\s*\((\d{1,10})\.(\d+)\)\s", re.ASCII)


@dataclass(frozen=True)
class Format:
    """A format: ``looks`` finds it in the first bytes, ``reader`` is python-can's class.

    ``time(line, reader)`` is the time of a line in ns, None if it lacks one. ``headed`` tells that
    the reader takes a line for a header whenever it begins. ``dated`` logs count from 1970.
    """

    looks: re.Pattern[bytes]
    reader: str
    time: Callable[[str, Any], int | None]
    bus: Callable[[Any], str] = str
    suffix: str = ""
    headed: bool = False
    dated: bool = False


def _join(found: re.Match[str] | None) -> int | None:
    return int(found[1]) * 10**9 + int(found[2][:9].ljust(9, "0")) if found else None


def _asc_time(line: str, reader: Any) -> int | None:
    return _join(SECONDS.match(line))


def _candump_time(line: str, reader: Any) -> int | None:
    return _join(BRACKETED.match(line))


def _csv_time(line: str, reader: Any) -> int | None:
    return _scale(line.partition(",")[0], 9)


def _trc_time(line: str, reader: Any) -> int | None:
    fields = line.split(maxsplit=8)
    at = reader.columns.get("O", 1)
    return None if line.lstrip()[:1] in ("", ";") or at >= len(fields) else _scale(fields[at], 6)


def _scale(text: str, places: int) -> int | None:
    try:
        ticks = Decimal(text[:40]).scaleb(places)
        return round(ticks) if abs(ticks) < LATEST_NS else None
    except (InvalidOperation, ValueError):
        return None


def _count_from_one(channel: Any) -> str:
    return str(channel + 1) if isinstance(channel, int) else str(channel)


FORMATS = (
    Format(re.compile(rb"\ALOGG"), "BLFReader", _asc_time, _count_from_one),
    Format(
        re.compile(rb"\A\s*(?:date [^\r\n]*[\r\n]+\s*)?base\s+(?:hex|dec)\b", re.IGNORECASE),
        "ASCReader",
        _asc_time,
        _count_from_one,
        headed=True,
    ),
    Format(
        re.compile(rb"\Atimestamp,arbitration_id,extended,remote,error,dlc,data\s"),
        "CSVReader",
        _csv_time,
        headed=True,
        dated=True,
    ),
    Format(
        re.compile(rb"^[ \t]*\(\d+\.\d+\)[ \t]+\S+[ \t]+[0-9A-Fa-f]{3,8}#", re.MULTILINE),
        "CanutilsLogReader",
        _candump_time,
        dated=True,
    ),
    Format(re.compile(rb"^;\$FILEVERSION=", re.MULTILINE), "TRCReader", _trc_time),
    Format(
        re.compile(rb"^\s*\d+\)\s+[\d.]+\s+[0-9A-Fa-f]{4,8}\s", re.MULTILINE),
        "TRCReader",
        _trc_time,
        suffix=".trc",
    ),
)


def find_format(source: Path) -> Format | None:
    """Return the format that the first bytes of ``source`` show, None if it is unknown."""
    head = read_start(source, HEAD).removeprefix(MARK)
    # Line ends may be bare carriage returns, which ^ does not know.
    lines = head if head[:4] == b"LOGG" else head.replace(b"\r", b"\n")
    for form in FORMATS:
        if form.suffix in ("", source.suffix.lower()) and form.looks.search(lines):
            return form
    return None


def require_format(source: Path) -> Format:
    """Return the format of ``source``; InputError if it is not a CAN log."""
    if not source.is_file():
        raise InputError(f"{source}: not a file; give a CAN log")
    form = find_format(source)
    if form is None:
        raise InputError(
            f"{source}: no CAN log of Vector (ASC, BLF), candump, PEAK (TRC) or python-can (CSV); "
            "export it as one of them"
        )
    return form
