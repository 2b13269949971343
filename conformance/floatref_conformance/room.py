"""Room on the disk for what a run writes: where it lacks, no device is to blame.

Then a run ends in one line with the folder, the bytes and the variable that names another folder.
"""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from errno import EDQUOT, EFBIG, ENOSPC
from pathlib import Path

from floatref.values.recording import Recording
from floatref_conformance.errors import NoRoom

FULL = frozenset({ENOSPC, EDQUOT, EFBIG})
"""Errors of a full disk, a used-up share of it, and a limit of one file's size."""
TEMPORARY = "TMPDIR"
"""The variable that names the folder for temporary files."""


def bytes_of(recording: Recording) -> int:
    """Return the size in bytes of the samples of ``recording``."""
    return sum(channel.values.nbytes for channel in recording.channels)


@contextmanager
def needing_room(folder: Path, needed_bytes: int, variable: str) -> Iterator[None]:
    """Raise NoRoom if ``folder`` has no room for ``needed_bytes``, before or after an error.

    ``variable`` is that of the environment which names another folder.
    """
    _refuse_full(folder, needed_bytes, variable)
    try:
        yield
    except NoRoom:
        raise
    except Exception as error:
        reason = _reason(error)
        if reason:
            raise NoRoom(_line(folder, needed_bytes, variable, reason)) from error
        # A device that answers an error may have found the disk full.
        _refuse_full(folder, needed_bytes, variable)
        raise


def _refuse_full(folder: Path, needed_bytes: int, variable: str) -> None:
    with suppress(OSError):
        free = shutil.disk_usage(_existing(folder)).free
        if free < needed_bytes:
            raise NoRoom(_line(folder, needed_bytes, variable, f"{free} bytes are free"))


def _existing(folder: Path) -> Path:
    """Return ``folder``, or the nearest folder above it that exists."""
    return next((path for path in (folder, *folder.parents) if path.exists()), folder)


def _reason(error: BaseException | None) -> str:
    """Return the system's words if a full disk has caused ``error``, else an empty text."""
    while error is not None:
        if isinstance(error, OSError) and error.errno in FULL:
            return error.strerror or str(error)
        error = error.__cause__
    return ""


def _line(folder: Path, needed_bytes: int, variable: str, reason: str) -> str:
    return (
        f"{folder}: no room for a recording, which needs {needed_bytes} bytes ({reason}); free "
        f"space there, or name another folder in the environment variable {variable}"
    )
