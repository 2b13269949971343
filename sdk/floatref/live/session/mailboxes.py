"""Between the thread that serves and its peer: a box of messages that came, one of answers.

The first holds few messages, so that a peer that sends too fast has to wait. The second holds all
answers, in a file if they are many: a peer that reads slowly, or only at the end, loses nothing and
keeps nobody waiting.
"""

import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from math import inf
from queue import Empty, Full, Queue
from tempfile import SpooledTemporaryFile
from threading import Condition, Event, Thread

from floatref.live.session.messages import Sent

MOST = 4
"""Messages that wait for the thread that serves."""
IN_MEMORY = 8 << 20
"""Bytes of answers that wait in memory."""
BLOCK = 1 << 16
PAUSE_S = 0.1
"""Time in s between two looks at whether all has ended."""


class Inbox:
    """Reads messages in a thread."""

    def __init__(self, messages: Iterator[Sent]) -> None:
        """Begin to read ``messages``."""
        self._messages = messages
        self._queue: Queue[Sent | BaseException | None] = Queue(MOST)
        self._closed = Event()
        Thread(target=self._read, name="floatref-live-inbox", daemon=True).start()

    def get(self, timeout_s: float) -> Sent | None:
        """Return the next message; None if there is no message within ``timeout_s``.

        Raises EOFError behind the last one, and whatever reading has raised.
        """
        try:
            item = self._queue.get(timeout=timeout_s)
        except Empty:
            return None
        if item is None:
            raise EOFError
        if isinstance(item, BaseException):
            raise item
        return item

    def close(self) -> None:
        """Read no more."""
        self._closed.set()

    def _read(self) -> None:
        try:
            for message in self._messages:
                self._put(message)
                if self._closed.is_set():
                    return
            self._put(None)
        except BaseException as error:
            self._put(error)

    def _put(self, item: Sent | BaseException | None) -> None:
        while not self._closed.is_set():
            with suppress(Full):
                self._queue.put(item, timeout=PAUSE_S)
                break


class Outbox:
    """Writes answers in a thread."""

    def __init__(self, write: Callable[[bytes], object]) -> None:
        """Write with ``write``, which may wait, and raises OSError once the reader is gone."""
        self._write = write
        self._changed = Condition()
        self._file = SpooledTemporaryFile(IN_MEMORY)  # noqa: SIM115, closed by the thread
        self._begin = self._end = 0
        self._ended = False
        self.lost = False
        self._thread = Thread(target=self._work, name="floatref-live-outbox", daemon=True)
        self._thread.start()

    def put(self, data: bytes) -> None:
        """Take ``data`` to write; never waits for the reader."""
        with self._changed:
            if self.lost or self._ended:
                return
            self._file.seek(self._end)
            self._file.write(data)
            self._end += len(data)
            self._changed.notify_all()

    def end(self, data: bytes) -> None:
        """Take the last ``data``."""
        self.put(data)
        with self._changed:
            self._ended = True
            self._changed.notify_all()

    def drain(self, limit_s: float | None) -> None:
        """Wait, after `end`, until the reader has taken all or is gone, or for ``limit_s``."""
        until_s = inf if limit_s is None else time.monotonic() + limit_s
        while self._thread.is_alive() and time.monotonic() < until_s:
            self._thread.join(PAUSE_S)

    def _work(self) -> None:
        try:
            while data := self._take():
                self._write(data)
        except (OSError, ValueError):
            self.lost = True
        with self._changed:
            self._ended = True
            self._file.close()

    def _take(self) -> bytes:
        with self._changed:
            self._changed.wait_for(lambda: self._ended or self._begin < self._end)
            self._file.seek(self._begin)
            data = self._file.read(min(BLOCK, self._end - self._begin))
            self._begin += len(data)
            if self._begin == self._end:
                self._file.truncate(0)
                self._begin = self._end = 0
            return data
