"""Copy the folder of plain files that a device delivers, before anything reads it.

The device cannot change the copy while it is read.
"""

import os
import stat
from collections.abc import Collection
from itertools import islice
from pathlib import Path

from floatref_conformance.devices.process import readable
from floatref_conformance.errors import DeviceError

MAX_FILES = 1000
"""Largest number of files in a profile directory."""
MAX_BYTES = 256 << 20
"""Largest size of a profile directory in bytes: 13 million points with flags and sigma."""

CHUNK = 1 << 20
FLAGS = os.O_RDONLY | getattr(os, "O_BINARY", 0)
FLAGS |= getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
"""To open a file that may have become a link or a pipe since it was inspected."""


def take(source: Path, target: Path, without: Collection[str] = ()) -> None:
    """Copy the profile directory ``source`` to a new folder ``target``.

    Names in ``without`` and folders are not copied. Raises DeviceError if there is no such folder,
    if it is a symbolic link, if it contains a link, a pipe or another special file, or if it is
    too large.
    """
    try:
        if source.is_symlink():
            raise DeviceError("delivered a symbolic link in place of a profile directory")
        if not source.is_dir():
            raise DeviceError("delivered no profile directory")
        target.mkdir()
        remaining = MAX_BYTES
        for name in _names(source):
            if name not in without:
                remaining -= _copy(source / name, target / name, remaining)
    except OSError as error:
        raise DeviceError(f"delivered what cannot be read: {error.strerror}") from error


def _names(folder: Path) -> list[str]:
    """Return the names in ``folder``; DeviceError if there are too many."""
    with os.scandir(folder) as entries:
        names = [entry.name for entry in islice(entries, MAX_FILES + 1)]
    if len(names) > MAX_FILES:
        raise DeviceError(f"delivered more than {MAX_FILES} files")
    return names


def _copy(source: Path, target: Path, limit: int) -> int:
    """Copy ``source``, which may have ``limit`` bytes at most, and return its size in bytes."""
    found = source.lstat()
    kind = found.st_mode
    if stat.S_ISDIR(kind):
        return 0
    if not stat.S_ISREG(kind):
        what = "a symbolic link" if stat.S_ISLNK(kind) else "not a plain file"
        raise DeviceError(f"delivered {readable(source.name)}, which is {what}")
    size = found.st_size
    if size <= limit:
        # The file may grow while it is read.
        size = _read_into(target, source, limit + 1)
    if size > limit:
        raise DeviceError(f"delivered more than {MAX_BYTES >> 20} MiB")
    return size


def _read_into(target: Path, source: Path, most: int) -> int:
    """Copy at most ``most`` bytes of ``source``, and return the number of bytes copied."""
    copied = 0
    with os.fdopen(os.open(source, FLAGS), "rb") as stream, open(target, "wb") as copy:
        while chunk := stream.read(min(CHUNK, most - copied)):
            copied += copy.write(chunk)
    return copied
