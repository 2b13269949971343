"""Where messages come from: standard input, or a file that another program is writing."""

import io
import os
import select
import time
from collections.abc import Iterator
from contextlib import contextmanager
from io import BufferedReader
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.sources import open_bytes
from floatref.live.session.serving import Peer

PAUSE_S = 0.1
"""Time in s between two looks at whether a file has grown."""


class GrowingFile(io.RawIOBase):
    """Reads a file, and at its end waits for more."""

    def __init__(self, path: Path, stream: BufferedReader) -> None:
        """Read the opened ``stream`` of ``path`` from its start."""
        self._path, self._stream = path, stream

    def readable(self) -> bool:
        """Return that it can be read."""
        return True

    def readinto(self, buffer: Any) -> int:
        """Read what there is, at least one byte; InputError for a file that became shorter."""
        while True:
            count = self._stream.readinto1(buffer)
            if count:
                return count
            if os.fstat(self._stream.fileno()).st_size < self._stream.tell():
                raise InputError(f"{self._path}: became shorter; follow a file that only grows")
            time.sleep(PAUSE_S)


class WaitingStream(io.RawIOBase):
    """Reads a stream, and waits for more where it was set not to block.

    Terminals, pipes and sockets that programs share have one such setting for all of them.
    """

    def __init__(self, raw: io.RawIOBase) -> None:
        """Read ``raw``, which has a number of the system."""
        self._raw = raw

    def readable(self) -> bool:
        """Return that it can be read."""
        return True

    def readinto(self, buffer: Any) -> int:
        """Read what there is, at least one byte; 0 once it has ended."""
        # Nothing to read yet is None, which a buffered reader takes for the end.
        while (count := self._raw.readinto(buffer)) is None:
            select.select([self._raw], [], [])
        return int(count)


@contextmanager
def standard_streams() -> Iterator[Peer]:
    """Yield the program at the other end of standard input and output."""
    # Not `sys.stdin`: at exit Python waits for the lock of a thread that still reads it.
    with open(0, "rb", buffering=0, closefd=False) as raw:
        waiting: Any = BufferedReader(WaitingStream(raw))
        yield Peer(waiting, write_to_output, "standard input")


@contextmanager
def followed(path: Path) -> Iterator[Peer]:
    """Yield what writes the file ``path``; answers go to standard output."""
    with open_bytes(path, grows=True) as stream:
        # A raw stream of our own is what `BufferedReader` documents to take.
        growing: Any = BufferedReader(GrowingFile(path, stream))
        yield Peer(growing, write_to_output, str(path), from_start=True)


def write_to_output(data: bytes) -> None:
    """Write ``data`` to standard output; OSError once its reader is gone.

    Where the program at the other end has set what both share not to block, this waits.
    """
    while data:
        try:
            data = data[os.write(1, data) :]
        except BlockingIOError:
            select.select([], [1], [])
