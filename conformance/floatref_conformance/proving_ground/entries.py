"""The entries of a cache folder that several processes share.

An entry is a folder whose files are listed with their checksums. It is made beside its place
and renamed, and renamed aside before it is deleted, so that no process sees half of one.
"""

import json
import os
import re
import shutil
import tempfile
import time
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from errno import EEXIST, ENOTDIR, ENOTEMPTY
from pathlib import Path

from floatref.files import open_bytes, read_bytes
from floatref.files.owners import is_abandoned, owner_mark

CHECKSUMS = "checksums.json"
NEW, OLD = ".new-", ".old-"
"""How the names of folders start that are on their way in or out."""
ABANDONED_S = 86400.0
"""A folder on its way in or out that is older belongs to a process that died."""
MARKED = re.compile(r"\.(new|old)-(?P<mark>[0-9a-f]{8}-[0-9]+-[0-9]+)-")
"""Such a name, with the mark of the process that works on the folder."""
LARGEST_LIST = 1 << 20
"""Bytes of the list of an entry's files."""
KEY_LENGTH = 32
"""Number of hexadecimal digits of an entry's name."""


@contextmanager
def new_entry(entry: Path) -> Iterator[Path]:
    """Yield an empty folder beside ``entry``; list its files and give it that name at the end.

    A damaged entry of that name makes room; an intact one that another process made meanwhile
    stays, and the new one is dropped. After an exception nothing is left.
    """
    entry.parent.mkdir(parents=True, exist_ok=True)
    beside = Path(tempfile.mkdtemp(prefix=_marked(NEW), dir=entry.parent))
    try:
        yield beside
        (beside / CHECKSUMS).write_text(json.dumps(_checksums(beside)), encoding="ascii")
        while not (_rename(beside, entry) or is_intact(entry)):
            remove(entry)
    finally:
        shutil.rmtree(beside, ignore_errors=True)


def use(entry: Path) -> bool:
    """Mark an intact entry as used now, if the disk lets it; return whether there is one."""
    if not is_intact(entry):
        return False
    try:
        os.utime(entry)
    except FileNotFoundError:
        return False
    except OSError:
        return True
    return True


def is_intact(entry: Path) -> bool:
    """Return whether an entry exists and its files are unchanged."""
    try:
        listed = json.loads(read_bytes(entry / CHECKSUMS, LARGEST_LIST, "list"))
        return bool(listed) and listed == _checksums(entry)
    except (OSError, ValueError):
        return False


def remove(entry: Path) -> None:
    """Delete an entry, out of the others' sight at once; it may have vanished already."""
    aside = Path(tempfile.mkdtemp(prefix=_marked(OLD), dir=entry.parent))
    try:
        with suppress(FileNotFoundError):
            os.rename(entry, aside / entry.name)
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def prune(folder: Path) -> None:
    """Delete what processes that died left on its way in or out of ``folder``."""
    for path in folder.iterdir():
        if path.name.startswith((NEW, OLD)) and _is_left(path):
            shutil.rmtree(path, ignore_errors=True)


def _marked(prefix: str) -> str:
    return f"{prefix}{owner_mark()}-"


def _is_left(path: Path) -> bool:
    """Return whether the process that made ``path`` has ended, as far as that can be known."""
    found = MARKED.match(path.name)
    gone = found is not None and is_abandoned(found["mark"])
    return gone or _last_used_s(path) < time.time() - ABANDONED_S


def shrink(folder: Path, kept: Path, largest_bytes: int) -> None:
    """Remove the least recently used entries, but never ``kept``, until the rest fits."""
    named = re.compile(f"[0-9a-f]{{{KEY_LENGTH}}}").fullmatch
    sizes = {path: _size(path) for path in folder.iterdir() if named(path.name)}
    for path in sorted(sizes, key=_last_used_s):
        if sum(sizes.values()) <= largest_bytes:
            return
        if path != kept:
            remove(path)
            del sizes[path]


def _rename(beside: Path, entry: Path) -> bool:
    """Give a new entry its name, unless there is one of that name."""
    try:
        os.rename(beside, entry)
    except OSError as error:
        if error.errno not in (EEXIST, ENOTEMPTY, ENOTDIR):
            raise
        return False
    return True


def _checksums(entry: Path) -> dict[str, int]:
    """Return the CRC-32 of every file of an entry but the list itself."""
    paths = [path for path in _files(entry) if path.name != CHECKSUMS]
    return {path.relative_to(entry).as_posix(): _crc(path) for path in paths}


def _files(entry: Path) -> Iterator[Path]:
    """Yield every file of an entry; nothing if the entry has vanished."""
    for folder, _, names in os.walk(entry):
        yield from (Path(folder, name) for name in names)


def _crc(path: Path) -> int:
    value = 0
    with open_bytes(path) as stream:
        while piece := stream.read(1 << 20):
            value = zlib.crc32(piece, value)
    return value


def _size(entry: Path) -> int:
    """Return the size of an entry's files in bytes; 0 if the entry has vanished."""
    total = 0
    for path in _files(entry):
        with suppress(OSError):
            total += path.stat().st_size
    return total


def _last_used_s(path: Path) -> float:
    """Return when ``path`` was last used, in s of the clock; 0 if it has vanished."""
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0
