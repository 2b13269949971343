"""What a file or folder in a tree is: a recording, a profile, a folder of more, or neither."""

import os
from enum import Enum
from pathlib import Path

from floatref.architectures.adapter import RecordingDirectory
from floatref.architectures.profile_format import ProfileTable
from floatref.architectures.readers import recognising
from floatref.batch.job import PROFILES, RECORDS
from floatref.batch.manifest import is_manifest
from floatref.files.profile import DOCUMENT as PROFILE
from floatref.files.profile import FORMAT
from floatref.files.recording import DOCUMENT as RECORDING

TABLES = (".csv", ".tsv", ".txt")
SUFFIXES = frozenset(
    f".{name}"
    for names in (
        ("mf4", "mdf", "dat", "tdms", "h5", "hdf", "hdf5", "mat", "nc"),
        ("parquet", "arrow", "arrows", "ipc", "feather", "csv", "tsv"),
        ("nmea", "gps", "asc", "blf", "trc"),
    )
    for name in names
)
"""Suffixes of recordings: with one a file counts even if its first bytes are damaged.

Those that programs give to much else, such as .log, .bin and .txt, are not among them.
"""
MARKS = (".lock", "batch.json")
"""Files of which the output of a batch has one from its first moment to its last."""
PARQUET = b"PAR1"
LARGEST_FOOTER = 1 << 22


class Kind(Enum):
    """What is done with a thing in a tree."""

    SOURCE = "source"
    FOLDER = "folder"
    OTHER = "other"


def kind_of_folder(path: Path, adapter: str | None) -> Kind:
    """Return what the folder ``path`` is; ``adapter`` alone is to read sources, unless None."""
    if found := recognising(path):
        wanted = adapter is None or adapter in (reader.name for reader in found)
        return Kind.SOURCE if wanted else Kind.OTHER
    ours = (path / PROFILE).is_file() or is_output(path)
    return Kind.OTHER if ours else Kind.FOLDER


def kind_of_file(path: Path, adapter: str | None) -> Kind:
    """Return what the file ``path`` is; ``adapter`` alone is to read sources, unless None."""
    suffix = path.suffix.lower()
    if not path.is_file():
        # A link that leads nowhere may have been a recording; a pipe would be waited for.
        return Kind.SOURCE if suffix in SUFFIXES and not path.exists() else Kind.OTHER
    if is_profile(path) or (suffix in TABLES and is_manifest(path)):
        return Kind.OTHER
    if adapter is None and suffix in SUFFIXES:
        return Kind.SOURCE
    names = [reader.name for reader in recognising(path)]
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
    """Tell whether the folder ``path`` is what a batch writes or has written."""
    if not ((path / PROFILES).is_dir() and (path / RECORDS).is_dir()):
        return False
    return any((path / name).is_file() for name in MARKS)


def is_profile(path: Path) -> bool:
    """Tell from its ends whether the file ``path`` is a profile as floatref writes it."""
    try:
        suffix = path.suffix.lower()
        if suffix == ".csv":
            return ProfileTable().recognises(path)
        return suffix == ".parquet" and FORMAT.encode() in _footer(path)
    except OSError:
        return False


def _footer(path: Path) -> bytes:
    """Return the end of a Parquet file, which holds its metadata; empty for any other."""
    with path.open("rb") as stream:
        end = stream.seek(0, os.SEEK_END)
        stream.seek(max(0, end - 8))
        tail = stream.read(8)
        size = int.from_bytes(tail[:4], "little")
        if tail[4:] != PARQUET or not size <= min(LARGEST_FOOTER, end - 8):
            return b""
        stream.seek(end - 8 - size)
        return stream.read(size)
