"""Ctrl-C as an exception of its own, and the exit code that every command then has.

Nothing but a few modules of Python is imported here: this is loaded before all else.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from typing import NoReturn

INTERRUPTED = 130
"""Exit code of every command that was interrupted, as shells have it: 128 and SIGINT."""


class Interrupt(KeyboardInterrupt):
    """Ctrl-C in a command.

    `python -m` dies of the signal in the end, whatever its exit code, if an exception of the very
    type KeyboardInterrupt has left a text that was run, as that of a named tuple.
    """


def raise_interrupt(*_: object) -> NoReturn:
    """Raise Interrupt, for a signal."""
    raise Interrupt


@contextmanager
def raising_interrupt() -> Iterator[None]:
    """Let Ctrl-C raise Interrupt where it would raise KeyboardInterrupt."""
    usual = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if current_thread() is not main_thread() or not usual:
        yield
        return
    signal.signal(signal.SIGINT, raise_interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
