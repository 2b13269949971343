"""The three pipes of a device: each has a thread, so that neither side blocks the other."""

import os
from collections import deque
from dataclasses import dataclass
from queue import SimpleQueue
from threading import Condition, Thread
from time import monotonic, sleep
from typing import IO

MAX_LINE = 1 << 20
"""Longest line that a device may write, in bytes."""
MAX_OUTPUT = 64 << 20
"""Largest standard output of a device from start to stop, in bytes."""
MAX_UNREAD = 2 * MAX_LINE
"""Largest output of a device before the next command, in bytes."""
TAIL_BYTES = 64 << 10
"""Length of the end of standard error that is stored, in bytes."""
CHUNK = 64 << 10


@dataclass(frozen=True)
class Most:
    """How much a device may write, in bytes: in a line, before the next command, and in sum."""

    line: int = MAX_LINE
    unread: int = MAX_UNREAD
    total: int = MAX_OUTPUT


OF_COMMANDS = Most()
"""What a device may write that answers commands."""


class Lines:
    """Lines of a stream, taken one by one; reading stops when the stream exceeds a limit.

    Attributes:
        ended: whether the stream has ended.
        fault: which limit the stream exceeded; empty if it did not.
        rest: bytes since the end of the last line.
    """

    def __init__(self, stream: IO[bytes], most: Most = OF_COMMANDS) -> None:
        """Begin to read ``stream``, which may write ``most``."""
        self._most = most
        self.ended = False
        self.fault = ""
        self.rest = b""
        self._stream = stream
        self._lines: deque[bytes] = deque()
        self._unread = self._total = 0
        self._changed = Condition()
        self.thread = Thread(target=self._follow, daemon=True)
        self.thread.start()

    def take(self, wait_s: float) -> bytes | None:
        """Return the next line without its end; None if no line comes within ``wait_s``."""
        with self._changed:
            self._changed.wait_for(lambda: self._lines or self.ended, wait_s)
            if not self._lines:
                return None
            line = self._lines.popleft()
            self._unread -= len(line) + 1
            return line

    def _follow(self) -> None:
        while not self.ended:
            chunk = _read(self._stream)
            with self._changed:
                self._add(chunk)
                self.ended = not chunk or bool(self.fault)
                self._changed.notify_all()

    def _add(self, chunk: bytes) -> None:
        most = self._most
        *lines, self.rest = (self.rest + chunk).split(b"\n")
        self._total += len(chunk)
        for line in lines:
            if len(line) > most.line:
                break
            self._lines.append(line)
            self._unread += len(line) + 1
        if any(len(line) > most.line for line in (*lines, self.rest)):
            self.fault = f"wrote a line longer than {most.line >> 20} MiB"
        elif self._total > most.total:
            self.fault = f"wrote more than {most.total >> 20} MiB"
        elif self._unread > most.unread:
            self.fault = f"wrote more than {most.unread >> 20} MiB for one command"


class Tail:
    """The last bytes of a stream, which is read until its end."""

    def __init__(self, stream: IO[bytes]) -> None:
        """Begin to read ``stream``."""
        self.end = b""
        self._stream = stream
        self._last_s = monotonic()
        self.thread = Thread(target=self._follow, daemon=True)
        self.thread.start()

    def settle(self, quiet_s: float = 0.02, limit_s: float = 0.2) -> None:
        """Wait until no bytes have come for ``quiet_s``, but no longer than ``limit_s``."""
        begin = monotonic()
        while self.thread.is_alive() and monotonic() < begin + limit_s:
            if monotonic() > max(begin, self._last_s) + quiet_s:
                return
            sleep(quiet_s / 4)

    def _follow(self) -> None:
        while chunk := _read(self._stream):
            self.end = (self.end + chunk)[-TAIL_BYTES:]
            self._last_s = monotonic()


class Feed:
    """Writes to a stream without blocking the caller; a closed stream is no error."""

    def __init__(self, stream: IO[bytes]) -> None:
        """Begin to wait for lines to write to ``stream``."""
        self._stream = stream
        self._waiting: SimpleQueue[bytes | None] = SimpleQueue()
        self.thread = Thread(target=self._follow, daemon=True)
        self.thread.start()

    def put(self, line: bytes) -> None:
        """Write ``line`` as soon as the stream accepts it."""
        self._waiting.put(line)

    def close(self) -> None:
        """Close the stream after all lines are written."""
        self._waiting.put(None)

    def _follow(self) -> None:
        try:
            while (line := self._waiting.get()) is not None:
                while line:
                    line = line[self._stream.write(line) :]
            self._stream.close()
        except OSError:
            # A process that does not read does not answer either, and that is detected.
            return


def _read(stream: IO[bytes]) -> bytes:
    try:
        return os.read(stream.fileno(), CHUNK)
    except OSError:
        return b""
