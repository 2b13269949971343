"""Lists of files: a path a line, or a CSV that says how to process each."""

import csv
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

from floatref.batch.jobs.defaults import Defaults, read_given_map
from floatref.errors import InputError
from floatref.files.settings_file import read_settings
from floatref.files.sources import name_errors, open_bytes
from floatref.values.display.similar_names import suggest

COLUMNS = ("file", "adapter", "map", "pipeline", "settings")
COMMENT = "#"
DELIMITERS = ",;\t"
HEAD = 1 << 16
"""Bytes from which a manifest is recognised."""
TRIED = 20
"""First lines of a list, at least one of which must name an existing file."""
LARGEST_BYTES = 1 << 28

Line = tuple[int, str]


@dataclass(frozen=True)
class Entry:
    """A file that a manifest names, and what it is processed with."""

    path: Path
    options: Defaults


def is_manifest(path: Path) -> bool:
    """Tell whether the file ``path`` is a manifest; an unreadable file is not.

    Its first line that is neither empty nor a comment heads a column `file`, or one of the first
    lines is a path, from the folder of the manifest, that exists.
    """
    try:
        with open_bytes(path) as stream:
            start = stream.read(HEAD)
    except InputError:
        return False
    if b"\0" in start:
        return False
    lines = list(islice(_lines(start.decode("utf-8-sig", "replace")), TRIED))
    if lines and _columns(lines[0][1]):
        return True
    return any(_exists(path.parent, text) for _, text in lines)


def read_manifest(path: Path, options: Defaults) -> tuple[Entry, ...]:
    """Return the files of the manifest ``path``, with ``options`` as defaults.

    Raises InputError with one line naming the manifest, the line and the value for unknown columns,
    lines without a file, and options that no file can be processed with.
    """
    with open_bytes(path) as stream:
        content = stream.read(LARGEST_BYTES + 1)
    with name_errors(path):
        if len(content) > LARGEST_BYTES:
            raise InputError("larger than 256 MiB; divide the list")
        try:
            lines = list(_lines(content.decode("utf-8-sig")))
        except UnicodeDecodeError as error:
            raise InputError(f"byte {error.start} is not UTF-8; save the list as UTF-8") from error
        return tuple(_Reading(path.parent, options).entries(lines))


class _Reading:
    """One manifest in ``folder``; each way to process is checked once."""

    def __init__(self, folder: Path, options: Defaults) -> None:
        self._folder, self._options = folder, options
        self._known: dict[tuple[str, ...], Defaults] = {}

    def entries(self, lines: Sequence[Line]) -> Iterator[Entry]:
        columns = _columns(lines[0][1]) if lines else None
        if columns is not None:
            _check_columns(columns)
        for number, text in lines[columns is not None :]:
            with name_errors(f"line {number}"):
                row = {"file": text} if columns is None else _row(columns, text, lines[0][1])
                yield Entry(self._path(row["file"]), self._options_of(row))

    def _options_of(self, row: Mapping[str, str]) -> Defaults:
        given = tuple(row.get(name, "") for name in COLUMNS[1:])
        if given not in self._known:
            self._known[given] = self._choose(*given)
        return self._known[given]

    def _choose(self, adapter: str, channel_map: str, pipeline: str, settings: str) -> Defaults:
        chosen = replace(
            self._options,
            adapter=adapter or self._options.adapter,
            channel_map=self._path(channel_map) if channel_map else self._options.channel_map,
            pipeline=pipeline or self._options.pipeline,
            settings=read_settings(self._path(settings)) if settings else self._options.settings,
        )
        read_given_map(chosen)
        return chosen

    def _path(self, text: str) -> Path:
        if "\0" in text:
            raise InputError(f"{text!a}: not a valid file name; correct it")
        return self._folder / text


def _lines(text: str) -> Iterator[Line]:
    """Yield number and text of every line that is neither empty nor a comment."""
    for number, line in enumerate(text.split("\n"), 1):
        plain = line.strip()
        if plain and not plain.startswith(COMMENT):
            # A last column may be empty; the tab before it marks it.
            yield number, line.strip(" \r")


def _columns(header: str) -> tuple[str, ...] | None:
    """Return the columns that ``header`` names; None if it is no header with a column `file`."""
    try:
        names = tuple(name.strip().lower() for name in _fields(header, header))
    except csv.Error:
        return None
    return names if "file" in names else None


def _check_columns(columns: Sequence[str]) -> None:
    for name in columns:
        if name not in COLUMNS:
            raise InputError(f"column {name!r}: unknown; {suggest(name, COLUMNS)}")
        if columns.count(name) > 1:
            raise InputError(f"column {name}: given {columns.count(name)} times; keep one")


def _row(columns: Sequence[str], text: str, header: str) -> dict[str, str]:
    try:
        values = [value.strip() for value in _fields(text, header)]
    except csv.Error as error:
        raise InputError(f"not a valid line of a CSV ({error}); correct it there") from error
    if len(values) > len(columns):
        raise InputError(
            f"{len(values)} values in {len(columns)} columns; quote a name with commas"
        )
    row = dict(zip(columns, values, strict=False))
    if not row.get("file"):
        raise InputError("no file; name one in the column file")
    return row


def _fields(text: str, header: str) -> list[str]:
    delimiter = next((d for d in DELIMITERS if d in header), DELIMITERS[0])
    return next(csv.reader([text], delimiter=delimiter, strict=True, skipinitialspace=True))


def _exists(folder: Path, text: str) -> bool:
    try:
        return os.path.exists(folder / text)
    except ValueError:
        return False
