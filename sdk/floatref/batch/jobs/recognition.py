"""What a file or folder in a tree is: a recording, a profile, a folder of more, or neither."""

import os
from collections.abc import Iterator
from enum import Enum
from pathlib import Path

from floatref.batch.jobs.job import PROFILES, RECORDS
from floatref.batch.jobs.manifest import is_manifest
from floatref.batch.jobs.natural_order import natural_key
from floatref.engine.plugins import plugins
from floatref.engine.recordings.readers import find_readers
from floatref.errors import InputError
from floatref.files.profile_directory import DOCUMENT as PROFILE
from floatref.files.profile_directory import FORMAT
from floatref.files.recording_directory import DOCUMENT as RECORDING
from floatref.files.sources import open_bytes
from floatref.interfaces.adapter import RecordingDirectory

TABLES = (".csv", ".tsv", ".txt")
SUFFIXES = frozenset(
    f".{name}"
    for names in (
        ("mf4", "mdf", "mcap", "dat", "tdms", "h5", "hdf", "hdf5", "mat", "nc"),
        ("parquet", "arrow", "arrows", "ipc", "feather", "csv", "tsv"),
        ("nmea", "gps", "asc", "blf", "trc"),
    )
    for name in names
)
"""Suffixes of recordings: such a file counts even if its first bytes are corrupt.

Suffixes that many other files have, such as .log, .bin and .txt, are not included.
"""
MARKS = (".lock", "batch.json")
"""The output of a batch always contains at least one of these files."""
PARQUET = b"PAR1"
LARGEST_FOOTER = 1 << 22


class Kind(Enum):
    """What is done with an entry of a folder tree."""

    SOURCE = "source"
    FOLDER = "folder"
    OTHER = "other"


def kind_of_folder(path: Path, adapter: str | None) -> Kind:
    """Return the kind of the folder ``path``; unless None, ``adapter`` alone reads sources."""
    if found := find_readers(path):
        wanted = adapter is None or adapter in (reader.name for reader in found)
        return Kind.SOURCE if wanted else Kind.OTHER
    ours = (path / PROFILE).is_file() or is_output(path)
    return Kind.OTHER if ours else Kind.FOLDER


def kind_of_file(path: Path, adapter: str | None) -> Kind:
    """Return the kind of the file ``path``; unless None, ``adapter`` alone reads sources."""
    suffix = path.suffix.lower()
    if not path.is_file():
        # A broken link may have been a recording; reading a pipe may block.
        return Kind.SOURCE if suffix in SUFFIXES and not path.exists() else Kind.OTHER
    if is_profile(path) or (suffix in TABLES and is_manifest(path)):
        return Kind.OTHER
    if adapter is None and suffix in SUFFIXES:
        return Kind.SOURCE
    names = [reader.name for reader in find_readers(path)]
    if adapter is None:
        return Kind.SOURCE if names else Kind.OTHER
    return Kind.SOURCE if adapter in names or (not names and suffix in SUFFIXES) else Kind.OTHER


def is_recording(path: Path) -> bool:
    """Tell whether ``path`` is a recording directory of ours, or its recording.json."""
    return RecordingDirectory().recognises(path)


def is_inside(path: Path) -> bool:
    """Tell whether ``path`` is a file that belongs to a recording or profile directory."""
    return path.name != RECORDING and any(
        path.with_name(name).is_file() for name in (RECORDING, PROFILE)
    )


def is_output(path: Path) -> bool:
    """Tell whether the folder ``path`` is the output of a batch."""
    if not ((path / PROFILES).is_dir() and (path / RECORDS).is_dir()):
        return False
    return any((path / name).is_file() for name in MARKS)


def is_profile(path: Path) -> bool:
    """Tell from its first and last bytes whether ``path`` is a profile of a format of its suffix.

    Parquet files begin alike; of a profile the footer names our format.
    """
    suffix = path.suffix.lower()
    try:
        if suffix == ".parquet":
            return FORMAT.encode() in _footer(path)
        formats = plugins().profile_formats().values()
        return any(form.recognises(path) for form in formats if form.suffix == suffix != "")
    except (InputError, OSError):
        return False


def _footer(path: Path) -> bytes:
    """Return the end of a Parquet file, which holds its metadata; empty for any other."""
    with open_bytes(path) as stream:
        end = stream.seek(0, os.SEEK_END)
        stream.seek(max(0, end - 8))
        tail = stream.read(8)
        size = int.from_bytes(tail[:4], "little")
        if tail[4:] != PARQUET or not size <= min(LARGEST_FOOTER, end - 8):
            return b""
        stream.seek(end - 8 - size)
        return stream.read(size)


def walk(
    folder: Path, out: str, adapter: str | None, file_adapter: str | None
) -> Iterator[tuple[Path, Kind]]:
    """Yield every source below ``folder``, and every other file, which is skipped.

    Unless None, ``adapter`` alone reads folders, and ``file_adapter`` files. The resolved path
    ``out`` is not searched. Raises InputError for a folder that cannot be listed.
    """
    waiting = _list(folder)
    while waiting:
        entry = waiting.pop()
        path = Path(entry.path)
        if not os.path.isdir(entry):
            yield path, kind_of_file(path, file_adapter)
        elif entry.is_symlink():
            yield path, Kind.OTHER
        elif os.path.realpath(path) != out:
            kind = kind_of_folder(path, adapter)
            if kind is Kind.FOLDER:
                waiting += _list(path)
            else:
                yield path, kind


def size_of(path: Path) -> int:
    """Return the bytes of the file ``path``, or of all files in the folder; 0 if it is unknown."""
    try:
        if not path.is_dir():
            return path.stat().st_size
        with os.scandir(path) as entries:
            return sum(
                size_of(Path(e.path)) if e.is_dir(follow_symlinks=False) else e.stat().st_size
                for e in entries
            )
    except OSError:
        return 0


def _list(folder: Path) -> list[os.DirEntry[str]]:
    """Return what is in ``folder``, the first by name last: it is taken from the end."""
    try:
        with os.scandir(folder) as entries:
            shown = [entry for entry in entries if not entry.name.startswith(".")]
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"{folder}: {reason}; make it readable, or leave it out") from error
    return sorted(shown, key=lambda entry: natural_key(entry.name), reverse=True)
