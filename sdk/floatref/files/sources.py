"""Opening files for reading; every error of the operating system becomes one clear line."""

import os
import stat
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from io import BufferedReader
from pathlib import Path

from floatref.errors import InputError, one_line


@contextmanager
def open_bytes(path: Path) -> Iterator[BufferedReader]:
    """Open the regular file ``path`` for reading bytes.

    Raises InputError naming ``path`` if it is missing, a folder, a device, a loop of links, or
    may not be read.
    """
    with ExitStack() as stack:
        with _refusals(path):
            # Opening a named pipe would wait for a writer, so the kind is checked first.
            _check_kind(path, os.stat(path).st_mode)
            stream = stack.enter_context(open(path, "rb"))
        yield stream


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
