"""Ctrl-C and SIGTERM during long work: an orderly end, one line and exit code 130."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from typing import NoReturn

import click

from floatref.cli.program.interrupts import INTERRUPTED, Interrupt

SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def interruptible(line: Callable[[], str]) -> Iterator[None]:
    """Let both signals raise KeyboardInterrupt once, and end with the text of ``line``.

    After the first one both are ignored, so that workers can be stopped. A signal that was ignored
    before stays ignored.
    """
    before = {number: signal.getsignal(number) for number in SIGNALS}
    caught = [number for number in SIGNALS if before[number] != signal.SIG_IGN]
    if current_thread() is not main_thread():
        caught = []

    def stop(*_: object) -> NoReturn:
        for number in caught:
            signal.signal(number, signal.SIG_IGN)
        raise Interrupt

    for number in caught:
        signal.signal(number, stop)
    try:
        yield
    except KeyboardInterrupt as error:
        click.echo(line(), err=True)
        raise click.exceptions.Exit(INTERRUPTED) from error
    finally:
        for number in caught:
            signal.signal(number, before[number])
