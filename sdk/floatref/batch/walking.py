"""Everything in a tree of folders, in order, without what is hidden, and never through links."""

import os
from collections.abc import Iterator
from pathlib import Path

from floatref.batch.recognition import Kind, kind_of_file, kind_of_folder
from floatref.errors import InputError


def walked(
    folder: Path, out: str, adapter: str | None, file_adapter: str | None
) -> Iterator[tuple[Path, Kind]]:
    """Yield every source below ``folder``, and every other thing that is passed over.

    ``adapter`` alone is to read folders, and ``file_adapter`` files, unless None. Nothing is
    looked for in ``out``, a resolved path. Raises InputError for a folder that cannot be listed.
    """
    waiting = _listed(folder)
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
                waiting += _listed(path)
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


def _listed(folder: Path) -> list[os.DirEntry[str]]:
    """Return what is in ``folder``, the first by name last: it is taken from the end."""
    try:
        with os.scandir(folder) as entries:
            shown = [entry for entry in entries if not entry.name.startswith(".")]
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"{folder}: {reason}; make it readable, or leave it out") from error
    return sorted(shown, key=lambda entry: entry.name, reverse=True)
