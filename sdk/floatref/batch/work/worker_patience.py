"""A limit on the time without any worker, or without any work."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Event, Thread
from time import monotonic
from typing import TYPE_CHECKING, TextIO

from floatref.batch.work.cluster import count_workers

if TYPE_CHECKING:
    from distributed import Client

PATIENCE_S = 600.0
"""Longest time in s that a cluster may be without a worker, or without a task that is done."""

OFTEN_S = 5.0
"""Time in s between two checks of the workers."""


@contextmanager
def patient(
    client: "Client",
    patience_s: float = PATIENCE_S,
    is_busy: Callable[[], bool] = lambda: True,
) -> Iterator[Event]:
    """Yield an event that is set once there was no worker for ``patience_s`` seconds.

    The same holds if ``is_busy``, which says whether a task is being done, was false for that time.
    All tasks of ``client`` are cancelled then.
    """
    over, lost = Event(), Event()
    watch = Thread(target=_watch, args=(client, patience_s, is_busy, over, lost), daemon=True)
    watch.start()
    try:
        yield lost
    finally:
        over.set()
        watch.join(timeout=OFTEN_S)


def _watch(
    client: "Client", patience_s: float, is_busy: Callable[[], bool], over: Event, lost: Event
) -> None:
    seen_s = monotonic()
    while not over.wait(min(OFTEN_S, patience_s)):
        if count_workers(client) and is_busy():
            seen_s = monotonic()
        elif monotonic() - seen_s > patience_s:
            lost.set()
            drop_all(client)


def drop_all(client: "Client") -> None:
    """Cancel every task of ``client``; waiting for one then raises an error."""
    from distributed import Future

    with suppress(OSError, RuntimeError, TimeoutError):
        client.cancel([Future(key, client) for key in list(client.futures)])


OUTPUTS = (1, 2)
"""File descriptors of standard output and standard error."""


@contextmanager
def silence() -> Iterator[TextIO]:
    """Discard all output printed inside, and yield a stream that still reaches standard error.

    Processes that are started inside print nothing until they end, as do libraries that write
    through the file descriptors.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(number) for number in OUTPUTS]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    shown = _open_errors(kept[1])
    try:
        for number in OUTPUTS:
            os.dup2(nowhere, number)
        yield shown
    finally:
        shown.flush()
        sys.stdout.flush()
        sys.stderr.flush()
        for number, copy in zip(OUTPUTS, kept, strict=True):
            os.dup2(copy, number)
            os.close(copy)
        os.close(nowhere)


def _open_errors(copy: int) -> TextIO:
    """Return standard error on descriptor ``copy``; as it is if it is not a descriptor's."""
    try:
        if sys.stderr.fileno() != OUTPUTS[1]:
            return sys.stderr
    except OSError:
        return sys.stderr
    encoding, errors = sys.stderr.encoding, sys.stderr.errors
    return open(copy, "w", buffering=1, encoding=encoding, errors=errors, closefd=False)
