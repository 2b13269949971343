"""Folders for temporary files that are gone after their process, even if that is killed."""

import atexit
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from floatref.errors import InputError
from floatref.files.owners import own_name, owner_mark, sweep_once

_MADE: set[Path] = set()
"""Folders that are not removed yet: a signal may come before, or in, their removal."""


def make_scratch(purpose: str) -> Path:
    """Return a new folder where the system keeps temporary files (`TMPDIR`).

    Its name has the mark of this process and ends with ``purpose``. `remove_scratch` removes it,
    or else the end of the process. What killed processes left beside it is removed first. Raises
    InputError if no folder can be made.
    """
    try:
        parent = Path(tempfile.gettempdir())
        sweep_once(parent)
        folder = parent / own_name("floatref-", f"-{purpose}")
        _MADE.add(folder)
        folder.mkdir(mode=0o700)
    except OSError as error:
        raise InputError(
            f"no folder for {purpose}: {error.strerror or error}; set TMPDIR to one with room"
        ) from error
    return folder


def remove_scratch(folder: Path) -> None:
    """Remove a folder of `make_scratch`."""
    shutil.rmtree(folder, ignore_errors=True)
    _MADE.discard(folder)


@atexit.register
def remove_left() -> None:
    """Remove what a signal has left; folders of a process that has made this one are not ours."""
    # A copy, made at once: threads that Python does not wait for may still make folders.
    for folder in [each for each in tuple(_MADE) if owner_mark() in each.name]:
        remove_scratch(folder)


@contextmanager
def scratch_folder(purpose: str) -> Iterator[Path]:
    """Yield a folder of `make_scratch`, and remove it at the end; InputError as there."""
    folder = make_scratch(purpose)
    try:
        yield folder
    finally:
        remove_scratch(folder)
