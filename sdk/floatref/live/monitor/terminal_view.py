"""The view in a terminal, drawn again twice a second, or a plain line every ten seconds."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Event as Signal
from threading import Thread
from typing import TextIO

from rich.console import Console, RenderableType
from rich.live import Live

from floatref.live.monitor.shown_state import Shown
from floatref.live.monitor.state_tables import plain_line, render

PER_S = 2.0
"""Drawings in a second."""
LINE_S = 10.0
"""Time in s between two plain lines."""
ENDING_S = 2.0
"""Longest time in s that the end of a run waits for a terminal that takes no output."""


@contextmanager
def terminal_view(shown: Callable[[], Shown], stream: TextIO) -> Iterator[None]:
    """Show on ``stream`` what ``shown`` returns, until the end of the statement.

    The last state is left there. Without a terminal it is one plain line every `LINE_S`. A thread
    draws, and a stream that takes no output stops that thread alone.
    """
    console = Console(file=stream, emoji=False, highlight=False)
    view = _drawn(shown, console) if console.is_terminal else _lines(shown, stream)
    with view:
        yield


@contextmanager
def _drawn(shown: Callable[[], Shown], console: Console) -> Iterator[None]:
    """Draw tables; standard output has the answers, so it is not redirected."""

    def draw() -> RenderableType:
        return render(shown())

    live = Live(
        console=console,
        get_renderable=draw,
        refresh_per_second=PER_S,
        redirect_stdout=False,
        vertical_overflow="crop",
    )
    live.start()
    try:
        yield
    finally:
        _end(live.stop)


@contextmanager
def _lines(shown: Callable[[], Shown], stream: TextIO) -> Iterator[None]:
    end = Signal()

    def write() -> None:
        # Whoever reads the lines may have gone; the run goes on.
        with suppress(OSError, ValueError):
            while not end.wait(LINE_S):
                print(plain_line(shown()), file=stream, flush=True)
            print(plain_line(shown()), file=stream, flush=True)

    thread = Thread(target=write, name="floatref-display", daemon=True)
    thread.start()
    try:
        yield
    finally:
        _end(lambda: (end.set(), thread.join()))


def _end(stop: Callable[[], object]) -> None:
    """Call ``stop``, and wait no longer than `ENDING_S`."""

    def call() -> None:
        with suppress(OSError, ValueError):
            stop()

    thread = Thread(target=call, name="floatref-display-end", daemon=True)
    thread.start()
    thread.join(ENDING_S)
