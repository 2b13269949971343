"""Folders for temporary files that are gone after their process, even if that is killed."""

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from floatref.errors import InputError
from floatref.files.owners import own_name, sweep_once


def make_scratch(purpose: str) -> Path:
    """Return a new folder where the system keeps temporary files (`TMPDIR`).

    Its name has the mark of this process and ends with ``purpose``. What killed processes
    left beside it is removed first. Raises InputError if no folder can be made.
    """
    try:
        parent = Path(tempfile.gettempdir())
        sweep_once(parent)
        folder = parent / own_name("floatref-", f"-{purpose}")
        folder.mkdir(mode=0o700)
    except OSError as error:
        raise InputError(
            f"no folder for {purpose}: {error.strerror or error}; set TMPDIR to one with room"
        ) from error
    return folder


@contextmanager
def scratch_folder(purpose: str) -> Iterator[Path]:
    """Yield a folder of `make_scratch`, and remove it at the end; InputError as there."""
    folder = make_scratch(purpose)
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
