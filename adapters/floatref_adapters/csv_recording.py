"""A recording as one CSV table: column `time_s`, then one column per channel.

A channel's column is called `<channel>` or `<track>.<channel>` and is in that channel's SI
unit. Fields are separated by commas, decimals by points; an empty field or `nan` is a missing
sample. Every row has a time.
"""

import csv
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, InputError, Recording
from floatref_adapters.stamps import clock_of, decimals_of

TIME = "time_s"
ROWS = 1 << 16
"""Rows handled together."""
LATEST_S = 1e12
"""Largest time from zero in s, whatever the epoch."""
SAMPLED = 1000
"""Rows in which the decimals of the time are counted."""

Floats = NDArray[np.float64]
Rows = list[list[str]]


class CsvRecording:
    """The adapter of such a table."""

    name = "csv"
    summary = "CSV table: time_s, then <channel> or <track>.<channel> in SI units"

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` is a .csv file whose first column is `time_s`."""
        if source.suffix.lower() != ".csv" or not source.is_file():
            return False
        try:
            with source.open("rb") as stream:
                start = stream.readline(256)
        except OSError:
            return False
        return start.decode("utf-8-sig", "replace").lstrip(' "').startswith(TIME)

    def read(self, source: Path) -> Recording:
        """Return the recording in the table ``source``.

        All channels are on one clock: a uniform one if the times keep a constant rate as far as
        their decimals tell, else one of time stamps. Raises InputError in one line naming the
        file, the row, the column and the value for anything else than such a table.
        """
        if not source.is_file():
            raise InputError(f"{source}: not a file; give a CSV table with column {TIME}")
        try:
            with source.open(encoding="utf-8-sig", newline="") as stream:
                return _recording(csv.reader(stream, strict=True))
        except InputError as error:
            raise InputError(f"{source}: {error}") from error
        except UnicodeDecodeError as error:
            raise InputError(f"{source}: not UTF-8 text; export it as CSV in UTF-8") from error
        except csv.Error as error:
            raise InputError(f"{source}: not a CSV ({error}); export it again") from error
        except OSError as error:
            raise InputError(f"{source}: {error.strerror or error}; make it readable") from error


def _recording(reader: Iterator[list[str]]) -> Recording:
    header = _header(reader)
    columns, decimals = _columns(reader, header)
    clock = clock_of(columns[0], decimals)
    channels = []
    for name, values in zip(header[1:], columns[1:], strict=True):
        track, _, channel = name.rpartition(".")
        channels.append(Channel.of(channel, values, clock, track or None))
    return Recording(tuple(channels))


def _header(reader: Iterator[list[str]]) -> list[str]:
    header = [name.strip() for name in next(reader, [])]
    if len(header) == 1 and (";" in header[0] or "\t" in header[0]):
        raise InputError(
            "columns are not separated by commas; export with commas and decimal points"
        )
    if header[:1] != [TIME]:
        raise InputError(f"first column is {', '.join(header[:1])!r}; it must be {TIME}, in s")
    if len(header) == 1:
        raise InputError(f"column {TIME} stands alone; add one column per channel")
    for name in header:
        if header.count(name) > 1:
            raise InputError(f"column {name}: given twice; rename one of them")
    return header


def _columns(reader: Iterator[list[str]], header: list[str]) -> tuple[list[Floats], int]:
    """Return the numbers of every column, and the decimals that the times are written with."""
    parts: list[list[Floats]] = [[] for _ in header]
    first, decimals = 2, 0
    while rows := list(islice(reader, ROWS)):
        _check_widths(rows, header, first)
        for part, name, texts in zip(parts, header, zip(*rows, strict=True), strict=True):
            part.append(_numbers(texts, name, first))
        if first == 2:
            decimals = max(decimals_of(row[0]) for row in rows[:SAMPLED])
        first += len(rows)
    if first == 2:
        raise InputError("no rows below the header; copy the complete file")
    return [np.concatenate(part) for part in parts], decimals


def _check_widths(rows: Rows, header: list[str], first: int) -> None:
    for number, row in enumerate(rows, first):
        if len(row) == len(header):
            continue
        advice = "the file is truncated, or a line is empty"
        if len(row) > len(header):
            advice = "write decimal points, not decimal commas"
        raise InputError(f"row {number} has {len(row)} fields, the header {len(header)}; {advice}")


def _numbers(texts: tuple[str, ...], name: str, first: int) -> Floats:
    try:
        numbers = np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        bad = next(i for i, text in enumerate(texts) if not _is_number(text))
        advice = "write a number with a decimal point, or leave a missing sample empty"
        if _is_number(texts[bad].replace(",", ".")):
            advice = "write a decimal point, not a decimal comma"
        raise InputError(f"row {first + bad}: {name} is {texts[bad][:40]!r}; {advice}") from None
    usable = np.abs(numbers) <= LATEST_S
    if name == TIME and not usable.all():
        bad = int(np.argmin(usable))
        raise InputError(
            f"row {first + bad}: {name} is {texts[bad][:40]!r}; "
            f"every row needs its time in s, within {LATEST_S:g} s of zero"
        )
    return numbers


def _is_number(text: str) -> bool:
    try:
        float(text or "nan")
    except ValueError:
        return False
    return True
