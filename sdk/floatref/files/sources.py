"""The one door to files that are read: their kind, their length, and every error in one line.

A named pipe would wait for a writer, a device may have no end, and either may take the place of a
file after somebody has looked. So the kind is that of what has been opened, without waiting, and
no more is read than the file had then. A library that opens files itself is given a path that has
passed `check_file`.
"""

import io
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from io import BufferedReader
from pathlib import Path
from typing import Any

from floatref.errors import InputError, one_line

FLAGS = os.O_RDONLY | getattr(os, "O_BINARY", 0) | getattr(os, "O_CLOEXEC", 0)
FLAGS |= getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0)
NO_LINK = getattr(os, "O_NOFOLLOW", 0)
BUFFER = 1 << 16
"""Bytes that a reader asks of the operating system at once."""


@contextmanager
def open_bytes(path: Path, links: bool = True, grows: bool = False) -> Iterator[BufferedReader]:
    """Open the regular file ``path`` for reading the bytes that it has now.

    What is appended while it is read is left out, unless it ``grows``; of /proc, where files have
    no length, nothing is read. Without ``links`` a symbolic link is refused: another may have put
    it there. A reader of a file that grows bounds by itself what it keeps. Raises
    InputError naming ``path`` if it is missing, a folder, a device, a pipe, a socket, a loop of
    links, or may not be read.
    """
    with _refusals(path):
        # Opening a device can do something to it already.
        _check_kind(path, os.stat(path).st_mode)
        raw = _Measured(path, 0 if links else NO_LINK, grows)
        stream: BufferedReader = BufferedReader(raw, BUFFER)
    with stream:
        yield stream


def read_bytes(path: Path, most_bytes: int, what: str, links: bool = True) -> bytes:
    """Return the content of the file ``path``; InputError as `open_bytes` does, and if longer.

    ``what`` is the expected kind of file, such as "list of waivers".
    """
    with open_bytes(path, links) as stream:
        content = stream.read(most_bytes + 1)
    if len(content) > most_bytes:
        raise InputError(f"{path}: larger than any {what}, {most_bytes >> 10} KiB; name another")
    return content


def check_file(path: Path) -> Path:
    """Return ``path`` if `open_bytes` can open it, for a library that opens files itself."""
    with open_bytes(path):
        return path


def check_source(path: Path) -> Path:
    """Return ``path`` if it is a folder, or a file that `open_bytes` can open."""
    with _refusals(path):
        folder = stat.S_ISDIR(os.stat(path).st_mode)
    return path if folder else check_file(path)


def read_start(path: Path, size: int) -> bytes:
    """Return the first ``size`` bytes of the file ``path``; b"" if it cannot be opened."""
    try:
        with open_bytes(path) as stream:
            return stream.read(size)
    except (InputError, OSError):
        return b""


def real_path(path: Path) -> Path:
    """Return ``path`` without links and from the root, as far as it exists.

    `Path.resolve` raises RuntimeError for a loop of links; this leaves it to what opens it.
    """
    return Path(os.path.realpath(path))


def document_path(path: Path, name: str) -> Path:
    """Return the file ``name`` inside ``path`` if that is a folder, else ``path`` itself."""
    path = Path(path)
    return path / name if os.path.isdir(path) else path


@contextmanager
def name_errors(where: object) -> Iterator[None]:
    """Put ``where: `` in front of the text of any InputError raised inside, unless it is there."""
    try:
        yield
    except InputError as error:
        if str(error).startswith(one_line(f"{where}: ")):
            raise
        raise InputError(f"{where}: {error}") from error


class _Measured(io.FileIO):
    """A file of which no more can be read than it had when it was opened, unless it ``grows``.

    What goes wrong while it is read is an InputError that names it.
    """

    def __init__(self, path: Path, more_flags: int, grows: bool) -> None:
        # The file has its handle from the first moment: whoever closed it for a file that a signal
        # has interrupted here might close it a second time, or that of another file.
        super().__init__(path, "rb", opener=lambda *_: _open_checked(path, more_flags))
        # No library opens it anew by its name.
        self.name = handle = self.fileno()
        self._path = path
        self._size = None if grows else os.fstat(handle).st_size

    def readinto(self, buffer: Any) -> int | None:
        """Read into ``buffer`` what is left; return the number of bytes, 0 at the end."""
        with memoryview(buffer).cast("B") as view, _refusals(self._path):
            return super().readinto(view[: self._left()])

    def readall(self) -> bytes:
        """Return what is left."""
        pieces = []
        with _refusals(self._path):
            while piece := super().read(self._left()):
                pieces.append(piece)
        return b"".join(pieces)

    def _left(self) -> int:
        size = os.fstat(self.fileno()).st_size if self._size is None else self._size
        return max(size - self.tell(), 0)


def _open_checked(path: Path, more_flags: int) -> int:
    """Return the handle of what is opened at ``path``; InputError unless it is a file."""
    handle = os.open(path, FLAGS | more_flags)
    try:
        # Another thing may have taken the place of the file since it was inspected.
        _check_kind(path, os.fstat(handle).st_mode)
    except BaseException:
        os.close(handle)
        raise
    return handle


@contextmanager
def _refusals(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; {_advice(error)}") from error
    except InputError:
        raise
    except ValueError as error:
        raise InputError(f"{str(path)!a}: no possible file name; rename the file") from error


def _check_kind(path: Path, mode: int) -> None:
    if stat.S_ISDIR(mode):
        raise InputError(f"{path}: is a folder; a file is expected here")
    if not stat.S_ISREG(mode):
        raise InputError(f"{path}: is a device or pipe; a file is expected here")


def _advice(error: OSError) -> str:
    if isinstance(error, FileNotFoundError | NotADirectoryError):
        return "check the name, or copy the file there"
    if isinstance(error, PermissionError):
        return "ask for the right to read it"
    return "give the path of a readable file"
