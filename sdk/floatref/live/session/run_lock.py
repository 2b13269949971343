"""One command serves a run at a time: the lock of its directory.

The system holds it on the directory itself: it ends with its process, however that ends, and leaves
no file. Where the system or the file system has no such locks, the run is not locked.
"""

import os
from pathlib import Path

from floatref.errors import InputError


class RunLock:
    """Locks a directory until `release`."""

    def __init__(self, path: Path) -> None:
        """Lock ``path``, if it is a directory; InputError while another command serves it."""
        self._handle: int | None = None
        try:
            import fcntl

            self._handle = os.open(path, os.O_RDONLY | os.O_DIRECTORY)
            fcntl.flock(self._handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self.release()
            raise InputError(
                f"{path}: another command serves this run; end that one, or wait for its end"
            ) from None
        except (ImportError, OSError):
            self.release()

    def release(self) -> None:
        """Let another command have it."""
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None
