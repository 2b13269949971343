"""Ctrl-C and SIGTERM during long work: an orderly end, one line and exit code 130."""

import os
import signal
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from multiprocessing import active_children
from threading import Event, Thread, current_thread, main_thread
from typing import Any, NoReturn

import click

from floatref.cli.program.interrupts import (
    INTERRUPTED,
    Interrupt,
    outside_of_whole,
    raised_again,
    send_again,
)

SIGNALS = (signal.SIGINT, signal.SIGTERM)
ENDING_S = 180.0
"""Longest time in s between a signal and the end of the command."""
LATE = "Interrupted; what still ran {:g} s later was killed: go on with --resume\n"


@contextmanager
def interruptible(line: Callable[[], str], ending_s: float = ENDING_S) -> Iterator[None]:
    """Let both signals raise KeyboardInterrupt once, and end with the text of ``line``.

    After the first one both do nothing, so that workers can be stopped; what goes on behind that is
    killed. Where the work goes on for ``ending_s`` seconds nevertheless, the process ends with a
    line and exit code 130: its workers end with it, and the next command removes their files. A
    signal that was ignored before stays ignored.
    """
    before = {number: signal.getsignal(number) for number in SIGNALS}
    caught = [number for number in SIGNALS if before[number] != signal.SIG_IGN]
    if current_thread() is not main_thread():
        caught = []
    over, errors, came = Event(), os.dup(2), list[int]()

    @outside_of_whole
    def stop(number: int) -> NoReturn:
        _handle(caught, _do_nothing)
        if not came:
            Thread(target=_end_late, args=(over, ending_s, errors), daemon=True).start()
        came.append(number)
        raise Interrupt

    def stop_again() -> bool:
        if came:
            _handle(caught, stop)
            send_again(came[-1])
        return bool(came)

    try:
        _handle(caught, stop)
        with raised_again(stop_again) if caught else nullcontext():
            yield
    except KeyboardInterrupt as error:
        click.echo(line(), err=True)
        raise click.exceptions.Exit(INTERRUPTED) from error
    finally:
        _kill_children(came)
        over.set()
        for number in caught:
            signal.signal(number, before[number])
        os.close(errors)


def _handle(numbers: Iterable[int], handler: Any) -> None:
    for number in numbers:
        signal.signal(number, handler)


def _do_nothing(number: int, _: object) -> None:
    """Be there in place of SIG_IGN, which what is started from now on would inherit.

    A worker that is started in place of one that the signal has ended would then hear no signal,
    and Python waits for it.
    """


def _kill_children(came: list[int]) -> None:
    """Kill what signals that ``came`` left of the workers: Python would wait without a limit."""
    for child in active_children() if came else ():
        child.kill()
        child.join()


def _end_late(over: Event, ending_s: float, errors: int) -> None:
    """End the process unless ``over`` is set in time; write why to the descriptor ``errors``."""
    if not over.wait(ending_s):
        with suppress(OSError):
            os.write(errors, LATE.format(ending_s).encode())
        os._exit(INTERRUPTED)
