"""An end to waiting for workers that do not come back."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Event, Thread
from time import monotonic
from typing import TYPE_CHECKING

from floatref.batch.cluster import count_workers

if TYPE_CHECKING:
    from distributed import Client

PATIENCE_S = 600.0
"""For so long a cluster may be without a worker."""

OFTEN_S = 5.0
"""From one look at the workers to the next."""


@contextmanager
def patient(client: "Client", patience_s: float = PATIENCE_S) -> Iterator[None]:
    """Drop all that ``client`` waits for once there was no worker for ``patience_s`` seconds."""
    over = Event()
    watch = Thread(target=_watch, args=(client, patience_s, over.wait), daemon=True)
    watch.start()
    try:
        yield
    finally:
        over.set()
        watch.join(timeout=OFTEN_S)


def _watch(client: "Client", patience_s: float, over: Callable[[float], bool]) -> None:
    seen_s = monotonic()
    while not over(min(OFTEN_S, patience_s)):
        if count_workers(client):
            seen_s = monotonic()
        elif monotonic() - seen_s > patience_s:
            drop_all(client)


def drop_all(client: "Client") -> None:
    """Cancel every task of ``client``; who waits for one is told so."""
    from distributed import Future

    with suppress(OSError, RuntimeError, TimeoutError):
        client.cancel([Future(key, client) for key in list(client.futures)])
