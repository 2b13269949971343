"""Signals held back while a cluster starts or ends.

An interrupt in the middle of either leaves a cluster that no library can close: it would print a
traceback when the program ends, or leave workers behind.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from typing import Any

SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def hold_signals() -> Iterator[None]:
    """Call the handlers of Ctrl-C and SIGTERM afterwards, for the first signal that came.

    What comes first ends the work in any case: an error of the body is then not raised. Everything
    inside needs a time limit of its own.
    """
    if current_thread() is not main_thread():
        yield
        return
    heard: list[int] = []
    before: dict[int, Any] = {number: signal.getsignal(number) for number in SIGNALS}
    caught = {number: handler for number, handler in before.items() if callable(handler)}
    try:
        for number in caught:
            signal.signal(number, lambda number, _: heard.append(number))
        yield
    finally:
        for number, handler in caught.items():
            signal.signal(number, handler)
        if heard:
            caught[heard[0]](heard[0], None)
